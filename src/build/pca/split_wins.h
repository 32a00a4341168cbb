#pragma once
#include <cstdint>

#include "build/build_input.h"
#include "build/pca/pca_options.h"

namespace boxwood {

/// How often `combined` found either kind of cut the cheaper one and made it. Nodes that it does not search (pairs,
/// with pairs=on, and what is halved by count) are in neither.
struct SplitWins {
  std::uint64_t classical = 0;  ///< along a world axis; ties are among them
  std::uint64_t principal = 0;
};

/// Builds the tree of `combined` with these options once more, for the counts. As long as building.
SplitWins count_split_wins(const PcaCostOptions& options, BuildInput input);

}  // namespace boxwood
