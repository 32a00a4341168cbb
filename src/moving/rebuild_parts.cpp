#include "moving/rebuild_parts.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <unordered_map>

#include "tree/assemble.h"
#include "tree/statistics.h"

namespace boxwood {
namespace {

/// A node still to be copied: of the old tree above or inside the parts, of a part built anew, or of the nodes above
/// built anew. With `count` > 1: a node to be made over so many parts, which a leaf there names from `node` on.
struct CopyItem {
  std::uint32_t tree = 0, node = 0, count = 1;
};

class PartsCopy {
 public:
  PartsCopy(const Tree& tree, const TreeParts& parts, std::uint32_t arity) : tree_(tree), parts_(parts), arity_(arity) {
    for (std::uint32_t p = 0; p < parts.parts.size(); ++p) part_at_.emplace(parts.parts[p].root, p);
  }

  void build(const DueParts& due, const std::function<Tree(LargeVector<Reference>, bool)>& build,
             const std::function<Box(std::uint32_t)>& box_of) {
    new_trees_.resize(due.parts.size() + 1);
    tbb::parallel_for(std::size_t{0}, due.parts.size(), [&](std::size_t i) {
      new_trees_[i] = build(references_of(parts_.parts[due.parts[i]], box_of), true);
    });
    replaced_by_.assign(parts_.parts.size(), inside);
    for (std::uint32_t i = 0; i < due.parts.size(); ++i) {
      const TreeParts::Part& part = parts_.parts[due.parts[i]];
      if (part_cost(new_trees_[i]) < cost_of_nodes(part.begin, part.end)) replaced_by_[due.parts[i]] = first_new + i;
    }
    above_ = old_above;
    if (!due.above) return;
    LargeVector<Reference> all;
    for (std::uint32_t p = 0; p < parts_.parts.size(); ++p) {
      const Box& box = part_box(p);
      all.push_back({box.lower, p, box.upper, 0});
    }
    new_trees_.back() = build(std::move(all), false);
    // Parts cut where another tree had nodes may be hard to put together.
    if (above_cost(new_trees_.back()) >= cost_of_nodes(0, parts_.above)) return;
    above_ = first_new + static_cast<std::uint32_t>(due.parts.size());
  }

  CopyItem root() const { return child(above_, 0); }

  void expand(const CopyItem& item, Tree::Node& node, std::vector<CopyItem>& children,
              Tree::References& references) const {
    if (item.count > 1) return expand_group(item, node, children);
    const Tree& from = source(item.tree);
    node = from.nodes[item.node];
    const std::uint32_t first = node.first;
    if (node.is_leaf()) {
      node.first = static_cast<std::uint32_t>(references.size());
      references.insert(references.end(), from.references.begin() + first,
                        from.references.begin() + first + node.count);
      return;
    }
    for (std::uint32_t c = 0; c < node.count; ++c) children.push_back(child(item.tree, first + c));
  }

 private:
  static constexpr std::uint32_t old_above = 0, inside = 1, first_new = 2;

  static double part_cost(const Tree& tree) {
    double sum = 0;
    for (const Tree::Node& node : tree.nodes) sum += node_cost(node);
    return sum;
  }
  /// Of a tree over parts: a leaf of several becomes a node.
  static double above_cost(const Tree& tree) {
    double sum = 0;
    for (const Tree::Node& node : tree.nodes) sum += node.count > 1 ? box_area(node.bounds) : 0;
    return sum;
  }
  double cost_of_nodes(std::uint32_t begin, std::uint32_t end) const {
    double sum = 0;
    for (std::uint32_t i = begin; i < end; ++i) sum += node_cost(tree_.nodes[parts_.order[i]]);
    return sum;
  }

  const Tree& source(std::uint32_t tree) const { return tree < first_new ? tree_ : new_trees_[tree - first_new]; }
  const Box& part_box(std::uint32_t part) const { return tree_.nodes[parts_.parts[part].root].bounds; }

  CopyItem part(std::uint32_t p) const {
    return replaced_by_[p] == inside ? CopyItem{inside, parts_.parts[p].root, 1} : CopyItem{replaced_by_[p], 0, 1};
  }

  CopyItem child(std::uint32_t tree, std::uint32_t node) const {
    if (tree != above_) return {tree, node, 1};
    if (tree == old_above) {
      const auto found = part_at_.find(node);
      return found == part_at_.end() ? CopyItem{tree, node, 1} : part(found->second);
    }
    const Tree::Node& at = source(tree).nodes[node];
    if (!at.is_leaf()) return {tree, node, 1};
    return group(at.first, at.count);
  }

  /// Of the parts that references [first, first + count) of the tree above name.
  CopyItem group(std::uint32_t first, std::uint32_t count) const {
    return count == 1 ? part(source(above_).references[first]) : CopyItem{above_, first, count};
  }

  void expand_group(const CopyItem& item, Tree::Node& node, std::vector<CopyItem>& children) const {
    for (std::uint32_t i = 0; i < item.count; ++i) {
      node.bounds.grow(part_box(source(above_).references[item.node + i]));
    }
    const std::uint32_t pieces = std::min(arity_, item.count);
    const auto begin = [&](std::uint32_t piece) {
      return item.node + static_cast<std::uint32_t>(std::uint64_t{item.count} * piece / pieces);
    };
    for (std::uint32_t i = 0; i < pieces; ++i) children.push_back(group(begin(i), begin(i + 1) - begin(i)));
  }

  LargeVector<Reference> references_of(const TreeParts::Part& part,
                                       const std::function<Box(std::uint32_t)>& box_of) const {
    std::vector<std::uint32_t> primitives;
    primitives.reserve(part.references);
    for (std::uint32_t i = part.begin; i < part.end; ++i) {
      const Tree::Node& node = tree_.nodes[parts_.order[i]];
      if (!node.is_leaf()) continue;
      const auto first = tree_.references.begin() + node.first;
      primitives.insert(primitives.end(), first, first + node.count);
    }
    std::ranges::sort(primitives);
    LargeVector<Reference> out;
    out.reserve(primitives.size());
    for (const std::uint32_t primitive : primitives) {
      const Box box = box_of(primitive);
      out.push_back({box.lower, primitive, box.upper, 0});
    }
    return out;
  }

  const Tree& tree_;
  const TreeParts& parts_;
  std::uint32_t arity_;
  std::unordered_map<std::uint32_t, std::uint32_t> part_at_;  ///< by root
  std::vector<Tree> new_trees_;                               ///< of the due parts, then of what lies above
  std::vector<std::uint32_t> replaced_by_;                    ///< per part
  std::uint32_t above_ = old_above;                           ///< the tree to begin with
};

}  // namespace

Tree rebuild_parts(const Tree& tree, const TreeParts& parts, const DueParts& due, std::uint32_t arity,
                   const std::function<Tree(LargeVector<Reference>, bool of_triangles)>& build,
                   const std::function<Box(std::uint32_t primitive)>& box_of) {
  PartsCopy copy(tree, parts, arity);
  copy.build(due, build, box_of);
  const auto make_expand = [&] {
    return [&](const CopyItem& item, Tree::Node& node, std::vector<CopyItem>& children, Tree::References& references) {
      copy.expand(item, node, children, references);
    };
  };
  return assemble(copy.root(), tree.nodes.size(), tree.references.size(), make_expand);
}

}  // namespace boxwood
