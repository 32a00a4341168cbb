#pragma once
#include <cstdint>

namespace boxwood {

/// What one ray cost. Counted only by the *_counted queries; the timed ones carry no trace of it.
struct RayCounters {
  std::uint32_t steps = 0;            ///< inner nodes visited
  std::uint32_t leaves = 0;           ///< leaves visited
  std::uint32_t node_tests = 0;       ///< boxes (or planes) tested against the ray
  std::uint32_t node_hits = 0;        ///< of those, how many the ray met
  std::uint32_t primitive_tests = 0;  ///< triangles tested

  friend constexpr bool operator==(const RayCounters&, const RayCounters&) = default;
};

}  // namespace boxwood
