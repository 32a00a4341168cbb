// Unpacks nodes of quantized boxes, and leaves that name triangles of the caller's mesh, for the kernels of ../simd.
// Compiled once per instruction set.
#if defined(BOXWOOD_LAYOUT_COMPRESSED_QUANTIZED_STORE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_COMPRESSED_QUANTIZED_STORE_INL_H
#undef BOXWOOD_LAYOUT_COMPRESSED_QUANTIZED_STORE_INL_H
#else
#define BOXWOOD_LAYOUT_COMPRESSED_QUANTIZED_STORE_INL_H
#endif

#include <bit>
#include <limits>

#include "layout/compressed/quantized_node.h"
#include "layout/simd/lanes-inl.h"
#include "layout/simd/wide_arena.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

HWY_INLINE float power_of_two(std::int8_t exponent) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(exponent + 127) << 23);
}

/// Children `begin` on, as many as a register holds.
template <class D>
HWY_INLINE hn::Vec<hn::RebindToUnsigned<D>> references_of(D, const QuantizedNode16& node, int begin) {
  return hn::LoadU(hn::RebindToUnsigned<D>(), node.children + begin);
}

template <class D>
HWY_INLINE hn::Vec<hn::RebindToUnsigned<D>> references_of(D, const QuantizedNode8& node, int begin) {
  const hn::RebindToUnsigned<D> du;
  const hn::RebindToSigned<D> di;
  const hn::Rebind<std::uint8_t, D> bytes;
  const auto place = hn::PromoteTo(du, hn::LoadU(bytes, node.place + begin));
  const auto bit = hn::BitCast(du, hn::Shl(hn::Set(di, 1), hn::Iota(di, begin)));
  const auto inner = hn::TestBit(hn::Set(du, node.inner), bit);
  const auto first = hn::IfThenElse(inner, hn::Set(du, node.first_node * 2), hn::Set(du, node.first_primitive * 2 + 1));
  const auto reference = hn::Add(first, hn::Add(place, place));
  return hn::IfThenZeroElse(hn::Eq(place, hn::Set(du, no_child)), reference);
}

/// One vertex of four triangles, side by side.
template <class Rows>
HWY_INLINE void gather_vertex(const Rows& rows, int vertex, int lane, LeafBlock<8>& block) {
#if HWY_TARGET > HWY_AVX2
  // No instruction loads three floats where the fourth may not be there.
  for (int i = 0; i < 4; ++i) {
    for (int axis = 0; axis < 3; ++axis) block.vertices[vertex][axis][lane + i] = (&rows[i]->x)[axis];
  }
#else
  const hn::FixedTag<float, 4> d;
  const auto row = [&](int i) { return hn::MaskedLoad(hn::FirstN(d, 3), d, &rows[i]->x); };
  const auto a = row(0), b = row(1), c = row(2), e = row(3);
  const auto low_even = hn::InterleaveLower(d, a, c), low_odd = hn::InterleaveLower(d, b, e);
  const auto high_even = hn::InterleaveUpper(d, a, c), high_odd = hn::InterleaveUpper(d, b, e);
  hn::Store(hn::InterleaveLower(d, low_even, low_odd), d, block.vertices[vertex][0] + lane);
  hn::Store(hn::InterleaveUpper(d, low_even, low_odd), d, block.vertices[vertex][1] + lane);
  hn::Store(hn::InterleaveLower(d, high_even, high_odd), d, block.vertices[vertex][2] + lane);
#endif
}

template <class Node, int N>
struct QuantizedStore {
  static constexpr int children = N, triangles = 8;
  using NodeBuffer = WideNode<N>;
  using BlockBuffer = LeafBlock<8>;

  static HWY_INLINE const WideNode<N>& node(const WideView& view, WideReference reference, NodeBuffer& out) {
    using D = Floats<N>;
    const D d;
    const hn::RebindToSigned<D> di;
    const hn::RebindToUnsigned<D> du;
    const hn::Rebind<std::uint8_t, D> bytes;
    const Node& packed = reinterpret_cast<const Node*>(view.base)[reference >> 1];
    const float infinity = std::numeric_limits<float>::infinity();
    for (int begin = 0; begin < N; begin += lanes_of<D>) {
      const auto references = references_of(d, packed, begin);
      hn::Store(references, du, out.children + begin);
      for (int row = 0; row < 6; ++row) {
        const auto q = hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(bytes, packed.planes[row] + begin)));
        // Exact product, one rounding: the same fused or not.
        auto plane =
            hn::MulAdd(q, hn::Set(d, power_of_two(packed.exponent[row / 2])), hn::Set(d, packed.origin[row / 2]));
        if (row < 2) {  // no ray meets a box that is inverted on one axis
          const auto none = hn::RebindMask(d, hn::Eq(references, hn::Zero(du)));
          plane = hn::IfThenElse(none, hn::Set(d, row == 0 ? infinity : -infinity), plane);
        }
        hn::Store(plane, d, out.planes[row] + begin);
      }
    }
    return out;
  }

  static HWY_INLINE const LeafBlock<8>& block(const WideView& view, WideReference reference, std::size_t number,
                                              BlockBuffer& out) {
    const std::uint32_t* names = view.primitives + (reference >> 1) + number * 8;
    std::uint32_t last = 0;
    for (int lane = 0; lane < 8; ++lane) last |= (names[lane] >> 31) << lane;
    const int count = last == 0 ? 8 : std::countr_zero(last) + 1;
    const Vec3* vertices[3][8];
    for (int lane = 0; lane < 8; ++lane) {
      const bool used = lane < count;
      const std::uint32_t name = names[used ? lane : 0] & ~last_of_leaf;
      const Triangle& triangle = view.triangles[name];
      for (std::size_t vertex = 0; vertex < 3; ++vertex) {
        vertices[vertex][lane] = view.positions + triangle[used ? vertex : 0];
      }
      out.primitives[lane] = name;
    }
    for (int vertex = 0; vertex < 3; ++vertex) {
      gather_vertex(vertices[vertex], vertex, 0, out);
      gather_vertex(vertices[vertex] + 4, vertex, 4, out);
    }
    out.primitives[0] |= last == 0 ? more_blocks : 0;
    return out;
  }

  static HWY_INLINE void prefetch(const WideView& view, WideReference reference) {
    const std::byte* node = view.base + std::size_t{reference >> 1} * sizeof(Node);
    const auto* names = reinterpret_cast<const std::byte*>(view.primitives + (reference >> 1));
    const std::byte* place = is_leaf(reference) ? names : node;
    for (std::size_t line = 0; line < sizeof(Node); line += 64) __builtin_prefetch(place + line);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
