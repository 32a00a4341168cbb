// What the SIMD layouts' nodes and leaves are written with: four children or triangles at a time.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <span>

#include "boxwood/scene.h"
#include "layout/simd/wide_node.h"
#include "tree/tree.h"

namespace boxwood {

/// Four floats, a register of every instruction set.
using Lanes [[gnu::vector_size(16)]] = float;

/// Four rows of x, y, z and anything become rows of four x, y, z. Row r goes to out + r * stride.
inline void store_transposed(const Lanes (&rows)[4], float* out, std::size_t stride) {
  const Lanes xy01 = __builtin_shufflevector(rows[0], rows[1], 0, 4, 1, 5);
  const Lanes xy23 = __builtin_shufflevector(rows[2], rows[3], 0, 4, 1, 5);
  const Lanes z01 = __builtin_shufflevector(rows[0], rows[1], 2, 6, 3, 7);
  const Lanes z23 = __builtin_shufflevector(rows[2], rows[3], 2, 6, 3, 7);
  const Lanes columns[3] = {__builtin_shufflevector(xy01, xy23, 0, 1, 4, 5),
                            __builtin_shufflevector(xy01, xy23, 2, 3, 6, 7),
                            __builtin_shufflevector(z01, z23, 0, 1, 4, 5)};
  for (std::size_t axis = 0; axis < 3; ++axis) std::memcpy(out + axis * stride, &columns[axis], sizeof(Lanes));
}

/// A node whose children, at most N, are named one after the other.
template <int N>
class NodeWriter {
 public:
  NodeWriter() { std::ranges::fill(nodes_, &nothing); }
  void add(const Tree::Node& child, WideReference reference) {
    nodes_[count_] = &child;
    children_[count_++] = reference;
  }
  void write(std::byte* place) const {
    WideNode<N>& node = *new (place) WideNode<N>;
    auto* const planes = reinterpret_cast<float*>(place);
    for (std::size_t lane = 0; lane < N; lane += 4) {
      Lanes lower[4], upper[4];
      for (std::size_t i = 0; i < 4; ++i) {
        const auto* bytes = reinterpret_cast<const std::byte*>(nodes_[lane + i]);
        std::memcpy(&lower[i], bytes, sizeof(Lanes));
        std::memcpy(&upper[i], bytes + sizeof(Vec3), sizeof(Lanes));
      }
      store_transposed(lower, planes + lane, 2 * N);
      store_transposed(upper, planes + N + lane, 2 * N);
    }
    std::copy_n(children_, N, node.children);
    constexpr std::size_t written = sizeof(node.planes) + sizeof(node.children);
    std::memset(place + written, 0, sizeof(node) - written);
  }

 private:
  static_assert(offsetof(Tree::Node, bounds) == 0 && sizeof(Tree::Node) >= sizeof(Vec3) + sizeof(Lanes));
  static_assert(offsetof(WideNode<N>, planes) == 0);
  static constexpr Tree::Node nothing{};

  const Tree::Node* nodes_[N];
  WideReference children_[N] = {};
  std::size_t count_ = 0;
};

/// Copies triangles into blocks.
template <int L>
class LeafWriter {
 public:
  LeafWriter(const Tree& tree, const Mesh& mesh) : references_(tree.references), mesh_(mesh) {}

  static std::size_t bytes(const Tree::Node& leaf) { return (leaf.count + L - 1) / L * sizeof(LeafBlock<L>); }

  void write(const Tree::Node& leaf, std::byte* place) const {
    for (std::size_t done = 0; done < leaf.count; done += L, place += sizeof(LeafBlock<L>)) {
      const std::size_t left = leaf.count - done;
      write_block(*new (place) LeafBlock<L>, leaf.first + done, std::min<std::size_t>(left, L));
      if (left > L) reinterpret_cast<LeafBlock<L>*>(place)->primitives[0] |= more_blocks;
    }
  }

 private:
  /// Cache misses are started this many references ahead, first that of the triangle, then those of its positions.
  static constexpr std::size_t triangles_ahead = 32, positions_ahead = 16;

  void write_block(LeafBlock<L>& block, std::size_t first, std::size_t count) const {
    static_assert(offsetof(LeafBlock<L>, vertices) == 0);
    auto* const vertices = reinterpret_cast<float*>(&block);
    const Triangle* triangles[L];
    for (std::size_t lane = 0; lane < L; ++lane) {
      block.primitives[lane] = references_[first + (lane < count ? lane : 0)];
      triangles[lane] = &mesh_.triangles[block.primitives[lane]];
      prefetch(first + lane);
    }
    for (std::size_t vertex = 0; vertex < 3; ++vertex) {
      for (std::size_t lane = 0; lane < L; lane += 4) {
        // What is missing is a single point.
        const auto row = [&](std::size_t i) { return position((*triangles[i])[i < count ? vertex : 0]); };
        const Lanes rows[4] = {row(lane), row(lane + 1), row(lane + 2), row(lane + 3)};
        store_transposed(rows, vertices + 3 * vertex * L + lane, L);
      }
    }
  }

  /// Inlined, since GCC drops calls of functions that only prefetch.
  [[gnu::always_inline]] void prefetch(std::size_t reference) const {
    if (reference + triangles_ahead >= references_.size()) return;
    __builtin_prefetch(&mesh_.triangles[references_[reference + triangles_ahead]]);
    for (const std::uint32_t vertex : mesh_.triangles[references_[reference + positions_ahead]]) {
      __builtin_prefetch(&mesh_.positions[vertex]);
    }
  }

  Lanes position(std::uint32_t vertex) const {
    Lanes out{};
    if (vertex + 1 < mesh_.positions.size()) [[likely]] {
      std::memcpy(&out, &mesh_.positions[vertex], sizeof(Lanes));
    } else {  // Nothing follows the last one.
      std::memcpy(&out, &mesh_.positions[vertex], sizeof(Vec3));
    }
    return out;
  }

  std::span<const std::uint32_t> references_;
  const Mesh& mesh_;
};

}  // namespace boxwood
