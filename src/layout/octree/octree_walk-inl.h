// The walk through the cells of an octree, whatever their topology is stored in. Compiled once per instruction set.
//
// The three planes through a cell's middle part the ray into at most four pieces, one per octant it crosses. Planes are
// widened as boxes are, by the same two constants of the prepared ray: the piece in an octant is what hit_box() gives
// for the octant's box, to the bit, because the planes around an octant that its ancestors tested are no tighter than
// its own. So an octant that holds a part of a triangle that is hit is entered, at a distance not above its t.
//
// A topology brings a `Navigator`, made once per ray from its nodes:
//   Node                       where a node is
//   root()
//   is_leaf(node), leaf(node)  the references of a leaf
//   children(node)             what leads to the children of an inner node
//   child(children, octant)    whose Node is that child; is_empty() of it: nothing to visit there
#if defined(BOXWOOD_LAYOUT_OCTREE_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_OCTREE_WALK_INL_H
#undef BOXWOOD_LAYOUT_OCTREE_WALK_INL_H
#else
#define BOXWOOD_LAYOUT_OCTREE_WALK_INL_H
#endif

#include <algorithm>
#include <bit>
#include <iterator>

#include "layout/octree/octree_head.h"
#include "layout/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Remembers the primitives tested last, so that one that lies in many cells is seldom tested twice. Amanatides, Woo
/// 1987.
class Mailbox {
 public:
  explicit Mailbox(bool enabled) : enabled_(enabled) {
    if (enabled) std::fill(std::begin(last_), std::end(last_), none);
  }
  /// Whether `primitive` was here lately; it is now.
  HWY_INLINE bool seen(std::uint32_t primitive) {
    if (!enabled_) return false;
    std::uint32_t& last = last_[primitive % std::size(last_)];
    if (last == primitive) return true;
    last = primitive;
    return false;
  }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  bool enabled_;
  std::uint32_t last_[64];
};

// Octants as the ray sees them: bit a is set where the ray has passed the middle plane of axis a.
inline constexpr std::uint32_t passed[3] = {0xaa, 0xcc, 0xf0};

/// The pieces of a ray in the eight octants of a cell.
struct OctantPieces {
  float entry[8], exit[8];
  std::uint32_t met;  // bit o: octant o is entered within the limits
};

/// Where a cell is left and its other half entered, per axis.
struct MiddlePlanes {
  float leave[3], enter[3];
};

HWY_INLINE MiddlePlanes middle_planes(const OctreeGrid& grid, const OctreeCell& cell, const PreparedRay& ray) {
  MiddlePlanes planes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float plane = grid.plane(axis, cell.corner[axis] + 0.5f * cell.size);
    planes.leave[axis] = fused(plane, ray.inverse[axis], -ray.far_offset[axis]);
    planes.enter[axis] = fused(plane, ray.inverse[axis], -ray.near_offset[axis]);
  }
  return planes;
}

/// One comparison for each pair of planes that bound a piece; then only the pieces that are met.
HWY_INLINE void find_pieces(const MiddlePlanes& planes, float from, float to, float cutoff, OctantPieces& pieces) {
  const float limit = to < cutoff ? to : cutoff;
  std::uint32_t met = 0xff;
  for (int a = 0; a < 3; ++a) {
    met &= planes.leave[a] < from ? passed[a] : 0xff;
    met &= planes.enter[a] > limit ? ~passed[a] : 0xff;
    for (int b = 0; b < 3; ++b) {
      if (a != b) met &= planes.enter[a] > planes.leave[b] ? ~(passed[a] & ~passed[b]) : 0xff;
    }
  }
  pieces.met = met & 0xff;
  for (std::uint32_t bits = pieces.met; bits != 0; bits &= bits - 1) {
    const int octant = std::countr_zero(bits);
    float entry = from, exit = to;
    for (int a = 0; a < 3; ++a) {
      if (octant >> a & 1) {
        entry = planes.enter[a] > entry ? planes.enter[a] : entry;
      } else {
        exit = planes.leave[a] < exit ? planes.leave[a] : exit;
      }
    }
    pieces.entry[octant] = entry;
    pieces.exit[octant] = exit;
  }
}

#if HWY_MAX_BYTES >= 32
/// All eight octants at once.
HWY_INLINE void find_pieces_simd(const MiddlePlanes& planes, float from, float to, float cutoff, OctantPieces& pieces) {
  const hn::FixedTag<float, 8> d;
  const hn::RebindToSigned<decltype(d)> di;
  const auto number = hn::Iota(di, 0);
  auto entry = hn::Set(d, from), exit = hn::Set(d, to);
  for (int a = 0; a < 3; ++a) {
    const auto in_far_half = hn::RebindMask(d, hn::TestBit(number, hn::Set(di, 1 << a)));
    entry = hn::IfThenElse(in_far_half, hn::Max(entry, hn::Set(d, planes.enter[a])), entry);
    exit = hn::IfThenElse(in_far_half, exit, hn::Min(exit, hn::Set(d, planes.leave[a])));
  }
  hn::StoreU(entry, d, pieces.entry);
  hn::StoreU(exit, d, pieces.exit);
  const auto hit = hn::Le(entry, hn::Min(exit, hn::Set(d, cutoff)));
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, hit, bits);
  pieces.met = bits[0];
}
#endif

/// Octants as stored from octants as the ray sees them, or back.
HWY_INLINE std::uint32_t mirror(std::uint32_t octants, std::uint32_t negative) {
  for (int a = 0; a < 3; ++a) {
    if (negative >> a & 1) octants = (octants & ~passed[a]) << (1 << a) | (octants & passed[a]) >> (1 << a);
  }
  return octants;
}

template <class Navigator, class Nodes, class Leaves, class Visit>
class OctreeWalk {
 public:
  /// A cell that the ray crosses between `entry` and `exit` and that is still to be visited.
  struct Pending {
    typename Navigator::Node node;
    OctreeCell cell;
    float entry, exit;
  };
  /// Seven siblings wait on each level.
  static constexpr std::size_t stack_size = 7 * octree_levels + 1;

  OctreeWalk(const Level<Nodes, Leaves>& level, const PreparedRay& ray, Visit& visit)
      : navigator_(level.nodes),
        head_(level.nodes.head),
        leaves_(level.leaves),
        ray_(ray),
        visit_(visit),
        mailbox_(level.nodes.head.mailbox) {
    for (std::uint32_t a = 0; a < 3; ++a) negative_ |= static_cast<std::uint32_t>(ray.negative[a]) << a;
    as_stored_ = head_.trace.order == ChildOrder::none;
  }

  HWY_INLINE bool run(float from) {
    const Box box = OctreeCell::root().box(head_.grid);
    Pending stack[stack_size];
    stack[0] = {navigator_.root(), OctreeCell::root(), from, std::numeric_limits<float>::infinity()};
    const bool met = clip_to(box, stack[0]);
    visit_.counting.test_root(met);
    if (!met || navigator_.is_empty(stack[0].node)) return false;
    if (head_.trace.mode == TraversalMode::recursive) return recurse(stack[0], stack + 1);
    for (Pending* top = stack + 1; top != stack;) {
      const Pending pending = *--top;
      if (pending.entry > visit_.cutoff) continue;
      if (navigator_.is_leaf(pending.node)) {
        if (visit_leaf(navigator_.leaf(pending.node))) return true;
      } else {
        top = open(pending, top);
      }
    }
    return false;
  }

 private:
  HWY_INLINE bool clip_to(const Box& box, Pending& root) const {
    const Vec3* planes = &box.lower;  // [0] lower, [1] upper
    for (std::size_t a = 0; a < 3; ++a) {
      const float enter = fused(planes[ray_.negative[a]][a], ray_.inverse[a], -ray_.near_offset[a]);
      const float leave = fused(planes[1 - ray_.negative[a]][a], ray_.inverse[a], -ray_.far_offset[a]);
      root.entry = enter > root.entry ? enter : root.entry;
      root.exit = leave < root.exit ? leave : root.exit;
    }
    return root.entry <= std::min(root.exit, visit_.cutoff);
  }

  bool recurse(const Pending& pending, Pending* const stack) {
    if (navigator_.is_leaf(pending.node)) return visit_leaf(navigator_.leaf(pending.node));
    for (Pending* top = open(pending, stack); top != stack;) {
      --top;
      const Pending child = *top;
      if (child.entry <= visit_.cutoff && recurse(child, top)) return true;
    }
    return false;
  }

  /// Puts the octants that are met on the stack, the first to visit on top.
  HWY_INLINE Pending* open(const Pending& at, Pending* top) {
    OctantPieces pieces;
    const MiddlePlanes planes = middle_planes(head_.grid, at.cell, ray_);
#if HWY_MAX_BYTES >= 32
    if (head_.trace.simd) {
      find_pieces_simd(planes, at.entry, at.exit, visit_.cutoff, pieces);
    } else {
      find_pieces(planes, at.entry, at.exit, visit_.cutoff, pieces);
    }
#else
    find_pieces(planes, at.entry, at.exit, visit_.cutoff, pieces);
#endif
    visit_.counting.open(8);
    const auto children = navigator_.children(at.node);
    // Ascending as the ray sees them, octants are in the order in which it meets them.
    const std::uint32_t order = as_stored_ ? 0 : negative_;
    for (std::uint32_t rest = as_stored_ ? mirror(pieces.met, negative_) : pieces.met; rest != 0;) {
      const std::uint32_t last = static_cast<std::uint32_t>(std::bit_width(rest)) - 1;
      rest ^= 1u << last;
      const std::uint32_t octant = last ^ order, seen = octant ^ negative_;
      visit_.counting.enter_child();
      const typename Navigator::Node child = navigator_.child(children, octant);
      if (navigator_.is_empty(child)) continue;
      *top++ = {child, at.cell.child(octant), pieces.entry[seen], pieces.exit[seen]};
    }
    return top;
  }

  HWY_INLINE bool visit_leaf(const OctreeLeaf& leaf) {
    if (leaf.count == 0) return false;
    visit_.counting.leaf();
    const std::uint32_t* const references = head_.references.data() + leaf.first;
    for (std::uint32_t i = 0; i < leaf.count; ++i) {
      if (mailbox_.seen(references[i])) continue;
      if (visit_entry(references[i], leaves_)) return true;
    }
    return false;
  }
  HWY_INLINE bool visit_entry(std::uint32_t place, const TriangleLeaves& leaves) {
    return visit_.entry(leaves.triangles[place]);
  }
  HWY_INLINE bool visit_entry(std::uint32_t place, const InstanceLeaves& leaves) {
    return visit_.entry(leaves.instances[place]);
  }

  Navigator navigator_;
  const OctreeHead& head_;
  const Leaves& leaves_;
  const PreparedRay& ray_;
  Visit& visit_;
  Mailbox mailbox_;
  std::uint32_t negative_ = 0;
  bool as_stored_ = false;
};

/// Stands for a Tester in the table of kernels. The order and the mode of the walk are looked up in the nodes, which
/// costs an octree nothing, so one set of kernels serves all.
template <class Navigator>
struct OctreeTester {
  using NavigatorType = Navigator;
};

template <class Tester, ChildOrder, TraversalMode, class Nodes, class Leaves, class Visit>
requires requires { typename Tester::NavigatorType; }
HWY_INLINE bool walk(const Level<Nodes, Leaves>& level, const PreparedRay& ray, Visit& visit) {
  if (!level.nodes.head.filled) return false;
  OctreeWalk<typename Tester::NavigatorType, Nodes, Leaves, Visit> octree_walk(level, ray, visit);
  return octree_walk.run(level.cull ? ray.t_near : -std::numeric_limits<float>::infinity());
}

template <class Navigator, class Nodes, class Leaves>
Kernels<Nodes, Leaves> octree_kernels() {
  return KernelsOf<OctreeTester<Navigator>, ChildOrder::near, TraversalMode::iterative, Nodes, Leaves>::table();
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
