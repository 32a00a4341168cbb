#include "layout/simd/tree_pieces.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace boxwood {
namespace {

/// Enough for the threads there are, few enough to be nothing beside the nodes.
constexpr std::size_t wanted_pieces = 256;
constexpr std::size_t small_tree = 4096;
constexpr std::uint32_t most_levels = 32;

/// The first level that has as many inner nodes as there are to be pieces.
std::uint32_t level_of_subtrees(const Tree& tree) {
  if (tree.nodes.size() < small_tree) return 0;
  std::vector<std::uint32_t> open{0};
  std::uint32_t level = 0;
  while (open.size() < wanted_pieces && level < most_levels) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t number : open) {
      const Tree::Node& node = tree.nodes[number];
      for (std::uint32_t c = node.first; c < node.first + node.count; ++c) {
        if (!tree.nodes[c].is_leaf()) next.push_back(c);
      }
    }
    if (next.empty()) break;
    open = std::move(next);
    ++level;
  }
  return level;
}

/// Recursion is no deeper than most_levels.
void append(const Tree& tree, const TreePiece& piece, std::uint32_t levels, std::vector<TreePiece>& pieces) {
  const auto number = static_cast<std::uint32_t>(pieces.size());
  pieces.push_back(piece);
  if (levels == 0) {
    pieces.back().whole = true;
    return;
  }
  const Tree::Node& node = tree.nodes[piece.node];
  TreePiece child{node.first, false, number, 0, WalkNeeds{}.enter(node, piece.open)};
  for (; child.node < node.first + node.count; ++child.node) {
    if (tree.nodes[child.node].is_leaf()) continue;
    append(tree, child, levels - 1, pieces);
    ++child.rank;
  }
}

}  // namespace

std::vector<TreePiece> cut_into_pieces(const Tree& tree) {
  std::vector<TreePiece> pieces;
  if (!tree.empty() && !tree.nodes[0].is_leaf()) append(tree, {}, level_of_subtrees(tree), pieces);
  return pieces;
}

std::uint32_t WalkNeeds::enter(const Tree::Node& node, std::uint32_t open) {
  const std::uint32_t below = std::min(open + node.count - 1, Tree::max_count);
  stack = std::max(stack, below);
  widest = std::max(widest, std::uint32_t{node.count});
  fixed_order |= node.fixed_order != 0;
  return below;
}

WalkNeeds& WalkNeeds::operator+=(const WalkNeeds& other) {
  stack = std::max(stack, other.stack);
  widest = std::max(widest, other.widest);
  fixed_order |= other.fixed_order;
  return *this;
}

WalkNeeds needs_of(const Tree& tree) {
  const std::vector<TreePiece> pieces = cut_into_pieces(tree);
  std::vector<WalkNeeds> needs(pieces.size());
  tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t p) {
    walk_piece(tree, pieces[p], pieces[p].open, [&](const Tree::Node& node, std::uint32_t open, const auto& push) {
      const std::uint32_t below = needs[p].enter(node, open);
      for (std::uint32_t c = node.first + node.count; c-- > node.first;) {
        if (!tree.nodes[c].is_leaf()) push(c, below);
      }
    });
  });
  WalkNeeds all;
  for (const WalkNeeds& need : needs) all += need;
  return all;
}

}  // namespace boxwood
