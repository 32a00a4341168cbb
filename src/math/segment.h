#pragma once
#include "boxwood/box.h"
#include "boxwood/ray.h"

namespace boxwood {

/// A ray up to where it ends, in a form that is quick to test against many boxes. 32 bytes.
class Segment {
 public:
  /// From ray.t_near to `end`.
  Segment(const Ray& ray, float end);

  /// Whether it meets the box, which must not be empty. Never true for a box while false for one that contains it. A
  /// ray that runs in the plane of a face may miss.
  bool meets(const Box& box) const {
    float near;
    return meets(box, near);
  }
  /// Also tells where it enters the box.
  bool meets(const Box& box, float& near) const {
    const Lanes lower{box.lower.x, box.lower.y, box.lower.z, 0}, upper{box.upper.x, box.upper.y, box.upper.z, 0};
    const Lanes a = (lower - origin_) * inverse_, b = (upper - origin_) * inverse_;
    const Lanes enter = a < b ? a : b, leave = a < b ? b : a;
    near = origin_[3];
    float far = inverse_[3];
    for (int axis = 0; axis < 3; ++axis) {
      near = enter[axis] > near ? enter[axis] : near;
      far = leave[axis] < far ? leave[axis] : far;
    }
    return near <= far;
  }

 private:
  using Lanes [[gnu::vector_size(16)]] = float;
  Lanes origin_;   // and t_near
  Lanes inverse_;  // of the direction, finite; and the end
};
static_assert(sizeof(Segment) == 32);

}  // namespace boxwood
