#pragma once
#include "boxwood/ray.h"

namespace boxwood {

/// Where a walk brings every hit it comes by: in no order, a triangle of several leaves several times.
class HitSink {
 public:
  explicit HitSink(float first_cutoff) : cutoff_(first_cutoff) {}
  virtual ~HitSink() = default;

  /// A hit within the ray's range of t.
  virtual void offer(const Hit& hit) = 0;
  /// Hits beyond this t are of no more use. Never grows.
  float cutoff() const { return cutoff_; }

 protected:
  HitSink(const HitSink&) = default;
  HitSink& operator=(const HitSink&) = default;
  void lower_cutoff(float t) { cutoff_ = t < cutoff_ ? t : cutoff_; }

 private:
  float cutoff_;
};

/// The order of hits along a ray: by t, then instance, then primitive. The same hit found twice has the same bits.
inline bool comes_before(const Hit& a, const Hit& b) {
  if (a.t != b.t) return a.t < b.t;
  return a.instance != b.instance ? a.instance < b.instance : a.primitive < b.primitive;
}

}  // namespace boxwood
