#include <algorithm>

#include "refine/order/rules.h"

namespace boxwood {
namespace {

/// Areas of the triangles below a node.
struct Areas {
  double sum = 0, largest = 0;
  std::uint64_t count = 0;

  void add(const Areas& other) {
    sum += other.sum;
    largest = std::max(largest, other.largest);
    count += other.count;
  }
  double of(AreaOf area) const {
    return area == AreaOf::largest ? largest : sum / static_cast<double>(std::max<std::uint64_t>(1, count));
  }
};

Areas area_of(const Geometry& geometry, std::uint32_t primitive) {
  Vec3 corners[3];
  if (!geometry.corners(primitive, corners)) return {0, 0, 1};
  const double area = double{length(cross(corners[1] - corners[0], corners[2] - corners[0]))} / 2;
  return {area, area, 1};
}

}  // namespace

Orders order_by_sato(const Tree& tree, const Geometry& geometry, AreaOf area) {
  Orders orders(tree.nodes.size(), ChildOrderChoice::as_it_is);
  std::vector<Areas> areas(tree.nodes.size());
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {  // children come after their parents
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf()) {
      for (std::uint32_t r = 0; r < node.count; ++r) areas[i].add(area_of(geometry, tree.references[node.first + r]));
      continue;
    }
    const Areas &left = areas[node.first], &right = areas[node.first + 1];
    areas[i].add(left);
    areas[i].add(right);
    orders[i] = left.of(area) >= right.of(area) ? ChildOrderChoice::as_stored : ChildOrderChoice::swapped;
  }
  return orders;
}

}  // namespace boxwood
