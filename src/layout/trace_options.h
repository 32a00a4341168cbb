#pragma once
#include <cstdint>

namespace boxwood {

enum class ChildOrder : std::uint8_t { none, axis, near };
enum class TraversalMode : std::uint8_t { iterative, recursive };

/// How a layout's tree is walked: the options of the recipe stage `trace`.
struct TraceOptions {
  ChildOrder order =
      ChildOrder::near;  ///< none: as stored; axis: by the ray's sign on the split axis; near: by distance
  bool cull = true;      ///< skip what lies behind the closest hit so far
  TraversalMode mode = TraversalMode::iterative;
  friend bool operator==(const TraceOptions&, const TraceOptions&) = default;
};

}  // namespace boxwood
