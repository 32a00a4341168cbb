#pragma once
#include <compare>
#include <cstdint>
#include <vector>

#include "tree/tree.h"

namespace boxwood {

/// Which references are below which nodes. References are numbered in the order of a depth-first walk (their slots), so
/// that what is below a node is a range, even after refinements have moved subtrees about. O(references log
/// references).
class ReferenceSlots {
 public:
  explicit ReferenceSlots(const Tree& tree);

  struct Slot {
    std::uint32_t primitive, slot;
    friend auto operator<=>(const Slot&, const Slot&) = default;  // NOLINT(*-nullptr)
  };
  /// One for every reference, by primitive, then by slot.
  const std::vector<Slot>& by_primitive() const { return by_primitive_; }

  std::uint32_t begin(std::uint32_t node) const { return begin_[node]; }
  std::uint32_t end(std::uint32_t node) const { return end_[node]; }

  /// Whether any reference to the primitive is below the node.
  bool owns(std::uint32_t node, std::uint32_t primitive) const;

 private:
  std::vector<std::uint32_t> begin_, end_;
  std::vector<Slot> by_primitive_;
};

}  // namespace boxwood
