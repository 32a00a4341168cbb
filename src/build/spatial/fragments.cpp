#include "build/spatial/fragments.h"

#include <algorithm>

namespace boxwood {
namespace {

void set_box(Reference& reference, const Box& box) {
  reference.lower = box.lower;
  reference.upper = box.upper;
}

void fit(Fragments& part, std::span<const Reference> references) {
  part.bounds = part.centers = {};
  for (const Reference& reference : references) {
    const Box4 box = box4(reference);
    part.bounds.grow(box);
    part.centers.grow(box.lower + box.upper);
  }
}

}  // namespace

/// The first `left_count` references of the node stay where they are, the others move behind the left side's room.
FragmentPair FragmentDivider::hand_out(const Fragments& node, std::uint32_t left_count, bool room) {
  const std::uint32_t right_count = node.size() - left_count;
  const auto left_room = room ? static_cast<std::uint32_t>(std::uint64_t{node.room()} * left_count / node.size()) : 0;
  FragmentPair pair;
  pair.left.begin = node.begin;
  pair.left.end = node.begin + left_count;
  pair.left.limit = pair.right.begin = pair.left.end + left_room;
  pair.right.end = pair.right.begin + right_count;
  pair.right.limit = room ? node.limit : pair.right.end;
  if (left_room > 0) {
    const auto first = array_.begin() + pair.left.end;
    std::copy_backward(first, first + right_count, array_.begin() + pair.right.end);
  }
  return pair;
}

FragmentPair FragmentDivider::fitted(FragmentPair pair) const {
  fit(pair.left, references(pair.left));
  fit(pair.right, references(pair.right));
  return pair;
}

FragmentPair FragmentDivider::by_centers(const Fragments& node, const Split& split, bool room) {
  Box4 left_centers, right_centers;
  const std::size_t left =
      divide_at(references(node), split.slabs.scale(), split.axis, split.border, left_centers, right_centers);
  FragmentPair pair = hand_out(node, static_cast<std::uint32_t>(left), room);
  pair.left.bounds = split.left;
  pair.left.centers = left_centers;
  pair.right.bounds = split.right;
  pair.right.centers = right_centers;
  return pair;
}

FragmentPair FragmentDivider::by_count(const Fragments& node) {
  const std::span<Reference> all = references(node);
  const int axis = longest_axis(node.centers);
  const auto middle = all.begin() + node.size() / 2;
  std::nth_element(all.begin(), middle, all.end(), [&](const Reference& a, const Reference& b) {
    if (a.center2(axis) != b.center2(axis)) return a.center2(axis) < b.center2(axis);
    return a.primitive < b.primitive;
  });
  return fitted(hand_out(node, node.size() / 2, true));
}

FragmentPair FragmentDivider::by_space(const Fragments& node, const Split& split) {
  cut_.clear();
  right_.clear();
  std::uint32_t left = node.begin;
  for (const Reference& reference : references(node)) {
    const Box4 box = box4(reference);
    const std::int32_t first = split.slabs(box.lower[split.axis], split.axis);
    const std::int32_t last = split.slabs(box.upper[split.axis], split.axis);
    if (last < split.border) {
      array_[left++] = reference;
    } else {
      (first >= split.border ? right_ : cut_).push_back(reference);
    }
  }
  // Cut ones stay within the room: the split was refused otherwise.
  Split sides = split;
  LargeVector<Reference> cut;
  std::swap(cut, cut_);
  for (const Reference& reference : cut) place_cut(reference, split, sides);
  for (const Reference& reference : cut_) array_[left++] = reference;
  std::swap(cut, cut_);
  Fragments grown = node;
  grown.end = left + static_cast<std::uint32_t>(right_.size());
  std::copy(right_.begin(), right_.end(), array_.begin() + left);
  return fitted(hand_out(grown, left - node.begin, true));
}

/// Left parts are collected in cut_, right parts in right_. `sides` keeps count of what the split costs by now.
void FragmentDivider::place_cut(const Reference& reference, const Split& split, Split& sides) {
  const auto axis = static_cast<std::size_t>(split.axis);
  const float border = split.slabs.border(split.border, split.axis);
  Box left_region = reference.box(), right_region = reference.box();
  left_region.upper[axis] = std::min(left_region.upper[axis], border);
  right_region.lower[axis] = std::max(right_region.lower[axis], border);
  const Box left = geometry_->clip(reference.primitive, left_region);
  const Box right = geometry_->clip(reference.primitive, right_region);

  bool to_left = !left.empty(), to_right = !right.empty();
  if (!to_left && !to_right) to_left = true;
  if (unsplit_ && to_left && to_right) {
    Box4 grown_left = sides.left, grown_right = sides.right;
    grown_left.grow(box4(reference));
    grown_right.grow(box4(reference));
    const auto left_count = static_cast<float>(sides.left_count), right_count = static_cast<float>(sides.right_count);
    const float left_area = half_area(sides.left), right_area = half_area(sides.right);
    const float both = left_area * left_count + right_area * right_count;
    const float left_only = half_area(grown_left) * left_count + right_area * (right_count - 1);
    const float right_only = left_area * (left_count - 1) + half_area(grown_right) * right_count;
    if (left_only < both && left_only <= right_only) {
      to_right = false;
      sides.left = grown_left;
    } else if (right_only < both) {
      to_left = false;
      sides.right = grown_right;
    }
  }
  Reference part = reference;
  if (to_left) {
    if (to_right) set_box(part, left);
    cut_.push_back(part);
  } else {
    --sides.left_count;
  }
  if (to_right) {
    if (to_left) set_box(part, right);
    right_.push_back(part);
  } else {
    --sides.right_count;
  }
}

}  // namespace boxwood
