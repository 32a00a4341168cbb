// Compressed trees in files. Some of their leaves only name triangles, so the mesh goes with them:
// positions, triangles.
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

struct SavedMesh {
  std::span<const Vec3> positions;
  std::span<const Triangle> triangles;
};

/// Throws Error when it is not as long as the facts say.
SavedMesh mesh_of(const SavedLevel& level) {
  const std::size_t size = level.leaves.size();
  const std::uint64_t vertices = level.facts.vertices, triangles = level.facts.primitives;
  if (vertices > size / sizeof(Vec3) || vertices * sizeof(Vec3) + triangles * sizeof(Triangle) != size) {
    throw Error("its mesh ends within a triangle");
  }
  return {elements_of<Vec3>(level.leaves.first(vertices * sizeof(Vec3)), "vertices"),
          elements_of<Triangle>(level.leaves.subspan(vertices * sizeof(Vec3)), "triangles")};
}

/// A compressed tree in memory that someone else keeps.
struct KeptQuantized {
  SavedLevel level;
  WideView view;
  WideShape shape;

  std::size_t bytes() const { return level.nodes.size(); }
  std::vector<LayoutFact> facts() const { return shape.facts(bytes()); }
  void save(SavedLevel& out) const { out = level; }
};

/// What lies where; each word may belong to one thing only.
template <class Node, int N>
class QuantizedCheck {
 public:
  explicit QuantizedCheck(const SavedLevel& level)
      : facts_(level.facts), words_(elements_of<std::uint32_t>(level.nodes, "words")), mesh_(mesh_of(level)) {}

  std::string run() {
    for (const Triangle& triangle : mesh_.triangles) {
      for (const std::uint32_t vertex : triangle) {
        if (vertex >= mesh_.positions.size()) return "a triangle of its mesh names a vertex that it does not have";
      }
    }
    taken_.resize(words_.size());
    const std::optional<WideReference> bad = find_bad_reference<N>(quantized_root(sizeof(Node)), facts_.stack, *this);
    if (!bad) return {};
    return fmt::format("{} {} is none that any walk could use", is_leaf(*bad) ? "leaf" : "node", *bad >> 1);
  }

  const Node* take_node(WideReference reference) {
    const std::size_t place = reference >> 1;
    const bool aligned = place * sizeof(std::uint32_t) % alignof(Node) == 0;
    if (place == 0 || !aligned || !take_words(place, sizeof(Node) / sizeof(std::uint32_t))) return nullptr;
    return reinterpret_cast<const Node*>(&words_[place]);
  }

  bool take_leaf(WideReference reference) {
    const std::size_t place = reference >> 1;
    if (place == 0 || place >= words_.size()) return false;
    if ((words_[place] & packed_leaf) != 0) return take_packed(place);
    return (facts_.leaf_forms & named_leaves) != 0 && take_names(place);
  }

  /// As the kernels find it, in the same arithmetic; 0 where there is none.
  static WideReference child(const Node& node, int lane) {
    if constexpr (N == 16)
      return node.children[lane];
    else
      return child_of_eight(node, lane);
  }
  static Box box(const Node& node, int lane) {
    const Grid grid = grid_of(node);
    Box out;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      out.lower[axis] = grid.at(axis, node.planes[2 * axis][lane]);
      out.upper[axis] = grid.at(axis, node.planes[2 * axis + 1][lane]);
    }
    return out;
  }
  static bool is_unused(const Node& node, int lane) { return child(node, lane) == wide_nothing; }

 private:
  /// Takes `size` words, behind which there are enough for kernels to read.
  bool take_words(std::size_t place, std::size_t size) {
    if (place + size + words_at_once > words_.size()) return false;
    for (std::size_t i = place; i < place + size; ++i) {
      if (taken_[i]) return false;
      taken_[i] = true;
    }
    return true;
  }

  bool take_names(std::size_t place) {
    for (bool more = true; more; ++place) {
      if (!take_words(place, 1)) return false;
      const std::uint32_t name = words_[place];
      if ((name & ~last_of_leaf) >= mesh_.triangles.size()) return false;
      more = (name & last_of_leaf) == 0;
    }
    return true;
  }

  bool take_packed(std::size_t place) {
    for (bool more = true; more;) {
      if (place + words_at_once > words_.size() || !is_sound_packed(place)) return false;
      const std::uint32_t* words = &words_[place];
      more = (words[0] & packed_more) != 0;
      place += words_of_packed(words);
    }
    return true;
  }

  /// Takes the words of a part as well. Those that a head and its corners' changes say are read before they are taken:
  /// there are enough.
  bool is_sound_packed(std::size_t place) {
    const std::uint32_t* words = &words_[place];
    const PackedLeafHead head(words[0]);
    if ((words[0] & packed_leaf) == 0 || head.number_bits > 32) return false;
    PackedBits joined(words, 8 * PackedLeafHead::begin_of_joined(head.pairs));
    const NumberRuns runs(joined.take(most_packed_triangles));
    if ((runs.firsts & 1) == 0) return false;
    if (head.bytes_of_numbers != PackedLeafHead::bytes_of(runs.count() - 1, head.number_bits)) return false;
    return has_allowed_form(head) && are_sound_corners(place, head) && take_words(place, words_of_packed(words)) &&
           are_sound_triangles(words, head, runs);
  }

  bool has_allowed_form(const PackedLeafHead& head) const {
    if ((facts_.leaf_forms & tight_leaves) != 0) return true;
    return head.pairs == PackedLeafHead::all_pairs && std::ranges::none_of(head.codes, PackedLeafHead::repeats);
  }

  /// Whether what axes that repeat begin with lies within the words, and has no corner that is not there.
  bool are_sound_corners(std::size_t place, const PackedLeafHead& head) const {
    const auto bytes = std::as_bytes(words_.subspan(place));
    const auto* stream = reinterpret_cast<const std::uint8_t*>(bytes.data());
    std::size_t at = head.begin_of_corners();
    for (const std::uint32_t code : head.codes) {
      if (at + PackedLeafHead::bytes_of_changes > bytes.size()) return false;
      if (PackedLeafHead::repeats(code) && PackedLeafHead::changes_at(stream + at) >> head.corners != 0) return false;
      at += head.bytes_of_axis(code, stream + at);
    }
    return true;
  }

  /// Those that are missing are points, and have no number. The first is there: its number must not look like a flag.
  bool are_sound_triangles(const std::uint32_t* words, const PackedLeafHead& head, const NumberRuns& runs) const {
    PackedBits numbers(words, 8 * PackedLeafHead::begin_of_numbers(head.pairs));
    std::uint64_t number = words[1];
    for (std::uint32_t i = 0; i < most_packed_triangles; ++i) {
      std::uint32_t corner[3] = {};
      for (std::uint32_t vertex = 0; vertex < 3 && i < 2 * head.pairs; ++vertex) {
        const std::uint32_t begin = 8 * (PackedLeafHead::begin_of_indices + head.pairs * vertex);
        corner[vertex] = PackedBits(words, begin + 4 * i).take(4);
        if (corner[vertex] >= head.corners) return false;
      }
      const bool first = (runs.firsts >> i & 1) != 0;
      if (i != 0) number = first ? std::uint64_t{words[1]} + numbers.take(head.number_bits) : number + 1;
      const bool point = corner[0] == corner[1] && corner[0] == corner[2];
      if (number >= mesh_.triangles.size() && (i == 0 || !point)) return false;
    }
    return true;
  }

  static WideReference child_of_eight(const QuantizedNode8& node, int lane) {
    if (node.place[lane] == no_child) return wide_nothing;
    const bool inner = (node.inner >> lane & 1) != 0;
    return (inner ? node.first_node : node.first_leaf) + std::uint32_t{node.place[lane]} * 2;
  }

  const SavedFacts& facts_;
  std::span<const std::uint32_t> words_;
  SavedMesh mesh_;
  std::vector<bool> taken_;
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
  const SavedMesh mesh = mesh_of(level);
  return with_nodes(facts, [&]<class Node, int N>() -> std::shared_ptr<const Layout> {
    if (level.nodes.size() < 2 * sizeof(Node)) throw Error("it has no root");
    WideView view = quantized_view(level.nodes.data(), sizeof(Node), mesh.positions, mesh.triangles);
    view.reach = facts.reach;
    view.stack = facts.stack;
    view.out_of_cache = facts.out_of_cache != 0;
    view.tight = (facts.leaf_forms & tight_leaves) != 0;
    if ((facts.leaf_forms & named_leaves) == 0) view.positions = nullptr;
    const WideShape shape{facts.nodes, facts.nodes * sizeof(Node), N, facts.inner_children, facts.triangles};
    return std::make_shared<SimdLayout<KeptQuantized>>(KeptQuantized{level, view, shape}, compressed_kernels<N>());
  });
}

Box quantized_bounds(const SavedLevel& level) { return level.facts.triangles == 0 ? Box{} : level.facts.root_box; }

}  // namespace

void QuantizedArena::save(SavedLevel& out) const {
  out.facts.kind = SavedKind::quantized;
  out.facts.children = static_cast<std::uint32_t>(shape.lanes);
  out.facts.out_of_cache = view.out_of_cache ? 1 : 0;
  out.facts.leaf_forms = (view.tight ? tight_leaves : 0) | (view.positions != nullptr ? named_leaves : 0);
  out.facts.stack = view.stack;
  out.facts.reach = view.reach;
  if (shape.triangles != 0) out.facts.root_box = bounds;
  out.facts.primitives = static_cast<std::uint32_t>(triangles.size());
  out.facts.vertices = positions.size();
  out.facts.nodes = shape.nodes;
  out.facts.inner_children = shape.children;
  out.facts.triangles = shape.triangles;
  out.nodes = {memory.data(), memory.bytes()};
  const auto mesh = std::make_shared<std::vector<std::byte>>();
  for (const auto part : {std::as_bytes(positions), std::as_bytes(triangles)}) {
    mesh->insert(mesh->end(), part.begin(), part.end());
  }
  out.leaves = *mesh;
  out.owner = mesh;
}

SavedKindEntry saved_quantized() {
  return {SavedKind::quantized, quantized_damage, restore_quantized, quantized_bounds};
}

}  // namespace boxwood
