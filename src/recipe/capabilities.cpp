#include "recipe/capabilities.h"

#include <array>

namespace boxwood {

std::span<const CapabilityEntry> capabilities() {
  static constexpr std::array all = {
      CapabilityEntry{Capability::closest_and_any_hit, "closest and any hit"},
      CapabilityEntry{Capability::all_hits, "all hits"},
      CapabilityEntry{Capability::first_hits, "first k hits"},
      CapabilityEntry{Capability::filters, "filters"},
      CapabilityEntry{Capability::masks, "masks"},
      CapabilityEntry{Capability::placing, "nesting"},
      CapabilityEntry{Capability::custom, "custom primitives"},
  };
  return all;
}

bool has_capability(const Stage& stage, Capability capability) {
  if (capability == Capability::custom) return stage.custom;
  return capability == Capability::closest_and_any_hit || stage.kind == StageKind::layout;
}

}  // namespace boxwood
