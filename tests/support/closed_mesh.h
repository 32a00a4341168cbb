#pragma once
#include <map>
#include <utility>

#include "boxwood/scene.h"

namespace boxwood {

/// Whether every edge belongs to exactly two triangles that run along it in opposite directions.
inline bool is_closed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    const auto opposite = edges.find({edge.second, edge.first});
    if (count != 1 || opposite == edges.end() || opposite->second != 1) return false;
  }
  return !edges.empty();
}

/// Signed volume; positive when vertices run counter-clockwise as seen from outside.
inline double signed_volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += static_cast<double>(dot(mesh.positions[a], cross(mesh.positions[b], mesh.positions[c])));
  }
  return sum / 6;
}

}  // namespace boxwood
