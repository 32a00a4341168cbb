#pragma once
#include <cstdint>
#include <span>

#include "build/build_input.h"
#include "build/float4.h"
#include "build/spatial/split.h"
#include "math/large_memory.h"

namespace boxwood {

/// A node's references, [begin, end) of one shared array, with room to grow up to `limit`. Room is handed down in
/// proportion to the references, so no task ever asks another for it.
struct Fragments {
  std::uint32_t begin = 0, end = 0, limit = 0;
  Box4 bounds, centers;

  std::uint32_t size() const { return end - begin; }
  std::uint32_t room() const { return limit - end; }
};

struct FragmentPair {
  Fragments left, right;
};

/// Divides a node's references as a split says, and its room with them. One per thread.
class FragmentDivider {
 public:
  FragmentDivider(std::span<Reference> array, const Geometry* geometry, bool unsplit)
      : array_(array), geometry_(geometry), unsplit_(unsplit) {}

  /// `room`: whether parts may need room to grow. Leaving it to them takes a pass over half of the references.
  FragmentPair by_centers(const Fragments& node, const Split& split, bool room);
  /// Cuts what lies on both sides. With `unsplit`, what is cheaper left whole goes to one side (Stich et al. 2009,
  /// section 4.4). A side may turn out empty.
  FragmentPair by_space(const Fragments& node, const Split& split);
  /// By halves, in the order of the centres along the widest axis: for references that nothing else tells apart.
  FragmentPair by_count(const Fragments& node);

  std::span<Reference> references(const Fragments& node) const { return array_.subspan(node.begin, node.size()); }

 private:
  FragmentPair hand_out(const Fragments& node, std::uint32_t left_count, bool room);
  FragmentPair fitted(FragmentPair pair) const;
  void place_cut(const Reference& reference, const Split& split, Split& sides);

  std::span<Reference> array_;
  const Geometry* geometry_;
  bool unsplit_;
  LargeVector<Reference> cut_, right_;
};

}  // namespace boxwood
