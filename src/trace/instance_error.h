#pragma once
#include "boxwood/box.h"
#include "boxwood/transform.h"
#include "trace/reach.h"

namespace boxwood {

/// How much wider than for triangles alone boxes around an instance must be tested, because its leaves round the ray a
/// second time: with bound (gain * |origin| + offset) instead of |origin| + reach. World units.
struct InstanceError {
  float gain = 1;    ///< >= 1; from 2 for a rigid motion to about 6, more for shears
  float offset = 0;  ///< >= reach of the instance's box

  void grow(const InstanceError& other) {
    gain = gain > other.gain ? gain : other.gain;
    offset = offset > other.offset ? offset : other.offset;
  }
};

/// The bound for one instance whose object-space triangles lie in `object_box`; `world_to_object` is the inverse as
/// rounded, and its residual is part of the bound. `below`: of what is placed, more than {0, 1} where that maps rays as
/// well. In norms of absolute row sums.
InstanceError instance_error(const Transform& object_to_world, const Transform& world_to_object, const Box& object_box,
                             Reach below = {});

}  // namespace boxwood
