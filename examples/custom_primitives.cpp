// Primitives of one's own: balls, and a furball's hairs as round segments, mixed with triangles in one scene.
#include <boxwood/boxwood.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

using boxwood::Box;
using boxwood::CustomHit;
using boxwood::Ray;
using boxwood::Vec3;

namespace {

/// A cylinder of one radius with a half ball at either end; a ball, when both ends are the same point.
struct RoundSegment {
  Vec3 from, to;
  float radius;
};

class RoundSegments final : public boxwood::CustomPrimitives {
 public:
  explicit RoundSegments(std::vector<RoundSegment> segments) : segments_(std::move(segments)) {}

  std::uint32_t size() const override { return static_cast<std::uint32_t>(segments_.size()); }

  Box bounds(std::uint32_t primitive) const override {
    const auto& [from, to, radius] = segments_[primitive];
    const Vec3 around{radius, radius, radius};
    return {min(from, to) - around, max(from, to) + around};
  }

  void intersect(std::span<const Ray> rays, std::span<const std::uint32_t> primitives,
                 std::span<CustomHit> hits) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) intersect_one(rays[i], segments_[primitives[i]], hits[i]);
  }

 private:
  /// u is how far along the segment the hit lies. In double, because a hair is thin for its distance.
  static void intersect_one(const Ray& ray, const RoundSegment& segment, CustomHit& hit) {
    const double squared = product(ray.direction, ray.direction), radius = static_cast<double>(segment.radius);
    const Vec3 axis = segment.to - segment.from, offset = ray.origin - segment.from;
    const double axis2 = product(axis, axis), along = product(axis, ray.direction), start = product(axis, offset);
    const auto take = [&](double t, double u) {
      const auto rounded = static_cast<float>(t);
      if (rounded >= ray.t_near && rounded <= ray.t_far && rounded < hit.t) hit = {rounded, static_cast<float>(u), 0};
    };
    // The side, where it is between the ends.
    const double a = axis2 * squared - along * along;
    const double b = axis2 * product(offset, ray.direction) - start * along;
    const double c = axis2 * (product(offset, offset) - radius * radius) - start * start;
    if (const double under = b * b - a * c; a > 0 && under >= 0) {
      for (const double root : {-std::sqrt(under), std::sqrt(under)}) {
        const double t = (root - b) / a, u = (start + t * along) / axis2;
        if (u >= 0 && u <= 1) take(t, u);
      }
    }
    // The halves of balls beyond them.
    for (const double end : {0.0, 1.0}) {
      const Vec3 from_center = end == 0 ? offset : ray.origin - segment.to;
      const double half_b = product(from_center, ray.direction);
      const double under = half_b * half_b - squared * (product(from_center, from_center) - radius * radius);
      if (under < 0) continue;
      for (const double root : {-std::sqrt(under), std::sqrt(under)}) {
        const double t = (root - half_b) / squared;
        const double u = axis2 > 0 ? (start + t * along) / axis2 : end;
        if (end == 0 ? u <= 0 : u >= 1) take(t, end);
      }
    }
  }
  static double product(const Vec3& a, const Vec3& b) {
    return static_cast<double>(a.x) * static_cast<double>(b.x) + static_cast<double>(a.y) * static_cast<double>(b.y) +
           static_cast<double>(a.z) * static_cast<double>(b.z);
  }

  std::vector<RoundSegment> segments_;
};

/// Hairs of four segments each, from a ball of radius 1 outwards, curled.
std::vector<RoundSegment> furball(int hairs) {
  std::vector<RoundSegment> out;
  for (int i = 0; i < hairs; ++i) {
    const float z = 1 - 2 * (static_cast<float>(i) + 0.5f) / static_cast<float>(hairs);
    const float turn = 2.3999632f * static_cast<float>(i), ring = std::sqrt(1 - z * z);
    Vec3 at{ring * std::cos(turn), ring * std::sin(turn), z}, way = at * 0.15f;
    for (int n = 0; n < 4; ++n) {
      const Vec3 next = at + way;
      out.push_back({at, next, 0.004f});
      way = way + Vec3{-way.y, way.x, -0.05f} * 0.3f;
      at = next;
    }
  }
  return out;
}

}  // namespace

int main() try {
  const auto hairs = std::make_shared<const RoundSegments>(furball(20'000));
  const auto balls = std::make_shared<const RoundSegments>(
      std::vector<RoundSegment>{{{2, 0, 0}, {2, 0, 0}, 0.5f}, {{-2, 0, 0}, {-2, 0, 0}, 0.5f}});
  const std::vector<boxwood::Structure> parts = {boxwood::build(boxwood::load("generate:sphere")),
                                                 boxwood::build(hairs), boxwood::build(balls)};
  const std::vector<boxwood::Instance> instances = {{0, {}}, {1, {}}, {2, {}}};
  const boxwood::Structure scene = boxwood::place(parts, instances);

  // A picture's worth of parallel rays.
  constexpr int side = 64;
  std::vector<Ray> rays;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const auto at = [](int n) { return 6 * (static_cast<float>(n) + 0.5f) / side - 3; };
      rays.push_back({.origin = {at(x), at(y), 5}, .direction = {0, 0, -1}});
    }
  }
  std::vector<boxwood::Hit> hits(rays.size());
  scene.closest_hits(rays, hits);
  std::size_t counts[3] = {};
  for (const boxwood::Hit& hit : hits) {
    if (hit.valid()) ++counts[hit.instance];
  }
  std::printf("%zu rays end on triangles, %zu on hairs, %zu on balls\n", counts[0], counts[1], counts[2]);
  return counts[1] > 0 && counts[2] > 0 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "custom_primitives: %s\n", error.what());
  return 1;
}
