#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "layout/saved_kind.h"
#include "layout/simd/wide_arena.h"

namespace boxwood {

/// Looks at all that lies below the root of a level in a file. Returns the first reference that leads to nothing a walk
/// could use, or needs more than `stack` open ends on the way; nothing when all do. `check` says what lies
/// where, and hands out each thing once, so that the walk ends and so do all others:
///   const Node* take_node(reference)    null where there is none
///   bool take_leaf(reference)
///   WideReference child(node, lane), Box box(node, lane), bool is_unused(node, lane)
/// O(n).
template <int N, class Check>
std::optional<WideReference> find_bad_reference(WideReference root, std::uint32_t stack, Check& check) {
  struct Pending {
    WideReference reference;
    std::uint32_t need;
  };
  std::vector<Pending> pending = {{root, 1}};
  while (!pending.empty()) {
    const auto [reference, need] = pending.back();
    pending.pop_back();
    if (is_leaf(reference)) {
      if (!check.take_leaf(reference)) return reference;
      continue;
    }
    const auto* node = check.take_node(reference);
    if (!node) return reference;
    int children = 0;
    while (children < N && check.child(*node, children) > wide_finished) ++children;
    const std::uint32_t below = need + static_cast<std::uint32_t>(children - (children > 0 ? 1 : 0));
    if (below > stack) return reference;
    for (int lane = 0; lane < N; ++lane) {
      const bool used = lane < children;
      if (!(used ? is_sound(check.box(*node, lane)) : check.is_unused(*node, lane))) return reference;
      if (used) pending.push_back({check.child(*node, lane), below});
    }
  }
  return {};
}

}  // namespace boxwood
