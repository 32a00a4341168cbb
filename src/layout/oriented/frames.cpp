#include "layout/oriented/frames.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

#include "math/principal_axes.h"

namespace boxwood {
namespace {

/// Moments of a triangle's area, about `origin`: its own are those of its corners with a twelfth of the area each and
/// of its centre with three quarters (Gottschalk, Lin, Manocha 1996, "OBBTree").
Moments moments_of(const Mesh& mesh, std::uint32_t triangle, const Vec3& origin) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vec3 p[3] = {mesh.positions[a] - origin, mesh.positions[b] - origin, mesh.positions[c] - origin};
  const Vec3 center = (p[0] + p[1] + p[2]) * (1.0f / 3);
  // A sliver counts for something too: its box is as long as any.
  const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]), ab = p[1] - p[0], ac = p[2] - p[0];
  const double area = std::hypot(static_cast<double>(normal.x), normal.y, normal.z) +
                      1e-3 * static_cast<double>(dot(ab, ab) + dot(ac, ac));
  Moments moments;
  for (const Vec3& corner : p) moments.add(corner.x, corner.y, corner.z, area / 12);
  moments.add(center.x, center.y, center.z, area * 3 / 4);
  return moments;
}

/// Of everything below each node: every node stands after its parent, so children are done first from the back.
std::vector<Moments> moments_below(const Tree& tree, const Mesh& mesh) {
  const Vec3 origin = tree.nodes[0].bounds.center();
  std::vector<Moments> moments(tree.nodes.size());
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const Tree::Node& node = tree.nodes[i];
    for (std::uint32_t c = node.first; c < node.first + node.count; ++c) {
      moments[i].add(node.is_leaf() ? moments_of(mesh, tree.references[c], origin) : moments[c]);
    }
  }
  return moments;
}

Frame frame_of(const Moments& moments) {
  const PrincipalAxes axes = principal_axes(moments);
  Frame frame;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) frame.axis[i][j] = static_cast<float>(axes.axis[i][j]);
  }
  return frame;
}

/// Whether turning leaves less than `area` of the children's surface.
bool pays(const Tree& tree, const Tree::Node& node, const Mesh& mesh, const Frame& frame, float area) {
  float as_they_are = 0, turned = 0;
  for (std::uint32_t c = node.first; c < node.first + node.count; ++c) as_they_are += half_area(tree.nodes[c].bounds);
  const float limit = area * as_they_are;
  for (std::uint32_t c = node.first; c < node.first + node.count && turned <= limit; ++c) {
    turned += half_area(turned_box(tree, c, mesh, frame));
  }
  return turned < limit;
}

float rounded_down(double value) {
  return std::nextafter(static_cast<float>(value), -std::numeric_limits<float>::infinity());
}

float rounded_up(double value) {
  return std::nextafter(static_cast<float>(value), std::numeric_limits<float>::infinity());
}

}  // namespace

Frames::Frames(const Tree& tree, const Mesh& mesh, float area) : places_(tree.nodes.size(), world) {
  if (tree.empty() || area == 0) return;
  const std::vector<Moments> moments = moments_below(tree, mesh);
  std::vector<std::uint8_t> turns(tree.nodes.size());
  tbb::parallel_for(std::size_t{0}, tree.nodes.size(), [&](std::size_t i) {
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf() || !(moments[i].weight > 0) || !std::isfinite(moments[i].weight)) return;
    turns[i] = pays(tree, node, mesh, frame_of(moments[i]), area);
  });
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    if (!turns[i]) continue;
    places_[i] = count();
    frames_.push_back(frame_of(moments[i]));
  }
}

Box turned_box(const Tree& tree, std::uint32_t node, const Mesh& mesh, const Frame& frame) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double lower[3] = {infinity, infinity, infinity}, upper[3] = {-infinity, -infinity, -infinity};
  std::vector<std::uint32_t> stack{node};
  const auto add_triangle = [&](std::uint32_t triangle) {
    for (const std::uint32_t vertex : mesh.triangles[triangle]) {
      const Vec3& p = mesh.positions[vertex];
      for (int i = 0; i < 3; ++i) {
        // Products of floats are exact in double; what the two sums round is far below the last place of a float.
        const double at = static_cast<double>(frame.axis[i][0]) * p.x + static_cast<double>(frame.axis[i][1]) * p.y +
                          static_cast<double>(frame.axis[i][2]) * p.z;
        lower[i] = at < lower[i] ? at : lower[i];
        upper[i] = at > upper[i] ? at : upper[i];
      }
    }
  };
  while (!stack.empty()) {
    const Tree::Node& below = tree.nodes[stack.back()];
    stack.pop_back();
    for (std::uint32_t i = below.first; i < below.first + below.count; ++i) {
      if (below.is_leaf()) {
        add_triangle(tree.references[i]);
      } else {
        stack.push_back(i);
      }
    }
  }
  Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.lower[i] = rounded_down(lower[i]);
    box.upper[i] = rounded_up(upper[i]);
  }
  return box;
}

}  // namespace boxwood
