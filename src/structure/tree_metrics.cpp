#include "structure/tree_metrics.h"

namespace boxwood {

TreeMetrics tree_metrics(const Tree& tree, const Mesh& mesh, const KnownUse& use, std::uint32_t samples) {
  constexpr std::uint32_t lines = 1 << 15;
  TreeMetrics metrics;
  if (tree.empty()) return metrics;
  const auto corners = [&](std::uint32_t primitive) {
    const auto& [a, b, c] = mesh.triangles[primitive];
    return std::array{mesh.positions[a], mesh.positions[b], mesh.positions[c]};
  };
  metrics.overlap = end_point_overlap(tree, corners, samples);
  metrics.lines = ray_cost(tree, uniform_lines(tree.nodes[0].bounds, lines));
  std::vector<Segment> all;
  for (const ExpectedRays& rays : use.rays) {
    const std::size_t first = all.size();
    for (std::size_t i = 0; i < rays.rays.size(); ++i) all.emplace_back(rays.rays[i], rays.ends[i]);
    metrics.rays.push_back({rays.kind, ray_cost(tree, std::span(all).subspan(first))});
  }
  metrics.all_rays = ray_cost(tree, all);
  return metrics;
}

}  // namespace boxwood
