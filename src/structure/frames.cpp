#include "structure/frames.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace boxwood {
namespace {

/// Triangles smaller than this share of a frame go into frames of their own: 30 times what boxes are widened by, which
/// is 2^-18 of the frame.
constexpr double least_detail = 0x1p-13;
/// Such frames are at most this large: eight of the smallest triangles beside each other at least.
constexpr double largest_inner_frame = 0x1p-10;
/// Fewer triangles are not worth moving the ray for.
constexpr std::size_t least_in_frame = 8;
/// Frames smaller than this share of the scene's largest coordinate gain nothing: the triangle test itself, in double,
/// makes boxes as wide.
constexpr double least_frame = 0x1p-28;

struct DoubleBox {
  DoubleVec3 lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};

  void grow(const DoubleVec3& point) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], point[axis]);
      upper[axis] = std::max(upper[axis], point[axis]);
    }
  }
  double center(std::size_t axis) const { return 0.5 * lower[axis] + 0.5 * upper[axis]; }
  double extent(std::size_t axis) const { return upper[axis] - lower[axis]; }
  double largest_extent() const { return std::max({extent(0), extent(1), extent(2)}); }
  std::size_t longest_axis() const {
    return extent(0) >= extent(1) && extent(0) >= extent(2) ? 0 : extent(1) >= extent(2) ? 1 : 2;
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();
};

DoubleBox box_of(const PreciseTriangle& triangle) {
  DoubleBox box;
  for (const DoubleVec3& vertex : {triangle.a, triangle.b, triangle.c}) box.grow(vertex);
  return box;
}

DoubleBox box_of(std::span<const PreciseTriangle> triangles) {
  DoubleBox box;
  for (const PreciseTriangle& triangle : triangles) {
    for (const DoubleVec3& vertex : {triangle.a, triangle.b, triangle.c}) box.grow(vertex);
  }
  return box;
}

/// Parts no larger than `size` each, by halving the longest side, over and over. Permutes the triangles.
void divide(std::span<PreciseTriangle> triangles, double size, std::vector<std::span<PreciseTriangle>>& parts) {
  const DoubleBox box = box_of(triangles);
  if (box.largest_extent() <= size) {
    parts.push_back(triangles);
    return;
  }
  const std::size_t axis = box.longest_axis();
  const double middle = box.center(axis);
  const auto right = std::stable_partition(triangles.begin(), triangles.end(), [&](const PreciseTriangle& triangle) {
    return box_of(triangle).center(axis) < middle;
  });
  const auto count = static_cast<std::size_t>(right - triangles.begin());
  divide(triangles.first(count), size, parts);
  divide(triangles.subspan(count), size, parts);
}

/// One frame: its own triangles, then those of the frames inside.
class FrameBuilder {
 public:
  FrameBuilder(std::span<PreciseTriangle> triangles, double least_size) {
    const DoubleBox box = box_of(triangles);
    for (std::size_t axis = 0; axis < 3; ++axis) out_.center[axis] = box.center(axis);
    const double size = box.largest_extent();
    // Sizes that no double is the inverse of are beyond what the triangle test can tell.
    out_.scale = std::ldexp(1.0, -std::clamp(std::ilogb(size), -1000, 1000));
    const auto inner = size < least_size
                           ? triangles.end()
                           : std::stable_partition(triangles.begin(), triangles.end(), [&](const PreciseTriangle& t) {
                               return box_of(t).largest_extent() >= size * least_detail;
                             });
    out_.content.reserve(triangles.size());
    references_.reserve(triangles.size());
    add_triangles(std::span(triangles.begin(), inner));
    std::vector<std::span<PreciseTriangle>> parts;
    if (inner != triangles.end()) divide(std::span(inner, triangles.end()), size * largest_inner_frame, parts);
    for (const std::span<PreciseTriangle> part : parts) {
      if (part.size() < least_in_frame) {
        add_triangles(part);
      } else {
        inner_.push_back(part);
      }
    }
  }

  const std::vector<std::span<PreciseTriangle>>& inner() const { return inner_; }

  PreciseFrameTree build(std::uint32_t first_inner, const Pipeline& pipeline) {
    PreciseTriangle link;
    for (const std::span<PreciseTriangle> part : inner_) {
      link.frame = first_inner++;
      add(box_of(part), link);
    }
    out_.tree = pipeline.tree({std::move(references_), nullptr, nullptr});
    return std::move(out_);
  }

 private:
  void add_triangles(std::span<const PreciseTriangle> triangles) {
    for (const PreciseTriangle& triangle : triangles) add(box_of(triangle), triangle);
  }
  void add(const DoubleBox& box, const PreciseTriangle& content) {
    Reference reference{{}, static_cast<std::uint32_t>(out_.content.size()), {}, 0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      reference.lower[axis] = static_cast<float>((box.lower[axis] - out_.center[axis]) * out_.scale);
      reference.upper[axis] = static_cast<float>((box.upper[axis] - out_.center[axis]) * out_.scale);
    }
    references_.push_back(reference);
    out_.content.push_back(content);
  }

  PreciseFrameTree out_;
  LargeVector<Reference> references_;
  std::vector<std::span<PreciseTriangle>> inner_;
};

}  // namespace

std::vector<PreciseFrameTree> build_frames(LargeVector<PreciseTriangle> triangles, const Pipeline& pipeline) {
  std::vector<PreciseFrameTree> frames;
  if (triangles.empty()) return frames;
  const double least_size = reach_of(triangles) * least_frame;
  std::vector<std::span<PreciseTriangle>> open = {std::span<PreciseTriangle>(triangles)};
  while (!open.empty()) {
    std::vector<std::optional<FrameBuilder>> builders(open.size());
    tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t i) { builders[i].emplace(open[i], least_size); });
    // Frames inside are numbered after all of their parents' generation.
    const std::size_t begin = frames.size();
    auto next = static_cast<std::uint32_t>(begin + open.size());
    std::vector<std::uint32_t> first_inner;
    open.clear();
    for (const auto& builder : builders) {
      first_inner.push_back(next);
      next += static_cast<std::uint32_t>(builder->inner().size());
      open.insert(open.end(), builder->inner().begin(), builder->inner().end());
    }
    frames.resize(begin + builders.size());
    tbb::parallel_for(std::size_t{0}, builders.size(), [&](std::size_t i) {
      frames[begin + i] = builders[i]->build(first_inner[i], pipeline);
      builders[i].reset();
    });
  }
  return frames;
}

double reach_of(std::span<const PreciseTriangle> triangles) {
  double reach = 0;
  for (const PreciseTriangle& triangle : triangles) {
    for (const DoubleVec3& vertex : {triangle.a, triangle.b, triangle.c}) {
      for (std::size_t axis = 0; axis < 3; ++axis) reach = std::max(reach, std::fabs(vertex[axis]));
    }
  }
  return reach;
}

}  // namespace boxwood
