#pragma once
#include <cstdint>

namespace boxwood {

enum class ChildOrder : std::uint8_t { none, axis, near };
enum class TraversalMode : std::uint8_t { iterative, recursive };
enum class Precision : std::uint8_t { single_test, double_test };

/// How a layout's tree is walked: the options of the recipe stage `trace`.
struct TraceOptions {
  ChildOrder order = ChildOrder::near;  ///< as stored, by the ray's sign on the split axis, or by distance
  bool cull = true;                     ///< skip what lies behind the closest hit so far or outside t_near…t_far
  TraversalMode mode = TraversalMode::iterative;
  bool simd = true;  ///< use a SIMD kernel where the layout has one for this walk; the answers are the same
  Precision precision = Precision::single_test;  ///< of the triangle test; boxes are single in either
  friend bool operator==(const TraceOptions&, const TraceOptions&) = default;
};

}  // namespace boxwood
