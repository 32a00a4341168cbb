// Takes subtrees out and puts them in where the tree gets cheapest by it. Bittner, Hapala and Havran 2013, "Fast
// Insertion-Based Optimization"; Meister and Bittner 2018, "Parallel Reinsertion for BVH Optimization".
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
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

/// The edges with the largest boxes, without those at the root: there is most to win there. Sorted.
std::vector<Edge> largest_edges(const LinkTree& tree, float fraction) {
  std::vector<float> areas(tree.inner.size() * 2);
  tbb::parallel_for(std::size_t{0}, areas.size(),
                    [&](std::size_t e) { areas[e] = half_area(tree.bounds(static_cast<Edge>(e))); });
  std::vector<Edge> edges(areas.size() - 2);
  for (std::size_t i = 0; i < edges.size(); ++i) edges[i] = static_cast<Edge>(i) + 2;
  const auto count = static_cast<std::ptrdiff_t>(static_cast<double>(edges.size()) * double{fraction});
  const auto larger = [&](Edge a, Edge b) { return areas[a] != areas[b] ? areas[a] > areas[b] : a < b; };
  std::nth_element(edges.begin(), edges.begin() + count, edges.end(), larger);
  edges.resize(static_cast<std::size_t>(count));
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// One round: find places for a batch of subtrees in the tree as it is, then move those that still fit, best first.
/// Returns whether any moved.
bool improve(LinkTree& tree, ReinsertionApplier& applier, float batch) {
  const std::vector<Edge> edges = largest_edges(tree, batch);
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
