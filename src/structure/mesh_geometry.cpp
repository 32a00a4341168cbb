#include "structure/mesh_geometry.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_scan.h>

#include <algorithm>

#include "math/clip.h"
#include "math/large_memory.h"

namespace boxwood {
namespace {

Box box_of(const Mesh& mesh, const Triangle& triangle) {
  Box box;
  for (const std::uint32_t vertex : triangle) box.grow(mesh.positions[vertex]);
  return box;
}

}  // namespace

Vec3 MeshGeometry::centroid(std::uint32_t primitive) const {
  const auto& [a, b, c] = mesh_.triangles[primitive];
  return (mesh_.positions[a] + mesh_.positions[b] + mesh_.positions[c]) * (1.0f / 3.0f);
}

Box MeshGeometry::clip(std::uint32_t primitive, const Box& region) const {
  const auto& [a, b, c] = mesh_.triangles[primitive];
  return clip_triangle(mesh_.positions[a], mesh_.positions[b], mesh_.positions[c], region);
}

bool MeshGeometry::corners(std::uint32_t primitive, Vec3 (&out)[3]) const {
  for (std::size_t corner = 0; corner < 3; ++corner) out[corner] = mesh_.positions[mesh_.triangles[primitive][corner]];
  return true;
}

LargeVector<Reference> MeshGeometry::references() const {
  constexpr std::size_t chunk = 1 << 14;
  const std::size_t count = mesh_.triangles.size();
  const std::size_t chunks = (count + chunk - 1) / chunk;
  // Each chunk fills its own part, so that the order never depends on the threads; then the gaps are closed.
  LargeVector<Reference> out = unwritten<Reference>(count);
  std::vector<std::size_t> ends(chunks);
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
    std::size_t next = c * chunk;
    for (std::size_t i = c * chunk; i < std::min(count, (c + 1) * chunk); ++i) {
      const auto primitive = static_cast<std::uint32_t>(i);
      const Box box = box_of(mesh_, mesh_.triangles[i]);
      out[next] = {box.lower, primitive, box.upper, 0};
      next += is_usable(mesh_, primitive) ? 1 : 0;
    }
    ends[c] = next;
  });
  std::size_t end = 0;
  for (std::size_t c = 0; c < chunks; ++c) {
    const std::size_t begin = c * chunk, size = ends[c] - begin;
    if (end < begin)
      std::copy_n(out.begin() + static_cast<std::ptrdiff_t>(begin), size,
                  out.begin() + static_cast<std::ptrdiff_t>(end));
    end += size;
  }
  out.resize(end);
  return out;
}

Box usable_bounds(const Mesh& mesh) {
  Box bounds;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    if (is_usable(mesh, i)) bounds.grow(box_of(mesh, mesh.triangles[i]));
  }
  return bounds;
}

std::vector<Box> instance_boxes(const Scene& scene) {
  std::vector<Box> mesh_boxes, boxes;
  for (const Mesh& mesh : scene.meshes) mesh_boxes.push_back(usable_bounds(mesh));
  for (const Instance& instance : scene.instances) {
    const Box& box = mesh_boxes[instance.mesh];
    boxes.push_back(box.empty() ? box : instance.object_to_world.box(box));
  }
  return boxes;
}

LargeVector<Reference> instance_references(std::span<const Box> boxes) {
  LargeVector<Reference> out;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (!boxes[i].empty()) out.push_back({boxes[i].lower, i, boxes[i].upper});
  }
  return out;
}

}  // namespace boxwood
