// The one engine behind every top-down builder: a splitter says where to cut a set of references, the engine does the
// rest (bounds, tasks, node slots, leaf limits, depth limits).
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include "build/build_input.h"
#include "build/centroids.h"
#include "build/float4.h"
#include "cost/cost_model.h"
#include "tree/tree.h"

namespace boxwood {

inline constexpr std::uint32_t max_children = 16;
/// Sets of at least this many references are looked through by several threads.
inline constexpr std::uint32_t parallel_size = 1 << 16;

/// What a splitter is asked to divide: at least two references, theirs to permute.
struct ReferenceSet {
  std::span<Reference> references;
  Box4 bounds;                                ///< of their boxes
  Box4 centers;                               ///< of their doubled centroids
  const CostModel::Memory* memory = nullptr;  ///< what the cost model remembers of this set's node

  std::uint32_t size() const { return static_cast<std::uint32_t>(references.size()); }
};

/// Where to cut a set: parts are [0, at[0]), [at[0], at[1]), … in ascending order along `axis`, none of them empty.
struct Cuts {
  std::uint32_t axis = 0;
  std::uint32_t count = 0;
  std::array<std::uint32_t, max_children - 1> at;

  /// Takes a cut above all earlier ones; one that would leave a part empty is dropped.
  void add(std::uint32_t cut, std::uint32_t size) {
    if (cut > (count ? at[count - 1] : 0) && cut < size) at[count++] = cut;
  }
};

/// What becomes of references whose centroids all coincide, where they are more than a leaf is to hold.
enum class Coincident {
  halve,  ///< halved by count, so that no leaf is larger than the limit
  leaf    ///< one leaf, as in pbrt
};

/// Permutes the set so that every part is contiguous and says where the cuts are. No cuts: make a leaf, or, when the
/// set is above the leaf limit, halve it by count. Thread safe, deterministic.
using Splitter = std::function<Cuts(const ReferenceSet& set)>;

/// Splits `input` from the top down until the splitter stops, with at most `leaf_limit` references in a leaf. Below 100
/// levels sets are halved by count, so depth stays below 132. Uses the threads of the caller's TBB arena; the tree does
/// not depend on them: a subtree over references [b, e) owns node slots given by b and e. O(n log n) for splitters of
/// O(n). At most 100 bytes per reference with the
/// input, and about 120 while the finished nodes are copied out of their slots. Throws Error above 2^31 references.
/// `model` is told of every node before it is split; null: there is none.
Tree build_top_down(BuildInput input, const Centroids& centroids, std::uint32_t leaf_limit, const Splitter& split,
                    Coincident coincident = Coincident::halve, const CostModel* model = nullptr);

}  // namespace boxwood
