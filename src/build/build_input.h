#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "boxwood/box.h"
#include "cost/known_use.h"
#include "math/large_memory.h"

namespace boxwood {

/// A primitive as a builder sees it: its box and its number. 32 bytes, two per cache line; builders permute these.
struct alignas(32) Reference {
  Vec3 lower;
  std::uint32_t primitive = 0;
  Vec3 upper;
  float seen = 0;  ///< 1 when some ray is known to end on it; a float, since it rides in a register with `upper`

  Box box() const { return {lower, upper}; }
  /// Twice the centre on one axis; comparisons and bins do not need the halving.
  float center2(int axis) const { return lower[axis] + upper[axis]; }
};
static_assert(sizeof(Reference) == 32);

/// What builders know of the geometry. They never see triangles or layouts.
class Geometry {
 public:
  virtual ~Geometry() = default;
  /// Centre of mass of a primitive (mean of a triangle's vertices). Thread safe.
  virtual Vec3 centroid(std::uint32_t primitive) const = 0;
  /// Box of the part of a primitive that lies in `region`; empty when nothing does. Thread safe.
  virtual Box clip(std::uint32_t primitive, const Box& region) const = 0;
  /// The corners of a primitive that is a triangle; false, and nothing is written, when it is something else. Clips
  /// into many slabs at once are quicker with it. Thread safe.
  virtual bool corners(std::uint32_t /*primitive*/, Vec3 (&)[3]) const { return false; }
};

/// Consumed by a build: it permutes `references` in place and frees them.
struct BuildInput {
  LargeVector<Reference> references;   ///< usable primitives only, in order of their numbers
  const Geometry* geometry = nullptr;  ///< null when only boxes are known; stages that need it must then refuse
  const KnownUse* use = nullptr;       ///< null when nothing is known of the rays to come; likewise
};

/// Sets Reference::seen from what is known.
inline void mark_seen(BuildInput& input) {
  if (!input.use || input.use->seen.empty()) return;
  for (Reference& reference : input.references) reference.seen = input.use->seen[reference.primitive] != 0 ? 1 : 0;
}

}  // namespace boxwood
