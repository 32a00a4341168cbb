#include "build/morton/clustering.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <bit>
#include <vector>

#include "build/morton/cluster_stack.h"

namespace boxwood {
namespace {

/// Clusters that a part of the curve hands up to the part around it. More make a better tree for the same work, as long
/// as twice as many fit in the first-level cache.
constexpr std::size_t kept = 64;
/// References that one task joins on its own.
constexpr std::size_t serial_size = 1 << 13;
/// Cache misses are started this many references ahead.
constexpr std::size_t prefetch_distance = 16;

class Clustering {
 public:
  Clustering(std::span<const Reference> references, const MortonOrder& order, const ClusteringOptions& options)
      : references_(references),
        order_(order),
        tree_{RawArray<ClusterTree::Node>(references.size()), RawArray<ClusterTree::Size>(references.size()), {}},
        stacks_([&] { return ClusterStack(std::max(serial_size, 2 * kept), 2 * kept, options, tree_); }) {}

  ClusterTree run() {
    ClusterStack& stack = stacks_.local();
    const std::vector<Cluster> top = join(0, references_.size());
    stack.clear();
    for (const Cluster& cluster : top) stack.push(cluster);
    stack.reduce(0, 1);
    tree_.root = stack[0].facts.id;
    return std::move(tree_);
  }

 private:
  /// Where the first differing bit of the codes in [begin, end) changes; the middle when all are the same.
  std::size_t split(std::size_t begin, std::size_t end) const {
    const std::uint64_t difference = order_.code(begin) ^ order_.code(end - 1);
    if (difference == 0) return begin + (end - begin) / 2;
    const std::uint64_t first_of_right = order_.code(end - 1) >> (std::bit_width(difference) - 1)
                                                                     << (std::bit_width(difference) - 1);
    const std::span<const std::uint64_t> keys = std::span<const std::uint64_t>(order_.keys).subspan(begin, end - begin);
    const auto found = std::lower_bound(keys.begin(), keys.end(), first_of_right << order_.index_bits);
    return begin + static_cast<std::size_t>(found - keys.begin());
  }

  void push_references(std::size_t begin, std::size_t end, ClusterStack& stack) const {
    for (std::size_t i = begin; i < end; ++i) {
      if (i + prefetch_distance < references_.size()) {
        __builtin_prefetch(&references_[order_.reference(i + prefetch_distance)]);
      }
      const Box box = references_[order_.reference(i)].box();
      const auto place = static_cast<std::uint32_t>(i);
      stack.push({box, {ClusterId::reference(place), place, {}, half_area(box)}});
    }
  }

  /// Leaves at most `kept` clusters for [begin, end) on the stack.
  void join_serially(std::size_t begin, std::size_t end, ClusterStack& stack) const {
    const std::size_t bottom = stack.size();
    if (end - begin <= 2 * kept) {
      push_references(begin, end, stack);
    } else {
      const std::size_t middle = split(begin, end);
      join_serially(begin, middle, stack);
      join_serially(middle, end, stack);
    }
    stack.reduce(bottom, kept);
  }

  std::vector<Cluster> join(std::size_t begin, std::size_t end) {
    std::vector<Cluster> left, right;
    if (end - begin > serial_size) {
      const std::size_t middle = split(begin, end);
      tbb::parallel_invoke([&] { left = join(begin, middle); }, [&] { right = join(middle, end); });
    }
    // No task is started from here on, so this thread's stack is free.
    ClusterStack& stack = stacks_.local();
    stack.clear();
    if (end - begin > serial_size) {
      for (const Cluster& cluster : left) stack.push(cluster);
      for (const Cluster& cluster : right) stack.push(cluster);
      stack.reduce(0, kept);
    } else {
      join_serially(begin, end, stack);
    }
    std::vector<Cluster> joined(stack.size());
    for (std::size_t i = 0; i < joined.size(); ++i) joined[i] = stack[i];
    return joined;
  }

  std::span<const Reference> references_;
  const MortonOrder& order_;
  ClusterTree tree_;
  tbb::enumerable_thread_specific<ClusterStack> stacks_;
};

}  // namespace

ClusterTree cluster(std::span<const Reference> references, const MortonOrder& order, const ClusteringOptions& options) {
  return Clustering(references, order, options).run();
}

}  // namespace boxwood
