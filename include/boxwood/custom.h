#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string_view>

#include "boxwood/box.h"
#include "boxwood/ray.h"
#include "boxwood/recipe.h"
#include "boxwood/structure.h"

namespace boxwood {

/// Where a ray first hits a primitive.
struct CustomHit {
  float t = std::numeric_limits<float>::infinity();  ///< in units of the direction; infinite or NaN: not hit
  float u = 0, v = 0;                                ///< whatever the primitive means by them
};

/// Primitives of the caller's own kind: spheres, curves, patches. Derive, and build a structure over them.
class CustomPrimitives {
 public:
  CustomPrimitives() = default;
  CustomPrimitives(const CustomPrimitives&) = default;
  CustomPrimitives& operator=(const CustomPrimitives&) = default;
  virtual ~CustomPrimitives() = default;

  /// How many there are, below 2^32 - 2. They are numbered from 0; hits name them in Hit::primitive.
  virtual std::uint32_t size() const = 0;
  /// Holds every point where the primitive can be hit, up to 2^-20 of the largest coordinate of the scene. Primitives
  /// whose box is empty, or has coordinates that are NaN, infinite or beyond largest_coordinate, are left out. Called
  /// once for each by the build, from several threads.
  virtual Box bounds(std::uint32_t primitive) const = 0;
  /// For every i: hits[i] = where rays[i] first hits primitives[i] with t in [rays[i].t_near, rays[i].t_far]. The three
  /// spans are of the same length, and hits come as misses. Rays are valid, in the space of the structure, and as long
  /// as is of use. An answer with a t outside the range counts as a miss. A hit must have the same t, u and v whatever
  /// the range is: so hits behind the first are found by asking again from there on. Called from the threads that
  /// trace, several at once where they are several; what it throws ends the query.
  virtual void intersect(std::span<const Ray> rays, std::span<const std::uint32_t> primitives,
                         std::span<CustomHit> hits) const = 0;
};

/// Builds over primitives of the caller's own, which it keeps. All queries work; batches bring up to some hundred rays
/// with their primitives to a call of intersect(). place() mixes it with structures over triangles. The layout of the
/// recipe is `wide(k)` or `compressed(k)` of up to 16 children, under the default walk; builders see nothing but boxes.
/// O(n log n). Throws UsageError on other recipes, Error on too many primitives.
Structure build(std::shared_ptr<const CustomPrimitives> primitives, const Recipe& recipe,
                const BuildOptions& options = {});
Structure build(std::shared_ptr<const CustomPrimitives> primitives, std::string_view recipe = "default",
                const BuildOptions& options = {});

}  // namespace boxwood
