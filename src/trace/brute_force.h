#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "boxwood/ray.h"
#include "boxwood/scene.h"
#include "trace/leaf_triangle.h"

namespace boxwood {

/// Every usable triangle of every instance against every ray, with the triangle test and the tie rule of all layouts:
/// the reference that each of them must equal bit for bit. Queries are const and thread safe, O(triangles) per ray; the
/// batches run in parallel in the caller's arena.
class BruteForce {
 public:
  /// Copies what it needs. Throws Error when an instance's transform has no inverse. O(n).
  explicit BruteForce(const Scene& scene);

  Hit closest_hit(const Ray& ray, std::uint32_t mask = every_bit) const;
  bool any_hit(const Ray& ray, std::uint32_t mask = every_bit) const;
  /// Every hit, in the order of comes_before().
  std::vector<Hit> all_hits(const Ray& ray, std::uint32_t mask = every_bit) const;
  /// One answer per ray. Throws UsageError when the spans differ in length.
  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const;
  void any_hits(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;

  /// One instance: its triangles, which instances of a mesh share, and the way into its space.
  struct Placed {
    std::uint32_t first = 0, count = 0;  ///< range of `triangles`
    Transform world_to_object;
    std::uint32_t mask = every_bit;
    bool identity = false;  ///< world_to_object changes nothing
  };
  struct Data {
    std::vector<LeafTriangle> triangles;  ///< mesh by mesh
    std::vector<Placed> instances;        ///< in the scene's order
  };

 private:
  Data data_;
};

}  // namespace boxwood
