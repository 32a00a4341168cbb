#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "boxwood/box.h"
#include "boxwood/transform.h"
#include "layout/link.h"
#include "layout/trace_options.h"

namespace boxwood {

class Layout;
struct TriangleLeaves;
struct InstanceLeaves;

/// How a level is encoded; the number stands in files. 4 was `quantized` when all its leaves named triangles, 5 when
/// all its grids had steps of powers of two, 6 when packed leaves did not begin each axis with a byte, 7 when their
/// values never repeated.
enum class SavedKind : std::uint32_t { binary = 1, wide = 2, simd_wide = 3, quantized = 8 };

/// What leaves of a quantized level there may be besides plain packed ones.
inline constexpr std::uint32_t tight_leaves = 1, named_leaves = 2;

/// What kernels must know of a level besides its arrays. Stands in files as it is, 128 bytes; members that a kind of
/// level does not use are zero.
struct SavedFacts {
  SavedKind kind{};
  std::uint32_t instances = 0;     ///< 1: instances at the leaves, 0: triangles
  std::uint32_t children = 0;      ///< most per node
  std::uint32_t block = 0;         ///< triangles per leaf block (simd_wide)
  std::uint32_t cull = 1;          ///< TraceOptions::cull, as the level was encoded
  std::uint32_t out_of_cache = 0;  ///< WideView::out_of_cache
  std::uint32_t stack = 0;         ///< WideView::stack
  std::uint32_t root_reference = 0;
  float reach = 0, gain = 1;  ///< Reach
  Box root_box{{0, 0, 0}, {0, 0, 0}};
  Link root;
  std::uint32_t primitives = 0;  ///< one more than the largest number of a triangle, or an instance, in it
  std::uint32_t leaf_forms = 0;  ///< tight_leaves, named_leaves (quantized)
  std::uint64_t nodes = 0, inner_children = 0, triangles = 0;  ///< WideShape
  std::uint64_t vertices = 0;                                  ///< of the mesh that `leaves` ends with (quantized)
  std::uint64_t zeros[2] = {};
};
static_assert(sizeof(SavedFacts) == 128);

/// One instance of a level above, in files: 64 bytes.
struct SavedInstance {
  Transform world_to_object;
  std::uint32_t bottom = 0;  ///< which of the levels below
  std::uint32_t instance = 0;
  std::uint32_t hidden_from = 0;  ///< bits that its mask lacks
  std::uint32_t zero = 0;
};
static_assert(sizeof(SavedInstance) == 64);

/// A level as it is kept in files: its arrays are those that its kernels read, byte for byte, and hold no pointers.
struct SavedLevel {
  SavedFacts facts;
  std::span<const std::byte> nodes, leaves;
  std::vector<std::shared_ptr<const Layout>> bottoms;  ///< what instances name
  std::shared_ptr<const void> owner;                   ///< keeps what the arrays refer to
};

/// Fills in what files hold of leaves: `leaves`, `bottoms`, and those of the facts that tell of them. O(n).
void save_leaves(const TriangleLeaves& leaves, SavedLevel& out);
void save_leaves(const InstanceLeaves& leaves, SavedLevel& out);

/// What is wrong with a level, as half a sentence; empty when its kernels can walk it: every child, leaf and triangle
/// lies within the arrays, no node is reached twice, and no walk needs more room than there is. Says nothing on whether
/// boxes hold what they should. O(n).
std::string find_damage(const SavedLevel& level, const TraceOptions& trace);

/// The box of a level that layout_of() takes; empty when nothing is in it.
Box bounds_of(const SavedLevel& level);

/// The layout that `level` was. SIMD kernels read its nodes where they are, others get copies. Sizes and facts are
/// checked, nodes are not: see find_damage(). Throws Error saying what is wrong, as half a sentence.
std::shared_ptr<const Layout> layout_of(const SavedLevel& level, const TraceOptions& trace);

}  // namespace boxwood
