#include "build/spatial/presplit.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace boxwood {
namespace {

/// A triangle is cut when its priority is this many times the mean, or more. A mesh of like triangles stays whole.
constexpr double cut_from = 2;
/// References per task. A fixed number: sums must not depend on the threads.
constexpr std::size_t chunk_size = 1 << 14;

template <class Body>
void for_chunks(std::size_t count, Body&& body) {
  tbb::parallel_for(std::size_t{0}, (count + chunk_size - 1) / chunk_size, [&](std::size_t chunk) {
    body(chunk, chunk * chunk_size, std::min(count, (chunk + 1) * chunk_size));
  });
}

/// Grows with the part of the box's area that an ideal fit to the triangle would not have.
float priority(const Reference& reference, const Geometry& geometry) {
  Vec3 corners[3];
  if (!geometry.corners(reference.primitive, corners)) return 0;
  const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const float least = 0.5f * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
  return std::cbrt(std::max(half_area(reference.box()) - least, 0.0f));
}

/// Cutting planes: the planes that halve the scene's cube, halve its halves, and so on.
class MedianPlanes {
 public:
  explicit MedianPlanes(const Box& scene) : origin_(scene.lower) {
    const Vec3 extent = scene.extent();
    cell_ = std::max({extent.x, extent.y, extent.z}) / cells;
  }

  struct Plane {
    std::size_t axis = 0;
    float at = 0;
    bool found = false;
  };

  /// The plane that halves the largest cube of those that cut the box; of several the one across its longest side.
  Plane coarsest(const Box& box) const {
    Plane best;
    int best_level = -1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::uint32_t first = cell(box.lower[axis], axis), last = cell(box.upper[axis], axis);
      if (first == last) continue;
      const int level = std::bit_width(first ^ last);
      const bool longer = box.extent()[axis] > box.extent()[best.axis];
      if (level < best_level || (level == best_level && !longer)) continue;
      const float at = origin_[axis] + cell_ * static_cast<float>(last >> (level - 1) << (level - 1));
      if (!(at > box.lower[axis] && at < box.upper[axis])) continue;
      best_level = level;
      best = {axis, at, true};
    }
    return best;
  }

 private:
  static constexpr float cells = 1 << 20;
  std::uint32_t cell(float at, std::size_t axis) const {
    return static_cast<std::uint32_t>(std::min((at - origin_[axis]) / cell_, cells - 1));
  }

  Vec3 origin_;
  float cell_;
};

struct Piece {
  Reference reference;
  std::uint32_t cuts;
};

Reference with_box(Reference reference, const Box& box) {
  reference.lower = box.lower;
  reference.upper = box.upper;
  return reference;
}

/// Appends the pieces of one reference, at most cuts + 1.
void cut(const Reference& whole, std::uint32_t cuts, const MedianPlanes& planes, const Geometry& geometry,
         LargeVector<Reference>& out) {
  std::vector<Piece> open{{whole, cuts}};
  while (!open.empty()) {
    const Piece piece = open.back();
    open.pop_back();
    const Box box = piece.reference.box();
    const MedianPlanes::Plane plane = piece.cuts > 0 ? planes.coarsest(box) : MedianPlanes::Plane{};
    if (!plane.found) {
      out.push_back(piece.reference);
      continue;
    }
    Box below = box, above = box;
    below.upper[plane.axis] = above.lower[plane.axis] = plane.at;
    below = geometry.clip(whole.primitive, below);
    above = geometry.clip(whole.primitive, above);
    if (below.empty() || above.empty()) {
      out.push_back(piece.reference);
      continue;
    }
    // The longer piece gets more of the cuts that are left.
    const auto longest = [](const Box& part) {
      const Vec3 e = part.extent();
      return std::max({e.x, e.y, e.z});
    };
    const float share = longest(below) / (longest(below) + longest(above));
    const auto below_cuts = static_cast<std::uint32_t>(std::floor(static_cast<float>(piece.cuts - 1) * share + 0.5f));
    open.push_back({with_box(whole, above), piece.cuts - 1 - below_cuts});
    open.push_back({with_box(whole, below), below_cuts});
  }
}

std::uint32_t cuts_of(float priority, double scale) {
  return static_cast<std::uint32_t>(std::min(double{priority} * scale, 1024.0));
}

/// The scale at which the cuts, each reference's priority times the scale rounded down, use the budget up.
double choose_scale(const std::vector<float>& priorities, double budget) {
  std::vector<double> sums((priorities.size() + chunk_size - 1) / chunk_size);
  const auto sum = [&](auto&& value) {
    for_chunks(priorities.size(), [&](std::size_t chunk, std::size_t begin, std::size_t end) {
      double total = 0;
      for (std::size_t i = begin; i < end; ++i) total += value(priorities[i]);
      sums[chunk] = total;
    });
    return std::reduce(sums.begin(), sums.end());
  };
  const double mean = sum([](float p) { return double{p}; }) / static_cast<double>(priorities.size());
  if (!(mean > 0)) return 0;
  double low = 0, high = 1 / (cut_from * mean);
  const auto cuts = [&](double scale) {
    return sum([scale](float p) { return static_cast<double>(cuts_of(p, scale)); });
  };
  if (cuts(high) <= budget) return high;
  for (int step = 0; step < 12; ++step) {
    const double middle = (low + high) / 2;
    (cuts(middle) <= budget ? low : high) = middle;
  }
  return low;
}

}  // namespace

LargeVector<Reference> presplit(LargeVector<Reference> references, const Geometry& geometry, float budget) {
  const std::size_t count = references.size();
  if (count == 0) return references;
  std::vector<float> priorities(count);
  std::vector<Box> boxes((count + chunk_size - 1) / chunk_size);
  for_chunks(count, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      priorities[i] = priority(references[i], geometry);
      boxes[chunk].grow(references[i].box());
    }
  });
  const MedianPlanes planes(std::reduce(boxes.begin(), boxes.end(), Box{}, unite));
  const double scale = choose_scale(priorities, static_cast<double>(count) * double{budget});

  // Cut per chunk, then put the chunks together.
  std::vector<LargeVector<Reference>> pieces(boxes.size());
  for_chunks(count, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    pieces[chunk].reserve(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t cuts = cuts_of(priorities[i], scale);
      if (cuts == 0) {
        pieces[chunk].push_back(references[i]);
      } else {
        cut(references[i], cuts, planes, geometry, pieces[chunk]);
      }
    }
  });
  std::vector<std::size_t> places{0};
  for (const auto& part : pieces) places.push_back(places.back() + part.size());
  references.resize(places.back());
  for_chunks(count, [&](std::size_t chunk, std::size_t, std::size_t) {
    std::ranges::copy(pieces[chunk], references.begin() + static_cast<std::ptrdiff_t>(places[chunk]));
  });
  return references;
}

}  // namespace boxwood
