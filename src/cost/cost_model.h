#pragma once
#include <cstdint>
#include <memory>
#include <span>

#include "boxwood/box.h"

namespace boxwood {

/// One side of a candidate split.
struct Side {
  Box box;
  std::uint32_t count = 0;  ///< references on this side
  std::uint32_t seen = 0;   ///< of those, how many some ray is known to end on
};

/// Answers the one question a top-down builder asks: how likely does a ray that enters a node enter a given part of it?
/// Asked for whole batches of candidates so that the virtual call is paid once per node and axis.
class CostModel {
 public:
  /// What a model remembers of a node for the sake of the nodes below, such as the rays that enter it.
  struct Memory {
    virtual ~Memory() = default;
  };
  struct Node {
    Box box;
    std::uint32_t count = 0, seen = 0;  ///< references, as in Side
    const Memory* memory = nullptr;     ///< what enter() gave for this node
  };
  /// How a node's references fall to its parts.
  using Parts = std::span<const Side>;

  virtual ~CostModel() = default;

  /// out[i] = probability in [0, 1] that a ray that enters `parent` also enters sides[i].box. The boxes form a chain:
  /// each contains the next, or each is contained in the next. A parent of measure zero (a point, an axis-parallel
  /// line) gives 1 everywhere. Thread safe. sides.size() == out.size().
  virtual void probabilities(const Node& parent, std::span<const Side> sides, std::span<float> out) const = 0;

  /// Both sides of candidates at once, left[i] against right[i], for models whose sides depend on each other.
  virtual void pair_probabilities(const Node& parent, std::span<const Side> left, std::span<const Side> right,
                                  std::span<float> left_out, std::span<float> right_out) const {
    probabilities(parent, left, left_out);
    probabilities(parent, right, right_out);
  }

  /// Called for every node, the root first (`parent` null). Null when there is nothing to remember. Thread safe.
  virtual std::shared_ptr<const Memory> enter(const Box& /*node*/, const Memory* /*parent*/) const { return nullptr; }

  /// Whether in this node and below the model is the surface area heuristic, which builders have a quicker form of.
  virtual bool is_surface_area(const Memory* /*memory*/) const { return false; }

  /// Whether accepts() is to be asked.
  virtual bool has_rival() const { return false; }
  /// Whether the cheapest split by this model, `own`, is to be used, or else the cheapest by surface area.
  virtual bool accepts(Parts /*own*/, Parts /*by_area*/) const { return true; }
};

}  // namespace boxwood
