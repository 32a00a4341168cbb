#include "layout/leaves.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "boxwood/error.h"
#include "trace/instance_error.h"

namespace boxwood {
namespace {

Transform inverse_of(const Instance& instance, std::uint32_t number) {
  try {
    return instance.object_to_world.inverse();
  } catch (const Error&) {
    throw Error(
        fmt::format("instance {} is placed by a transform without inverse (its determinant is zero or not "
                    "finite); flatten the scene, or correct or remove the instance",
                    number));
  }
}

template <class PrimitiveAt>
void place_triangles(TriangleLeaves& leaves, const Mesh& mesh, const PrimitiveAt& primitive_at) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, leaves.triangles.size(), 1 << 12), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const std::uint32_t primitive = primitive_at(i);
      const auto& [a, b, c] = mesh.triangles[primitive];
      leaves.triangles[i] = {mesh.positions[a], mesh.positions[b], mesh.positions[c], primitive};
    }
  });
}

}  // namespace

TriangleLeaves triangle_leaves(std::span<const std::uint32_t> references, const Mesh& mesh) {
  TriangleLeaves leaves;
  leaves.triangles.resize(references.size());
  place_triangles(leaves, mesh, [&](std::size_t i) { return references[i]; });
  return leaves;
}

void move_triangles(TriangleLeaves& leaves, const Mesh& mesh) {
  place_triangles(leaves, mesh, [&](std::size_t i) { return leaves.triangles[i].primitive; });
}

InstanceLeaves instance_leaves(std::span<const std::uint32_t> references, const Contents& contents) {
  InstanceLeaves leaves;
  leaves.bottoms.assign(contents.bottoms.begin(), contents.bottoms.end());
  leaves.instances.reserve(references.size());
  for (const std::uint32_t number : references) {
    const Instance& instance = contents.instances[number];
    leaves.instances.push_back({inverse_of(instance, number), leaves.bottoms[instance.mesh].get(),
                                contents.numbers.empty() ? number : contents.numbers[number], instance.mask});
  }
  return leaves;
}

Reach extent_of(const TriangleLeaves&, std::span<const std::uint32_t>, const Box& bounds, const Contents&) {
  if (bounds.empty()) return {};
  const Vec3 largest = max(max(bounds.lower, bounds.upper), max(-bounds.lower, -bounds.upper));
  return {std::max({largest.x, largest.y, largest.z}), 1};
}

Reach extent_of(const InstanceLeaves& leaves, std::span<const std::uint32_t> references, const Box& bounds,
                const Contents& contents) {
  InstanceError error;
  for (std::size_t i = 0; i < leaves.instances.size(); ++i) {
    const InstanceLeaf& leaf = leaves.instances[i];
    // What the world's box is to the instance bounds whatever of it lies there.
    const Box object_box = leaf.world_to_object.box(bounds);
    error.grow(instance_error(contents.instances[references[i]].object_to_world, leaf.world_to_object, object_box,
                              leaf.bottom->reach()));
  }
  const float reach = extent_of(TriangleLeaves{}, references, bounds, contents).reach;
  return {reach + error.offset / error.gain, error.gain};
}

}  // namespace boxwood
