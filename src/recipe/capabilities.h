#pragma once
#include <span>
#include <string_view>

#include "recipe/stage.h"

namespace boxwood {

/// What can be asked of a structure. Distances are asked of the scene, whatever the recipe (boxwood/distance.h).
enum class Capability : std::uint8_t {
  closest_and_any_hit,
  all_hits,
  first_hits,
  filters,
  masks,
  placing,
  custom,
  precise
};

struct CapabilityEntry {
  Capability capability;
  std::string_view name;  ///< for people
};

std::span<const CapabilityEntry> capabilities();

/// Whether structures of this layout or peer can be asked it. The queries refuse by the same answer.
bool has_capability(const Stage& stage, Capability capability);

/// Whether the stage is one that structures are made of: a layout or a peer.
inline bool answers_queries(const Stage& stage) {
  return stage.kind == StageKind::layout || stage.kind == StageKind::peer;
}

/// Of the triangle test that a recipe asks for.
Precision precision_of(std::span<const StageCall> calls);

/// Whether hits are those of testing every triangle in single precision, to the bit: not those of peers, and not those
/// in double precision.
bool answers_exactly(std::span<const StageCall> calls);

/// Whether custom primitives and triangles in double precision can take the place of triangles in a recipe: its layout
/// is one of wide nodes, and the walk is the default but for the precision.
bool walks_wide_nodes(std::span<const StageCall> calls);

}  // namespace boxwood
