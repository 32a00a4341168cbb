#include "scene/importers/pbrt/loop_subdivision.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace boxwood::pbrt {
namespace {

/// An edge and the corners that face it.
struct Edge {
  std::uint32_t a, b;  ///< a < b
  std::uint32_t opposite[2] = {0, 0};
  std::uint32_t triangles = 0;

  bool border() const { return triangles != 2; }
};

/// The edges of a mesh and, for each triangle, the three that it has: edge i runs from corner i to the next.
struct Edges {
  std::vector<Edge> list;
  std::vector<std::array<std::uint32_t, 3>> of_triangle;
};

Edges edges_of(const Mesh& mesh) {
  struct Half {
    std::uint32_t a, b, triangle, corner;
  };
  std::vector<Half> halves;
  halves.reserve(mesh.triangles.size() * 3);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t from = mesh.triangles[t][corner], to = mesh.triangles[t][(corner + 1) % 3];
      halves.push_back({std::min(from, to), std::max(from, to), t, corner});
    }
  }
  std::ranges::sort(halves, [](const Half& p, const Half& q) {
    return std::tie(p.a, p.b, p.triangle, p.corner) < std::tie(q.a, q.b, q.triangle, q.corner);
  });
  Edges edges;
  edges.of_triangle.resize(mesh.triangles.size());
  for (const Half& half : halves) {
    if (edges.list.empty() || edges.list.back().a != half.a || edges.list.back().b != half.b) {
      edges.list.push_back({half.a, half.b});
    }
    Edge& edge = edges.list.back();
    if (edge.triangles < 2) edge.opposite[edge.triangles] = mesh.triangles[half.triangle][(half.corner + 2) % 3];
    ++edge.triangles;
    edges.of_triangle[half.triangle][half.corner] = static_cast<std::uint32_t>(edges.list.size() - 1);
  }
  return edges;
}

/// What a vertex sees around it.
struct Ring {
  Vec3 sum, border_sum;
  std::uint32_t neighbours = 0, border_neighbours = 0;
};

std::vector<Ring> rings_of(const Mesh& mesh, const Edges& edges) {
  std::vector<Ring> rings(mesh.positions.size());
  for (const Edge& edge : edges.list) {
    const std::uint32_t ends[2] = {edge.a, edge.b};
    for (int end = 0; end < 2; ++end) {
      Ring& ring = rings[ends[end]];
      const Vec3& other = mesh.positions[ends[1 - end]];
      ring.sum += other;
      ++ring.neighbours;
      if (!edge.border()) continue;
      ring.border_sum += other;
      ++ring.border_neighbours;
    }
  }
  return rings;
}

float beta(std::uint32_t valence) { return valence == 3 ? 3.0f / 16 : 3.0f / (8 * static_cast<float>(valence)); }

/// Weighted means of a vertex and its ring. `border_weight` is that of each border neighbour, `inner_weight` gives that
/// of each neighbour of an inner vertex. A corner where other than two borders meet stays.
template <class InnerWeight>
std::vector<Vec3> smoothed(const Mesh& mesh, const std::vector<Ring>& rings, float border_weight,
                           const InnerWeight& inner_weight) {
  std::vector<Vec3> moved = mesh.positions;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Ring& ring = rings[i];
    if (ring.border_neighbours == 2) {
      moved[i] = moved[i] * (1 - 2 * border_weight) + ring.border_sum * border_weight;
    } else if (ring.border_neighbours == 0 && ring.neighbours >= 3) {
      const float weight = inner_weight(ring.neighbours);
      moved[i] = moved[i] * (1 - static_cast<float>(ring.neighbours) * weight) + ring.sum * weight;
    }
  }
  return moved;
}

Mesh step(const Mesh& mesh) {
  const Edges edges = edges_of(mesh);
  Mesh finer;
  finer.positions = smoothed(mesh, rings_of(mesh, edges), 1.0f / 8, beta);
  const auto old_vertices = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Edge& edge : edges.list) {
    const Vec3 ends = mesh.positions[edge.a] + mesh.positions[edge.b];
    const Vec3 facing = mesh.positions[edge.opposite[0]] + mesh.positions[edge.opposite[1]];
    finer.positions.push_back(edge.border() ? ends * 0.5f : ends * (3.0f / 8) + facing * (1.0f / 8));
  }
  finer.triangles.reserve(mesh.triangles.size() * 4);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    std::array<std::uint32_t, 3> middle = edges.of_triangle[t];
    for (std::uint32_t& vertex : middle) vertex += old_vertices;
    finer.triangles.push_back({a, middle[0], middle[2]});
    finer.triangles.push_back({middle[0], b, middle[1]});
    finer.triangles.push_back({middle[2], middle[1], c});
    finer.triangles.push_back({middle[0], middle[1], middle[2]});
  }
  return finer;
}

}  // namespace

Mesh subdivide(Mesh mesh, std::uint32_t levels) {
  for (std::uint32_t level = 0; level < levels; ++level) mesh = step(mesh);
  if (levels == 0) return mesh;
  const auto limit_weight = [](std::uint32_t valence) {
    return 1 / (static_cast<float>(valence) + 3 / (8 * beta(valence)));
  };
  mesh.positions = smoothed(mesh, rings_of(mesh, edges_of(mesh)), 1.0f / 5, limit_weight);
  return mesh;
}

}  // namespace boxwood::pbrt
