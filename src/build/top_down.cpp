#include "build/top_down.h"

#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "boxwood/error.h"
#include "build/cut_by_count.h"
#include "build/reduce.h"

namespace boxwood {
namespace {

constexpr std::uint32_t task_size = 1 << 12;  // subtrees above this many references are tasks of their own
constexpr std::uint32_t depth_limit = 100;    // below it only halving: clustered input must not make a list

/// A subtree still to be built: the place of its root and of the first of the 2n - 2 slots for everything below.
struct Pending {
  std::uint32_t begin, end;
  std::uint32_t slot, below;
  std::uint32_t depth;
  std::shared_ptr<const CostModel::Memory> parent_memory;
};

struct Bounds {
  Box4 boxes, centers;
};

Bounds bounds_of(std::span<const Reference> references, const Centroids& centroids) {
  const auto fold = [&](std::span<const Reference> part, Bounds bounds) {
    for (const Reference& reference : part) {
      bounds.boxes.grow(box4(reference));
      bounds.centers.grow(centroids(reference));
    }
    return bounds;
  };
  return reduce(references, Bounds{}, fold, [](Bounds a, const Bounds& b) {
    a.boxes.grow(b.boxes);
    a.centers.grow(b.centers);
    return a;
  });
}

class TopDown {
 public:
  TopDown(BuildInput& input, const Centroids& centroids, std::uint32_t leaf_limit, const Splitter& split,
          Coincident coincident, const CostModel* model)
      : references_(input.references),
        centroids_(centroids),
        leaf_limit_(leaf_limit),
        coincident_(coincident),
        split_(split),
        model_(model),
        slots_(std::make_unique_for_overwrite<Tree::Node[]>(2 * references_.size() - 1)) {}

  void run() {
    const auto size = static_cast<std::uint32_t>(references_.size());
    tasks_.run_and_wait([&] { build({0, size, 0, 1, 0, nullptr}); });
  }

  std::unique_ptr<Tree::Node[]> take_slots() { return std::move(slots_); }

 private:
  /// Builds a subtree; large parts of it become tasks of their own.
  void build(const Pending& root) {
    std::vector<Pending> stack{root};
    while (!stack.empty()) {
      const Pending pending = std::move(stack.back());
      stack.pop_back();
      if (pending.end - pending.begin > task_size && pending.slot != root.slot) {
        tasks_.run([this, pending] { build(pending); });
      } else {
        build_node(pending, stack);
      }
    }
  }

  void build_node(const Pending& pending, std::vector<Pending>& stack) {
    const std::span<Reference> references = references_.subspan(pending.begin, pending.end - pending.begin);
    const Bounds bounds = bounds_of(references, centroids_);
    std::shared_ptr<const CostModel::Memory> memory;
    if (model_) memory = model_->enter(bounds.boxes.box(), pending.parent_memory.get());
    const ReferenceSet set{references, bounds.boxes, bounds.centers, memory.get()};
    const Cuts cuts = cuts_of(set, pending.depth);

    Tree::Node node;
    node.bounds = bounds.boxes.box();
    if (cuts.count == 0) {
      node.first = pending.begin;
      node.count = set.size() & Tree::max_count;
      node.leaf = 1;
    } else {
      node.first = pending.below;
      node.count = (cuts.count + 1) & Tree::max_count;
      node.axis = cuts.axis & 3;
      push_children(pending, cuts, memory, stack);
    }
    slots_[pending.slot] = node;
  }

  Cuts cuts_of(const ReferenceSet& set, std::uint32_t depth) const {
    Cuts cuts;
    if (coincident_ == Coincident::leaf && coincide(set) && set.size() <= Tree::max_count) return cuts;
    if (set.size() >= 2 && depth < depth_limit) cuts = split_(set);
    if (cuts.count == 0 && set.size() > leaf_limit_) cuts = cut_by_count(set, centroids_, longest_axis(set.centers), 2);
    return cuts;
  }

  static bool coincide(const ReferenceSet& set) {
    const Float4 extent = set.centers.upper - set.centers.lower;
    return extent[0] == 0 && extent[1] == 0 && extent[2] == 0;
  }

  static void push_children(const Pending& parent, const Cuts& cuts,
                            const std::shared_ptr<const CostModel::Memory>& memory, std::vector<Pending>& stack) {
    std::uint32_t begin = parent.begin, below = parent.below + cuts.count + 1;
    for (std::uint32_t i = 0; i <= cuts.count; ++i) {
      const std::uint32_t end = i < cuts.count ? parent.begin + cuts.at[i] : parent.end;
      stack.push_back({begin, end, parent.below + i, below, parent.depth + 1, memory});
      below += 2 * (end - begin) - 2;
      begin = end;
    }
  }

  std::span<Reference> references_;
  const Centroids& centroids_;
  std::uint32_t leaf_limit_;
  Coincident coincident_;
  const Splitter& split_;
  const CostModel* model_;
  std::unique_ptr<Tree::Node[]> slots_;
  tbb::task_group tasks_;
};

/// Closes the gaps between used slots, in place: in depth-first order siblings only move down. Returns their number.
std::uint32_t compact(Tree::Node* slots) {
  std::uint32_t used = 1;
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    Tree::Node& node = slots[stack.back()];
    stack.pop_back();
    if (node.is_leaf()) continue;
    std::copy(slots + node.first, slots + node.first + node.count, slots + used);
    node.first = used;
    used += node.count;
    for (std::uint32_t i = node.count; i-- > 0;) stack.push_back(node.first + i);
  }
  return used;
}

}  // namespace

Tree build_top_down(BuildInput input, const Centroids& centroids, std::uint32_t leaf_limit, const Splitter& split,
                    Coincident coincident, const CostModel* model) {
  Tree tree;
  if (input.references.empty()) return tree;
  if (input.references.size() > (1u << 31)) {
    throw Error("a top-down build takes at most 2^31 primitives; split the scene into instances");
  }
  TopDown engine(input, centroids, leaf_limit, split, coincident, model);
  engine.run();

  tree.references.resize(input.references.size());
  tbb::parallel_for(std::size_t{0}, tree.references.size(),
                    [&](std::size_t i) { tree.references[i] = input.references[i].primitive; });
  LargeVector<Reference>().swap(input.references);  // frees them; assigning {} would not
  const std::unique_ptr<Tree::Node[]> slots = engine.take_slots();
  const std::uint32_t used = compact(slots.get());
  tree.nodes.assign(slots.get(), slots.get() + used);
  return tree;
}

}  // namespace boxwood
