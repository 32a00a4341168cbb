#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "boxwood/box.h"
#include "boxwood/ray.h"
#include "boxwood/scene.h"

namespace boxwood {

/// A point of a triangle, nearest to some point in space. 36 bytes.
struct NearestPoint {
  float distance = std::numeric_limits<float>::infinity();  ///< world units; infinite when there is none
  Vec3 point;                                               ///< in world space
  float u = 0, v = 0;                      ///< barycentric weights of the triangle's second and third vertex
  std::uint32_t primitive = no_primitive;  ///< as in Hit
  std::uint32_t instance = no_primitive;

  bool valid() const { return primitive != no_primitive; }
  friend bool operator==(const NearestPoint&, const NearestPoint&) = default;
};

/// Names a triangle of a scene.
struct TriangleName {
  std::uint32_t instance = 0, primitive = 0;
  friend auto operator<=>(const TriangleName&, const TriangleName&) = default;  // NOLINT(modernize-use-nullptr)
};

/// Distances to a scene's triangles, in world space. Immutable; copies share it; queries are const and thread safe.
/// Holds about 80 bytes per placed triangle and nothing of the scene. Computed in double precision from float vertices:
/// of triangles at the same distance the smallest (instance, primitive) wins, whatever the tree. Unusable triangles are
/// left out. Points with a coordinate that is NaN, infinite or beyond largest_coordinate are near nothing. Batches run
/// in parallel in the caller's TBB arena; answers are the same for any number of threads. See docs/queries.md.
class DistanceQueries {
 public:
  /// O(n log n) for n placed triangles, in the caller's arena. Throws Error when the scene is too large.
  explicit DistanceQueries(const Scene& scene);

  /// The nearest point no farther than `within` (>= 0; world units), or one that is not valid(). O(log n) as a rule.
  /// Throws UsageError on a negative or NaN `within`.
  NearestPoint nearest_point(const Vec3& point, float within = std::numeric_limits<float>::infinity()) const;
  /// One answer per point. Throws UsageError when the spans differ in length.
  void nearest_points(std::span<const Vec3> points, std::span<NearestPoint> nearest,
                      float within = std::numeric_limits<float>::infinity()) const;
  /// The nearest points of the nearest.size() triangles that are nearest, in order; the rest is not valid(). Returns
  /// how many there are.
  std::size_t nearest_triangles(const Vec3& point, std::span<NearestPoint> nearest,
                                float within = std::numeric_limits<float>::infinity()) const;
  /// The first k of every point: nearest[i * k + n] is the n-th of point i. Throws UsageError unless nearest.size() is
  /// k * points.size().
  void nearest_triangles(std::span<const Vec3> points, std::size_t k, std::span<NearestPoint> nearest,
                         float within = std::numeric_limits<float>::infinity()) const;

  /// Triangles no farther than `radius` from `center`, ascending. O(log n + found) as a rule. Throws UsageError on a
  /// negative or NaN radius.
  std::vector<TriangleName> triangles_within(const Vec3& center, float radius) const;
  /// Triangles that touch the box, or miss it by less than 2^-29 of the largest coordinate, ascending; none of an empty
  /// box.
  std::vector<TriangleName> triangles_in(const Box& box) const;

  /// Whether triangles bound a volume: every edge, by the places of its ends, runs as often one way as the other. O(n
  /// log n) when first asked, by any thread.
  bool closed() const;
  /// Whether the surface winds around the point: the sum of signed crossings of an axis-parallel ray, whose ends of
  /// edges are told apart exactly, so that a ray through an edge or a vertex counts once. Right for points farther from
  /// the surface than 2^-48 of the largest coordinate. Throws Error unless closed().
  bool inside(const Vec3& point) const;
  /// Distance to the surface, negative inside; infinite for an empty scene or a point near nothing. Throws Error unless
  /// closed().
  float signed_distance(const Vec3& point) const;
  void signed_distances(std::span<const Vec3> points, std::span<float> distances) const;

  std::size_t bytes() const;

  struct Data;

 private:
  std::shared_ptr<const Data> data_;
};

}  // namespace boxwood
