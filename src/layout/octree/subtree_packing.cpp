#include "layout/octree/subtree_packing.h"

#include <algorithm>

namespace boxwood {
namespace {

class Packing {
 public:
  Packing(const OctreeTopology& topology, std::uint32_t groups) : topology_(topology), groups_(groups) {}

  /// Inner nodes of what stays joined to `item`, itself included. The recursion is as deep as the octree.
  std::uint32_t pack(const OctreeItem& item) {
    OctreeItem children[8];
    topology_.children(item, children);
    struct Part {
      std::uint32_t size;
      OctreeCode code;
    };
    Part parts[8];
    std::uint32_t count = 0, size = 1;
    for (const OctreeItem& child : children) {
      if (!topology_.is_inner(child)) continue;
      parts[count] = {pack(child), child.code};
      size += parts[count++].size;
    }
    std::stable_sort(parts, parts + count, [](const Part& a, const Part& b) { return a.size < b.size; });
    for (; size > groups_; size -= parts[count].size) beginnings_.insert(parts[--count].code);
    return size;
  }

  std::unordered_set<OctreeCode> take() { return std::move(beginnings_); }

 private:
  const OctreeTopology& topology_;
  std::uint32_t groups_;
  std::unordered_set<OctreeCode> beginnings_;
};

}  // namespace

std::unordered_set<OctreeCode> pack_subtrees(const OctreeTopology& topology, std::uint32_t groups) {
  Packing packing(topology, groups);
  if (topology.is_inner(topology.root())) packing.pack(topology.root());
  return packing.take();
}

}  // namespace boxwood
