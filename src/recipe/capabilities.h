#pragma once
#include <span>
#include <string_view>

#include "recipe/stage.h"

namespace boxwood {

/// What can be asked of a structure. Distances are asked of the scene, whatever the recipe (boxwood/distance.h).
enum class Capability : std::uint8_t { closest_and_any_hit, all_hits, first_hits, filters, masks, placing, custom };

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

}  // namespace boxwood
