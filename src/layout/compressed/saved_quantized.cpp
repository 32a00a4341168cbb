// Compressed trees in files. Some of their leaves only name triangles, so the mesh goes with them: leaves, positions,
// triangles.
#include <algorithm>
#include <cstring>
#include <vector>

#include "layout/compressed/compressed_kernels.h"
#include "layout/compressed/quantize.h"
#include "layout/compressed/quantized_arena.h"
#include "layout/saved_kind.h"
#include "layout/simd/saved_walk.h"
#include "layout/simd/simd_layout.h"

namespace boxwood {
namespace {

struct LeavesAndMesh {
  std::span<const std::uint32_t> words;
  std::span<const Vec3> positions;
  std::span<const Triangle> triangles;
};

/// Throws Error when the leaves are not as long as the facts say.
LeavesAndMesh split_leaves(const SavedLevel& level) {
  const std::size_t size = level.leaves.size();
  const std::uint64_t vertices = level.facts.vertices, triangles = level.facts.primitives;
  const bool fits = vertices <= size / sizeof(Vec3) && triangles <= size / sizeof(Triangle) &&
                    vertices * sizeof(Vec3) + triangles * sizeof(Triangle) <= size;
  const std::size_t begin_of_mesh = fits ? size - vertices * sizeof(Vec3) - triangles * sizeof(Triangle) : 0;
  if (begin_of_mesh < (1 + words_at_once) * sizeof(std::uint32_t)) throw Error("its mesh ends within a triangle");
  const auto mesh = level.leaves.subspan(begin_of_mesh);
  return {elements_of<std::uint32_t>(level.leaves.first(begin_of_mesh), "words of leaves"),
          elements_of<Vec3>(mesh.first(vertices * sizeof(Vec3)), "vertices"),
          elements_of<Triangle>(mesh.subspan(vertices * sizeof(Vec3)), "triangles")};
}

/// A compressed tree in memory that someone else keeps.
struct KeptQuantized {
  SavedLevel level;
  WideView view;
  WideShape shape;

  std::size_t bytes() const { return level.nodes.size() + split_leaves(level).words.size_bytes(); }
  std::vector<LayoutFact> facts() const { return shape.facts(bytes()); }
  void save(SavedLevel& out) const { out = level; }
};

/// What lies where; each node and each word of a leaf may belong to one thing only.
template <class Node, int N>
class QuantizedCheck {
 public:
  explicit QuantizedCheck(const SavedLevel& level)
      : facts_(level.facts), nodes_(elements_of<Node>(level.nodes, "nodes")), leaves_(split_leaves(level)) {}

  std::string run() {
    if (nodes_.size() < 2) return "it has no root";
    for (const Triangle& triangle : leaves_.triangles) {
      for (const std::uint32_t vertex : triangle) {
        if (vertex >= leaves_.positions.size()) return "a triangle of its mesh names a vertex that it does not have";
      }
    }
    node_taken_.resize(nodes_.size());
    word_taken_.resize(leaves_.words.size());
    const std::optional<WideReference> bad = find_bad_reference<N>(quantized_root, facts_.stack, *this);
    if (!bad) return {};
    return fmt::format("{} {} is none that any walk could use", is_leaf(*bad) ? "leaf" : "node", *bad >> 1);
  }

  const Node* take_node(WideReference reference) {
    const std::uint32_t number = reference >> 1;
    if (number == 0 || number >= nodes_.size() || node_taken_[number]) return nullptr;
    node_taken_[number] = true;
    return &nodes_[number];
  }

  bool take_leaf(WideReference reference) {
    const std::size_t place = reference >> 1;
    if (place == 0 || place >= leaves_.words.size()) return false;
    return (leaves_.words[place] & packed_leaf) != 0 ? take_packed(place) : take_names(place);
  }

  /// As the kernels find it, in the same arithmetic; 0 where there is none.
  static WideReference child(const Node& node, int lane) {
    if constexpr (N == 16)
      return node.children[lane];
    else
      return child_of_eight(node, lane);
  }
  static Box box(const Node& node, int lane) {
    Grid grid;
    Box out;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      grid.origin[axis] = node.origin[axis];
      grid.exponent[axis] = node.exponent[axis];
      out.lower[axis] = grid.at(axis, node.planes[2 * axis][lane]);
      out.upper[axis] = grid.at(axis, node.planes[2 * axis + 1][lane]);
    }
    return out;
  }
  static bool is_unused(const Node& node, int lane) { return child(node, lane) == wide_nothing; }

 private:
  /// Takes `size` words, behind which there are enough for kernels to read.
  bool take_words(std::size_t place, std::size_t size) {
    if (place + size + words_at_once > leaves_.words.size()) return false;
    for (std::size_t i = place; i < place + size; ++i) {
      if (word_taken_[i]) return false;
      word_taken_[i] = true;
    }
    return true;
  }

  bool take_names(std::size_t place) {
    for (bool more = true; more; ++place) {
      if (!take_words(place, 1)) return false;
      const std::uint32_t name = leaves_.words[place];
      if ((name & ~last_of_leaf) >= leaves_.triangles.size()) return false;
      more = (name & last_of_leaf) == 0;
    }
    return true;
  }

  bool take_packed(std::size_t place) {
    const std::uint32_t* words = &leaves_.words[place];
    const PackedLeafHead head(words[0]);
    if (words[0] >> 27 != packed_leaf >> 27 || !take_words(place, head.words())) return false;
    PackedBits indices(words, PackedLeafHead::begin_of_indices), numbers(words, head.begin_of_numbers());
    for (std::uint32_t i = 0; i < 3 * head.triangles; ++i) {
      if (indices.take(4) >= head.corners) return false;
    }
    for (std::uint32_t i = 0; i < head.triangles; ++i) {
      if (std::uint64_t{words[1]} + numbers.take(head.bits[3]) >= leaves_.triangles.size()) return false;
    }
    return true;
  }

  static WideReference child_of_eight(const QuantizedNode8& node, int lane) {
    if (node.place[lane] == no_child) return wide_nothing;
    const bool inner = (node.inner >> lane & 1) != 0;
    return (inner ? node.first_node * 2 : node.first_leaf * 2 + 1) + std::uint32_t{node.place[lane]} * 2;
  }

  const SavedFacts& facts_;
  std::span<const Node> nodes_;
  LeavesAndMesh leaves_;
  std::vector<bool> node_taken_, word_taken_;
};

/// Calls use.template operator()<Node, N>() for the nodes that the level has.
template <class Use>
auto with_nodes(const SavedFacts& facts, const Use& use) {
  if (facts.children == 8) return use.template operator()<QuantizedNode8, 8>();
  if (facts.children == 16) return use.template operator()<QuantizedNode16, 16>();
  throw Error(fmt::format("it has compressed nodes of {} children, which no kernel traces", facts.children));
}

std::string quantized_damage(const SavedLevel& level) {
  const SavedFacts& facts = level.facts;
  if (facts.instances) return "it has leaves where none belong";
  if (facts.stack > wide_stack_limit) return "it is deeper than any walk can go";
  return with_nodes(facts, [&]<class Node, int N>() { return QuantizedCheck<Node, N>(level).run(); });
}

std::shared_ptr<const Layout> restore_quantized(const SavedLevel& level, const TraceOptions& trace) {
  const SavedFacts& facts = level.facts;
  if (trace != TraceOptions{}) throw Error("it is to be walked in a way that its nodes are not made for");
  if (facts.stack > wide_stack_limit) throw Error("it is deeper than any walk can go");
  const LeavesAndMesh leaves = split_leaves(level);
  WideView view = quantized_view(level.nodes.data(), leaves.words.data(), leaves.positions, leaves.triangles);
  view.reach = facts.reach;
  view.stack = facts.stack;
  view.out_of_cache = facts.out_of_cache != 0;
  return with_nodes(facts, [&]<class Node, int N>() -> std::shared_ptr<const Layout> {
    if (elements_of<Node>(level.nodes, "nodes").size() < 2) throw Error("it has no root");
    const WideShape shape{facts.nodes, level.nodes.size(), N, facts.inner_children, facts.triangles};
    return std::make_shared<SimdLayout<KeptQuantized>>(KeptQuantized{level, view, shape}, compressed_kernels<N>());
  });
}

Box quantized_bounds(const SavedLevel& level) { return level.facts.triangles == 0 ? Box{} : level.facts.root_box; }

}  // namespace

void QuantizedArena::save(SavedLevel& out) const {
  out.facts.kind = SavedKind::quantized;
  out.facts.children = static_cast<std::uint32_t>(shape.lanes);
  out.facts.out_of_cache = view.out_of_cache ? 1 : 0;
  out.facts.stack = view.stack;
  out.facts.reach = view.reach;
  if (shape.triangles != 0) out.facts.root_box = bounds;
  out.facts.primitives = static_cast<std::uint32_t>(triangles.size());
  out.facts.vertices = positions.size();
  out.facts.nodes = shape.nodes;
  out.facts.inner_children = shape.children;
  out.facts.triangles = shape.triangles;
  out.nodes = {nodes.data(), nodes.bytes()};
  const auto with_mesh = std::make_shared<std::vector<std::byte>>();
  const std::span words(leaves.data(), leaves.bytes());
  for (const auto part : {words, std::as_bytes(positions), std::as_bytes(triangles)}) {
    with_mesh->insert(with_mesh->end(), part.begin(), part.end());
  }
  out.leaves = *with_mesh;
  out.owner = with_mesh;
}

SavedKindEntry saved_quantized() {
  return {SavedKind::quantized, quantized_damage, restore_quantized, quantized_bounds};
}

}  // namespace boxwood
