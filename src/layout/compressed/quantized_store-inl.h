// Unpacks nodes of quantized boxes, and leaves, packed ones and those that name triangles of the caller's mesh, for the
// kernels of ../simd. Compiled once per instruction set.
#if defined(BOXWOOD_LAYOUT_COMPRESSED_QUANTIZED_STORE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_COMPRESSED_QUANTIZED_STORE_INL_H
#undef BOXWOOD_LAYOUT_COMPRESSED_QUANTIZED_STORE_INL_H
#else
#define BOXWOOD_LAYOUT_COMPRESSED_QUANTIZED_STORE_INL_H
#endif

#include <bit>
#include <limits>

#include "layout/compressed/packed_leaf-inl.h"
#include "layout/compressed/quantized_node.h"
#include "layout/simd/lanes-inl.h"
#include "layout/simd/triangles-inl.h"
#include "layout/simd/wide_arena.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

HWY_INLINE float step_of(const QuantizedNode8& node, int axis) {
  return std::bit_cast<float>(std::uint32_t{node.exponent[axis]} << 23);
}
HWY_INLINE float step_of(const QuantizedNode16& node, int axis) { return node.step[axis]; }

HWY_INLINE const std::byte* place_of(const WideView& view, WideReference reference) {
  return view.base + std::size_t{reference >> 1} * sizeof(std::uint32_t);
}

/// Children `begin` on, as many as a register holds, and where there are any; elsewhere references mean nothing.
template <class D>
struct Children {
  hn::Vec<D> references;
  hn::Mask<D> some;
};

template <class D>
HWY_INLINE Children<D> children_of(D d, const QuantizedNode16& node, int begin) {
  const auto references = hn::LoadU(d, node.children + begin);
  return {references, hn::Ne(references, hn::Zero(d))};
}

template <class D>
HWY_INLINE Children<D> children_of(D d, const QuantizedNode8& node, int begin) {
  const hn::Rebind<std::uint8_t, D> bytes;
  const auto place = hn::PromoteTo(d, hn::LoadU(bytes, node.place + begin));
  const auto inner_bits = static_cast<std::uint8_t>(node.inner >> begin);
  const auto inner = hn::LoadMaskBits(d, &inner_bits);
  const auto first = hn::IfThenElse(inner, hn::Set(d, node.first_node), hn::Set(d, node.first_leaf));
  return {hn::Add(first, hn::Add(place, place)), hn::Ne(place, hn::Set(d, no_child))};
}

/// The names of up to eight triangles, the first again for those missing. Returns how many there are; more than eight
/// when the leaf goes on.
HWY_INLINE int load_names(const std::uint32_t* names, std::uint32_t* out) {
  using D = hn::CappedTag<std::uint32_t, 8>;
  const D d;
  const auto last = hn::Set(d, last_of_leaf);
  std::uint32_t bits = 0;
  for (int begin = 0; begin < 8; begin += lanes_of<D>) {
    bits |= bits_of(d, hn::TestBit(hn::LoadU(d, names + begin), last)) << begin;
  }
  const int count = bits == 0 ? 9 : std::countr_zero(bits) + 1;
  for (int begin = 0; begin < 8; begin += lanes_of<D>) {
    const auto used =
        hn::Lt(hn::Iota(d, static_cast<std::uint32_t>(begin)), hn::Set(d, static_cast<std::uint32_t>(count)));
    const auto name = hn::IfThenElse(used, hn::LoadU(d, names + begin), hn::Set(d, names[0]));
    hn::Store(hn::AndNot(last, name), d, out + begin);
  }
  return count;
}

#if HWY_MAX_BYTES >= 32
/// One vertex of eight triangles.
HWY_INLINE Vertices<hn::FixedTag<float, 8>> gather_vertex(const WideView& view, const std::uint32_t* names,
                                                          std::size_t vertex) {
  const hn::FixedTag<float, 4> half;
  const hn::FixedTag<float, 8> d;
  const auto place = [&](int lane) HWY_ATTR {
    const Vec3& position = view.positions[view.triangles[names[lane]][vertex]];
    return hn::MaskedLoad(hn::FirstN(half, 3), half, &position.x);
  };
  const auto row = [&](int lane) HWY_ATTR { return hn::Combine(d, place(lane + 4), place(lane)); };
  const auto a = row(0), b = row(1), c = row(2), e = row(3);
  const auto low_even = hn::InterleaveLower(d, a, c), low_odd = hn::InterleaveLower(d, b, e);
  const auto high_even = hn::InterleaveUpper(d, a, c), high_odd = hn::InterleaveUpper(d, b, e);
  return {hn::InterleaveLower(d, low_even, low_odd), hn::InterleaveUpper(d, low_even, low_odd),
          hn::InterleaveLower(d, high_even, high_odd)};
}

/// Missing triangles become a point.
HWY_INLINE void gather_vertices(const WideView& view, int count, LeafBlock<8>& out) {
  const hn::FixedTag<float, 8> d;
  const auto used = hn::FirstN(d, static_cast<std::size_t>(count));
  const auto first = gather_vertex(view, out.primitives, 0);
  for (int vertex = 0; vertex < 3; ++vertex) {
    const auto next = vertex == 0 ? first : gather_vertex(view, out.primitives, static_cast<std::size_t>(vertex));
    hn::Store(hn::IfThenElse(used, next.x, first.x), d, out.vertices[vertex][0]);
    hn::Store(hn::IfThenElse(used, next.y, first.y), d, out.vertices[vertex][1]);
    hn::Store(hn::IfThenElse(used, next.z, first.z), d, out.vertices[vertex][2]);
  }
}
#else
HWY_INLINE void gather_vertices(const WideView& view, int count, LeafBlock<8>& out) {
  for (int lane = 0; lane < 8; ++lane) {
    const Triangle& triangle = view.triangles[out.primitives[lane]];
    for (std::size_t vertex = 0; vertex < 3; ++vertex) {
      const Vec3& position = view.positions[triangle[lane < count ? vertex : 0]];
      for (std::size_t axis = 0; axis < 3; ++axis) out.vertices[vertex][axis][lane] = position[axis];
    }
  }
}
#endif

template <class Node, int N>
struct QuantizedStore {
  static constexpr int children = N, triangles = 8;
  static constexpr std::uint32_t row_bytes = N;
  using NodeBuffer = WideNode<N>;
  using BlockBuffer = LeafBlock<8>;

  static HWY_INLINE const WideNode<N>& node(const WideView& view, WideReference reference, NodeBuffer& out) {
    using D = Floats<N>;
    const D d;
    const hn::RebindToSigned<D> di;
    const hn::RebindToUnsigned<D> du;
    const hn::Rebind<std::uint8_t, D> bytes;
    const Node& packed = *reinterpret_cast<const Node*>(place_of(view, reference));
    const float infinity = std::numeric_limits<float>::infinity();
    for (int begin = 0; begin < N; begin += lanes_of<D>) {
      const auto children = children_of(du, packed, begin);
      hn::Store(hn::IfThenElseZero(children.some, children.references), du, out.children + begin);
      for (int row = 0; row < 6; ++row) {
        const auto q = hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(bytes, packed.planes[row] + begin)));
        // Exact product, one rounding: the same fused or not.
        auto plane = hn::MulAdd(q, hn::Set(d, step_of(packed, row / 2)), hn::Set(d, packed.origin[row / 2]));
        if (row < 2) {  // no ray meets a box that is inverted on one axis
          const auto none = hn::Set(d, row == 0 ? infinity : -infinity);
          plane = hn::IfThenElse(hn::RebindMask(d, children.some), plane, none);
        }
        hn::Store(plane, d, out.planes[row] + begin);
      }
    }
    return out;
  }

  static HWY_INLINE float plane(const WideView& view, WideReference reference, int row, std::uint32_t lane) {
    const Node& packed = *reinterpret_cast<const Node*>(place_of(view, reference));
    return __builtin_fmaf(static_cast<float>(packed.planes[row][lane]), step_of(packed, row / 2),
                          packed.origin[row / 2]);
  }

  static HWY_INLINE const LeafBlock<8>& block(const WideView& view, WideReference reference, std::size_t number,
                                              BlockBuffer& out) {
    const auto* words = reinterpret_cast<const std::uint32_t*>(place_of(view, reference));
    if (HWY_LIKELY((words[0] & packed_leaf) != 0)) {
      for (; number > 0; --number) words += words_of_packed(words);
      if (HWY_LIKELY(!view.tight))
        unpack_leaf(words, out);
      else
        unpack_tight_leaf(words, out);
      return out;
    }
    const int count = load_names(words + number * 8, out.primitives);
    gather_vertices(view, count, out);
    out.primitives[0] |= count > 8 ? more_blocks : 0;
    return out;
  }

  static HWY_INLINE WideReference next_block(const WideView& view, WideReference reference) {
    const auto* words = reinterpret_cast<const std::uint32_t*>(place_of(view, reference));
    return reference + 2 * ((words[0] & packed_leaf) != 0 ? words_of_packed(words) : 8);
  }

  static HWY_INLINE void prefetch(const WideView& view, WideReference reference) {
    const std::byte* place = place_of(view, reference);
    // Leaves of 60 to 130 bytes begin anywhere in a line.
    for (std::size_t line = 0; line < 3; ++line) __builtin_prefetch(place + 64 * line);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
