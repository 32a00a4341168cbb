#include "recipe/capabilities.h"

#include <algorithm>
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
      CapabilityEntry{Capability::precise, "double precision"},
  };
  return all;
}

bool has_capability(const Stage& stage, Capability capability) {
  if (capability == Capability::custom || capability == Capability::precise) return stage.custom;
  return capability == Capability::closest_and_any_hit || stage.kind == StageKind::layout;
}

namespace {

TraceOptions walk_of(std::span<const StageCall> calls) {
  for (const StageCall& call : calls) {
    if (call.stage->kind == StageKind::trace) return std::any_cast<const TraceOptions&>(call.options);
  }
  return {};
}

}  // namespace

Precision precision_of(std::span<const StageCall> calls) { return walk_of(calls).precision; }

bool answers_exactly(std::span<const StageCall> calls) {
  return calls.front().stage->kind != StageKind::peer && precision_of(calls) == Precision::single_test;
}

bool walks_wide_nodes(std::span<const StageCall> calls) {
  TraceOptions walk = walk_of(calls);
  walk.precision = {};
  return walk == TraceOptions{} && std::ranges::all_of(calls, [](const StageCall& call) {
           return !answers_queries(*call.stage) || has_capability(*call.stage, Capability::custom);
         });
}

}  // namespace boxwood
