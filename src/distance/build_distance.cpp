// Triangles of all instances in world space, and a tree over them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "boxwood/error.h"
#include "boxwood/recipe.h"
#include "distance/distance_data.h"
#include "distance/winding.h"
#include "structure/pipeline.h"

namespace boxwood {
namespace {

bool is_within_limits(const Vec3& p) {
  return is_finite(p) && std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) <= largest_coordinate;
}

/// Every instance's triangles in world space, in order; `names` tells where they are from.
Mesh world_mesh(const Scene& scene, std::vector<TriangleName>& names) {
  if (scene.placed_triangles() > Tree::max_count) {
    throw Error(
        fmt::format("distance queries hold at most {} placed triangles, but the scene has {}; use fewer instances",
                    Tree::max_count, scene.placed_triangles()));
  }
  Mesh world;
  const bool as_it_stands = scene.single_level();
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[instance.mesh];
    const auto base = static_cast<std::uint32_t>(world.positions.size());
    for (const Vec3& p : mesh.positions)
      world.positions.push_back(as_it_stands ? p : instance.object_to_world.point(p));
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      world.triangles.push_back({base + a, base + b, base + c});
      names.push_back({i, t});
    }
  }
  return world;
}

}  // namespace

DistanceQueries::DistanceQueries(const Scene& scene) {
  const auto data = std::make_shared<Data>();
  std::vector<TriangleName> names;
  const Mesh world = world_mesh(scene, names);
  const bool as_it_stands = scene.single_level();
  const auto placed = [&](std::uint32_t t) {
    const auto& [a, b, c] = world.triangles[t];
    const bool turned = !as_it_stands && scene.instances[names[t].instance].object_to_world.determinant() < 0;
    return PlacedTriangle{world.positions[a], world.positions[turned ? c : b], world.positions[turned ? b : c],
                          names[t], turned ? 1u : 0u};
  };
  data->tree = tree_of(world, Recipe::parse("binned(k=4) > wide(4)"));
  std::vector<std::uint8_t> used(names.size(), 0);
  for (const std::uint32_t t : data->tree.references) {
    data->triangles.push_back(placed(t));
    used[t] = 1;
  }
  for (std::uint32_t t = 0; t < names.size(); ++t) {
    if (used[t] != 0) continue;
    const PlacedTriangle rest = placed(t);
    if (is_within_limits(rest.a) && is_within_limits(rest.b) && is_within_limits(rest.c))
      data->degenerate.push_back(rest);
  }
  data->tree.references = {};
  for (const PlacedTriangle& t : data->triangles) {
    for (const Vec3& p : {t.a, t.b, t.c}) {
      data->reach = std::max({data->reach, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    }
  }
  data_ = data;
}

std::size_t DistanceQueries::Data::find_open_edges() const {
  std::call_once(once, [&] {
    std::vector<PlacedTriangle> all = triangles;
    all.insert(all.end(), degenerate.begin(), degenerate.end());
    open_edges = boxwood::open_edges(all);
  });
  return open_edges;
}

std::size_t DistanceQueries::bytes() const {
  return data_->tree.bytes() + (data_->triangles.capacity() + data_->degenerate.capacity()) * sizeof(PlacedTriangle);
}

}  // namespace boxwood
