#include "scene/placement.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>

namespace boxwood {
namespace {

/// Where an instance's vertices and triangles go in the merged mesh.
struct Offsets {
  std::size_t position = 0, triangle = 0;
};

template <class Body>
void for_each_index(std::size_t count, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1 << 14), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
  });
}

void write_instance(Mesh& out, const Mesh& mesh, const Transform& to_world, const Offsets& at, std::uint16_t material) {
  const bool unchanged = to_world == Transform{};
  for_each_index(mesh.positions.size(), [&](std::size_t i) {
    out.positions[at.position + i] = unchanged ? mesh.positions[i] : to_world.point(mesh.positions[i]);
    if (!mesh.normals.empty()) {
      out.normals[at.position + i] = unchanged ? mesh.normals[i] : map_normal(to_world, mesh.normals[i]);
    }
    if (!mesh.texture_coordinates.empty()) {
      out.texture_coordinates[at.position + i] = mesh.texture_coordinates[i];
    }
  });
  for_each_index(mesh.triangles.size(), [&](std::size_t i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      out.triangles[at.triangle + i][corner] = static_cast<std::uint32_t>(at.position + mesh.triangles[i][corner]);
    }
    if (!out.materials.empty()) {
      out.materials[at.triangle + i] = mesh.materials.empty() ? material : mesh.materials[i];
    }
  });
}

bool has_inverse(const Transform& t) {
  const float determinant = t.determinant();
  return std::isfinite(determinant) && determinant != 0 && is_finite(t.translation);
}

struct Unusable {
  std::uint64_t degenerate = 0, non_finite = 0;
};

Unusable count_unusable(const Mesh& mesh) {
  using Range = tbb::blocked_range<std::uint32_t>;
  return tbb::parallel_reduce(
      Range(0, static_cast<std::uint32_t>(mesh.triangles.size()), 1 << 14), Unusable{},
      [&](const Range& range, Unusable sum) {
        for (std::uint32_t i = range.begin(); i < range.end(); ++i) {
          if (is_usable(mesh, i)) continue;
          const bool finite = std::all_of(mesh.triangles[i].begin(), mesh.triangles[i].end(), [&](std::uint32_t v) {
            const Vec3& p = mesh.positions[v];
            return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) <= largest_coordinate && is_finite(p);
          });
          ++(finite ? sum.degenerate : sum.non_finite);
        }
        return sum;
      },
      [](const Unusable& a, const Unusable& b) {
        return Unusable{a.degenerate + b.degenerate, a.non_finite + b.non_finite};
      });
}

/// True when some element of `values` is `bound` or more.
template <class T, class LargestOf>
bool any_beyond(const std::vector<T>& values, std::size_t bound, const LargestOf& largest_of) {
  using Range = tbb::blocked_range<std::size_t>;
  return tbb::parallel_reduce(
      Range(0, values.size(), 1 << 14), false,
      [&](const Range& range, bool found) {
        for (std::size_t i = range.begin(); i < range.end() && !found; ++i) found = largest_of(values[i]) >= bound;
        return found;
      },
      [](bool a, bool b) { return a || b; });
}

std::string find_bad_index(const Scene& scene, const Mesh& mesh) {
  const std::size_t positions = mesh.positions.size();
  if (any_beyond(mesh.triangles, positions, [](const Triangle& t) { return std::max({t[0], t[1], t[2]}); })) {
    return "a triangle refers to a position that does not exist";
  }
  if (!mesh.materials.empty() && mesh.materials.size() != mesh.triangles.size()) return "not one material per triangle";
  if (any_beyond(mesh.materials, scene.materials.size(), [](std::uint16_t m) { return m; })) {
    return "a triangle refers to a material that does not exist";
  }
  const auto fits = [&](std::size_t size) { return size == 0 || size == positions; };
  if (!fits(mesh.normals.size()) || !fits(mesh.texture_coordinates.size())) return "not one attribute per position";
  return {};
}

}  // namespace

Vec3 map_normal(const Transform& t, const Vec3& n) {
  // The transposed inverse up to a factor, which also exists for singular maps.
  const float side = t.determinant() < 0 ? -1.0f : 1.0f;
  return normalize((cross(t.y, t.z) * n.x + cross(t.z, t.x) * n.y + cross(t.x, t.y) * n.z) * side);
}

Mesh merge_placed(std::span<const Mesh> meshes, std::span<const Instance> instances, std::vector<Material>& materials) {
  std::vector<Offsets> offsets(instances.size() + 1);
  bool any_materials = false, all_materials = true, any_normals = false, any_texture = false;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const Mesh& mesh = meshes[instances[i].mesh];
    offsets[i + 1] = {offsets[i].position + mesh.positions.size(), offsets[i].triangle + mesh.triangles.size()};
    any_materials |= !mesh.materials.empty();
    all_materials &= !mesh.materials.empty() || mesh.triangles.empty();
    any_normals |= !mesh.normals.empty();
    any_texture |= !mesh.texture_coordinates.empty();
  }
  const Offsets total = offsets.back();
  if (std::max(total.position, total.triangle) >= 0xffffffffu) {
    throw Error(
        fmt::format("{} triangles with {} vertices do not fit one mesh, which holds 2^32 - 2 of each; "
                    "use fewer instances",
                    total.triangle, total.position));
  }
  Mesh out;
  if (instances.size() == 1) out.name = meshes[instances[0].mesh].name;
  out.positions.resize(total.position);
  out.triangles.resize(total.triangle);
  if (any_materials) out.materials.resize(total.triangle);
  if (any_normals) out.normals.resize(total.position);
  if (any_texture) out.texture_coordinates.resize(total.position);
  const auto no_material = static_cast<std::uint16_t>(std::min<std::size_t>(materials.size(), 0xffff));
  if (any_materials && !all_materials) materials.emplace_back().name = "default";
  for (std::size_t i = 0; i < instances.size(); ++i) {
    write_instance(out, meshes[instances[i].mesh], instances[i].object_to_world, offsets[i], no_material);
  }
  return out;
}

Scene merge_single_placements(Scene scene) {
  if (scene.single_level()) return scene;
  std::vector<std::size_t> placements(scene.meshes.size(), 0);
  for (const Instance& instance : scene.instances) {
    if (has_inverse(instance.object_to_world)) ++placements[instance.mesh];
  }
  const auto stays = [&](const Instance& instance) {
    return placements[instance.mesh] > 1 && has_inverse(instance.object_to_world);
  };
  std::vector<Instance> once, several;
  for (const Instance& instance : scene.instances) (stays(instance) ? several : once).push_back(instance);

  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  if (!once.empty() || several.empty()) {
    const bool merged = once.size() == 1 && once[0].object_to_world == Transform{};
    meshes.push_back(merged ? std::move(scene.meshes[once[0].mesh])
                            : merge_placed(scene.meshes, once, scene.materials));
    instances.push_back({0, {}});
  }
  constexpr std::uint32_t not_moved = 0xffffffffu;
  std::vector<std::uint32_t> moved_to(scene.meshes.size(), not_moved);
  for (Instance instance : several) {
    std::uint32_t& place = moved_to[instance.mesh];
    if (place == not_moved) {
      place = static_cast<std::uint32_t>(meshes.size());
      meshes.push_back(std::move(scene.meshes[instance.mesh]));
    }
    instance.mesh = place;
    instances.push_back(instance);
  }
  scene.meshes = std::move(meshes);
  scene.instances = std::move(instances);
  return scene;
}

void count_unusable(Scene& scene) {
  for (const Mesh& mesh : scene.meshes) {
    const Unusable sum = count_unusable(mesh);
    scene.notes.degenerate_triangles += sum.degenerate;
    scene.notes.non_finite_triangles += sum.non_finite;
  }
}

std::string find_bad_index(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) {
    if (std::string problem = find_bad_index(scene, mesh); !problem.empty()) return problem;
  }
  for (const Material& material : scene.materials) {
    if (material.texture != Material::no_texture && material.texture >= scene.textures.size()) {
      return "a material refers to a texture that does not exist";
    }
  }
  for (const Texture& texture : scene.textures) {
    if (texture.pixels.size() != std::uint64_t{3} * texture.width * texture.height) return "a texture lacks pixels";
  }
  for (const Instance& instance : scene.instances) {
    if (instance.mesh >= scene.meshes.size()) return "an instance refers to a mesh that does not exist";
  }
  return {};
}

}  // namespace boxwood
