// The instruction sets that a test can run, one at a time, and the comparison of hits to the bit.
#pragma once
#include <hwy/targets.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <span>
#include <vector>

#include "boxwood/ray.h"

namespace boxwood {

/// Restricts dispatch to one instruction set while it lives.
class OnlyTarget {
 public:
  explicit OnlyTarget(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    update();
  }
  ~OnlyTarget() {
    hwy::SetSupportedTargetsForTest(0);
    update();
  }
  OnlyTarget(const OnlyTarget&) = delete;
  OnlyTarget& operator=(const OnlyTarget&) = delete;

 private:
  static void update() { hwy::GetChosenTarget().Update(hwy::SupportedTargets()); }
};

/// What this machine can run of what kernels are compiled for, the best last. What every machine can run comes first.
inline std::vector<std::int64_t> testable_targets(std::initializer_list<std::int64_t> better = {HWY_SSE4, HWY_AVX2,
                                                                                                HWY_AVX3}) {
  std::vector<std::int64_t> out{HWY_STATIC_TARGET};
  for (const std::int64_t target : better) {
    if (target < HWY_STATIC_TARGET && (hwy::SupportedTargets() & target) != 0) out.push_back(target);
  }
  return out;
}

inline bool same_bits(const Hit& a, const Hit& b) { return std::memcmp(&a, &b, sizeof(Hit)) == 0; }

/// First ray whose hit differs, or npos.
inline std::size_t first_difference(std::span<const Hit> a, std::span<const Hit> b) {
  const auto [x, y] = std::mismatch(a.begin(), a.end(), b.begin(), same_bits);
  return static_cast<std::size_t>(x - a.begin());
}

}  // namespace boxwood
