// Takes subtrees out and puts them in where the tree gets cheapest by it. Bittner, Hapala and Havran 2013, "Fast
// Insertion-Based Optimization"; Meister and Bittner 2018, "Parallel Reinsertion for BVH Optimization".
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "refine/reinsert/apply_reinsertion.h"
#include "refine/reinsert/find_reinsertion.h"
#include "refine/reinsert/link_tree.h"
#include "refine/reinsert/stages.h"

namespace boxwood {
namespace {

struct ReinsertOptions {
  float batch = 0.02f;
  std::uint32_t rounds = 3;
};

/// Areas sorted roughly: by exponent and the first bits of the mantissa, so that one class spans a sixteenth.
constexpr std::size_t area_classes = 4096;
std::uint16_t area_class(const Box& bounds) {
  return static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(half_area(bounds)) >> 19 & (area_classes - 1));
}

/// The edges with the largest boxes, to a sixteenth, without those at the root: there is most to win there. Ascending.
LargeVector<Edge> largest_edges(const LinkTree& tree, float fraction) {
  using Counts = std::array<std::uint32_t, area_classes>;
  const std::size_t edges = tree.inner.size() * 2;
  RawArray<std::uint16_t> classes(edges);
  tbb::enumerable_thread_specific<Counts> counts_of_threads(Counts{});
  tbb::parallel_for(tbb::blocked_range<std::size_t>(2, edges, 1 << 14), [&](const auto& range) {
    Counts& counts = counts_of_threads.local();
    for (std::size_t e = range.begin(); e < range.end(); ++e) {
      classes[e] = area_class(tree.bounds(static_cast<Edge>(e)));
      ++counts[classes[e]];
    }
  });
  const auto wanted = static_cast<std::size_t>(static_cast<double>(edges - 2) * double{fraction});
  // The class in which the wanted number is reached: of it the first edges are taken.
  std::size_t reached = area_classes, taken = 0, of_class = 0;
  while (reached > 0 && taken + of_class <= wanted) {
    taken += of_class;
    --reached;
    of_class = 0;
    for (const Counts& counts : counts_of_threads) of_class += counts[reached];
  }
  std::size_t room = std::min(wanted - taken, of_class);
  LargeVector<Edge> largest;
  largest.reserve(taken + room);
  for (std::size_t e = 2; e < edges; ++e) {
    if (classes[e] < reached || (classes[e] == reached && room == 0)) continue;
    if (classes[e] == reached) --room;
    largest.push_back(static_cast<Edge>(e));
  }
  return largest;
}

/// One round: find places for a batch of subtrees in the tree as it is, then move those that still fit, best first.
/// Returns whether any moved.
bool improve(LinkTree& tree, ReinsertionApplier& applier, float batch) {
  const LargeVector<Edge> edges = largest_edges(tree, batch);
  std::vector<Reinsertion> moves(edges.size());
  tbb::enumerable_thread_specific<ReinsertionFinder> finders([&] { return ReinsertionFinder(tree); });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, edges.size(), 64), [&](const auto& range) {
    ReinsertionFinder& finder = finders.local();
    for (std::size_t i = range.begin(); i < range.end(); ++i) moves[i] = finder.find(edges[i]);
  });
  std::erase_if(moves, [](const Reinsertion& move) { return move.to == LinkTree::no_edge; });
  tbb::parallel_sort(moves.begin(), moves.end(), [](const Reinsertion& a, const Reinsertion& b) {
    return a.gain != b.gain ? a.gain > b.gain : a.from < b.from;
  });
  applier.begin_batch();
  bool moved = false;
  for (const Reinsertion& move : moves) moved |= applier.apply(move);
  return moved;
}

/// Binary trees never get worse by it; wide nodes are made binary first.
Tree reinsert(const ReinsertOptions& options, Tree tree) {
  if (tree.nodes.size() < 4) return tree;  // Fewer than three leaves: there is one tree only.
  LinkTree links = link(tree);
  ReinsertionApplier applier(links);
  for (std::uint32_t round = 0; round < options.rounds; ++round) {
    if (!improve(links, applier, options.batch)) break;
  }
  return relink(links, tree);
}

}  // namespace

Stage reinsert_stage() {
  OptionsOf<ReinsertOptions> options;
  options.real("batch", &ReinsertOptions::batch, 0, 1, "part of all nodes tried in a round, the largest first")
      .integer("rounds", &ReinsertOptions::rounds, 1, 64, "rounds, or until nothing moves");
  return refinement_stage<ReinsertOptions>("reinsert", "moves subtrees to where the tree gets cheapest by it",
                                           "Bittner et al. 2013; Meister and Bittner 2018", options, reinsert,
                                           [](const ReinsertOptions&) { return 2u; });
}

}  // namespace boxwood
