#include "build/spatial/slab_clip.h"

#include <algorithm>

namespace boxwood {

void SlabClip::load_corners(std::uint32_t primitive) {
  Vec3 corners[3];
  is_triangle_ = geometry_.corners(primitive, corners);
  if (!is_triangle_) return;
  for (std::size_t c = 0; c < 3; ++c) corners_[c] = Float4{corners[c].x, corners[c].y, corners[c].z, 0};
}

/// Grows the parts by the points of an edge: its ends, where they lie in the reference's box, and where it crosses from
/// slab to slab.
void SlabClip::add_edge(Float4 from, Float4 to, int axis, std::int32_t first, std::int32_t last) {
  if (from[axis] > to[axis]) std::swap(from, to);
  const float lowest = box_.lower[axis], highest = box_.upper[axis];
  if (to[axis] < lowest || from[axis] > highest) return;
  const float length = to[axis] - from[axis];
  const auto at = [&](float place) {
    Float4 point = from + (to - from) * ((place - from[axis]) / length);
    point[axis] = place;
    return point;
  };
  const Float4 begin = from[axis] < lowest ? at(lowest) : from;
  const Float4 end = to[axis] > highest ? at(highest) : to;
  const std::int32_t begin_slab = std::clamp(slabs_(begin[axis], axis), first, last);
  const std::int32_t end_slab = std::clamp(slabs_(end[axis], axis), first, last);
  parts_[static_cast<std::size_t>(begin_slab)].grow(begin);
  for (std::int32_t s = begin_slab + 1; s <= end_slab; ++s) {
    const Float4 crossing = at(slabs_.border(s, axis));
    parts_[static_cast<std::size_t>(s) - 1].grow(crossing);
    parts_[static_cast<std::size_t>(s)].grow(crossing);
  }
  parts_[static_cast<std::size_t>(end_slab)].grow(end);
}

}  // namespace boxwood
