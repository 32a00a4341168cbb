#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "boxwood/error.h"
#include "layout/bits/chunk_plan.h"
#include "layout/bits/rank.h"
#include "layout/encode.h"
#include "layout/quantized/chunk_filling.h"
#include "layout/quantized/quantized_nodes.h"

namespace boxwood {
namespace {

constexpr std::uint32_t absent = ~std::uint32_t{0};
using Plan = ChunkPlan<std::uint32_t>;  // of places in the tree, or absent

template <std::uint32_t k>
Plan plan_tree(const Tree& tree, std::uint32_t groups, const QuantizedOptions& options) {
  const auto children = [&](std::uint32_t node, std::uint32_t(&out)[k]) {
    for (std::uint32_t c = 0; c < k; ++c) out[c] = c < tree.nodes[node].count ? tree.nodes[node].first + c : absent;
  };
  const auto is_inner = [&](std::uint32_t node) { return node != absent && !tree.nodes[node].is_leaf(); };
  const auto plan = [&](const auto& keeps) { return plan_chunks<k>(std::uint32_t{0}, children, is_inner, keeps); };
  if (options.form == QuantizedForm::chunks) return plan(keeps_while_room(groups));
  if (options.form == QuantizedForm::free) {
    const std::vector<std::uint8_t> begins = chunk_beginnings(tree, groups, options.fill);
    return plan([&](std::uint32_t node, std::uint32_t) { return begins[node] == 0; });
  }
  return plan([](std::uint32_t, std::uint32_t) { return true; });  // one field
}

Plan plan_tree(const Tree& tree, std::uint32_t groups, const QuantizedOptions& options) {
  if (options.arity() == 2) return plan_tree<2>(tree, groups, options);
  return options.arity() == 4 ? plan_tree<4>(tree, groups, options) : plan_tree<8>(tree, groups, options);
}

/// Groups of k siblings that a chunk has room for; of forms without chunks, 0.
std::uint32_t groups_in(const QuantizedOptions& options) {
  const std::uint32_t bits = (options.chunk_bytes() - std::uint32_t{sizeof(ChunkHeader)}) * 8;
  switch (options.form) {
    case QuantizedForm::chunks:
      return bits / options.arity();
    case QuantizedForm::free:
      return bits / 2 / options.arity();
    default:
      return 0;
  }
}

std::uint8_t axis_byte(const Tree::Node& node) { return static_cast<std::uint8_t>(node.axis | node.fixed_order << 2); }

class ChunkEncoder {
 public:
  ChunkEncoder(Tree& tree, const QuantizedOptions& options) : tree_(tree), options_(options) {
    out_.form = options.form;
    out_.k = options.arity();
    out_.chunk_bytes = options.chunk_bytes();
    out_.groups = groups_in(options);
    out_.memory.assign(QuantizedChunks::spare, std::byte{0});
  }

  QuantizedChunks run() {
    if (tree_.empty()) return std::move(out_);
    out_.root_box = tree_.nodes[0].bounds;
    plan_ = plan_tree(tree_, out_.groups, options_);
    if (plan_.chunks.size() > std::uint64_t{1} << (32 - out_.bit_bits())) {
      throw Error(fmt::format("'quantized' has room for {} chunks, not {}; build with larger leaves",
                              std::uint64_t{1} << (32 - out_.bit_bits()), plan_.chunks.size()));
    }
    number_leaves();
    out_.root = link_to(tree_.nodes[0], 0);
    if (!plan_.nodes.empty()) {
      out_.infos.resize(plan_.nodes.size());
      if (options_.form == QuantizedForm::milestones) {
        write_field();
      } else {
        write_chunks();
      }
    }
    return std::move(out_);
  }

 private:
  void number_leaves() {
    Tree::References references;
    references.reserve(tree_.references.size());
    out_.leaf_offsets.push_back(0);
    const auto add = [&](std::uint32_t place) {
      if (place != absent) {
        const Tree::Node& leaf = tree_.nodes[place];
        const auto begin = tree_.references.begin() + leaf.first;
        references.insert(references.end(), begin, begin + leaf.count);
      }
      out_.leaf_offsets.push_back(static_cast<std::uint32_t>(references.size()));
    };
    if (tree_.nodes[0].is_leaf()) add(0);
    for (std::size_t i = 0; i < plan_.nodes.size(); ++i) {
      if (!plan_.inner[i]) add(plan_.nodes[i]);
      out_.absent += plan_.nodes[i] == absent ? 1 : 0;
    }
    tree_.references = std::move(references);
  }

  void write_chunks() {
    out_.chunks = plan_.chunks.size();
    out_.memory.assign(out_.chunks * out_.chunk_bytes + QuantizedChunks::spare, std::byte{0});
    std::vector<std::uint32_t> roots = chunk_roots();
    for (std::size_t c = 0; c < plan_.chunks.size(); ++c) write_chunk(c, tree_.nodes[roots[c]].bounds);
  }

  /// The implicit root of every chunk: inner nodes whose children are elsewhere, in the order of chunks.
  std::vector<std::uint32_t> chunk_roots() const {
    std::vector<std::uint32_t> roots{0};
    for (std::size_t i = 0; i < plan_.nodes.size(); ++i) {
      if (plan_.inner[i] && !plan_.kept[i]) roots.push_back(plan_.nodes[i]);
    }
    return roots;
  }

  void write_chunk(std::size_t c, const Box& box) {
    const PlannedChunk& chunk = plan_.chunks[c];
    std::byte* const at = out_.memory.data() + c * out_.chunk_bytes;
    const ChunkHeader header{box, chunk.child_chunks, chunk.first_leaf, chunk.first_node, 0};
    std::memcpy(at, &header, sizeof header);
    // Frames of the groups in the chunk, in order: of the first the root's, of the others their parents' as decoded.
    std::vector<Box> frames{box};
    std::byte* const here = at + sizeof header;
    std::byte* const elsewhere =
        options_.form == QuantizedForm::free ? here + (out_.chunk_bytes - sizeof header) / 2 : here;
    for (std::uint32_t i = 0; i < plan_.nodes_of(c); ++i) {
      const std::size_t n = chunk.first_node + i;
      if (plan_.inner[n]) set_bit(plan_.kept[n] ? here : elsewhere, i);
      const Box frame = options_.frame == QuantizedFrame::parent ? frames[i / out_.k] : box;
      write_info(n, frame);
      if (plan_.kept[n]) frames.push_back(decode(out_.infos[n].key, frame));
    }
  }

  /// All of the plan, which is one chunk of any length, in one field.
  void write_field() {
    const std::size_t runs = (plan_.nodes.size() + 63) / 64;
    out_.memory.assign(runs * sizeof(QuantizedMilestone) + QuantizedChunks::spare, std::byte{0});
    std::uint32_t ones = 0;
    for (std::size_t run = 0; run < runs; ++run) {
      QuantizedMilestone milestone;
      milestone.ones_before = ones;
      const std::size_t begin = run * 64, end = std::min(plan_.nodes.size(), begin + 64);
      for (std::size_t n = begin; n < end; ++n) {
        milestone.bits |= std::uint64_t{plan_.inner[n]} << n % 64;
        if (plan_.nodes[n] != absent) milestone.box.grow(tree_.nodes[plan_.nodes[n]].bounds);
      }
      for (std::size_t n = begin; n < end; ++n) write_info(n, milestone.box);
      ones += count_ones(milestone.bits);
      std::memcpy(out_.memory.data() + run * sizeof milestone, &milestone, sizeof milestone);
    }
  }

  void write_info(std::size_t n, const Box& frame) {
    NodeInfo& info = out_.infos[n];
    if (plan_.nodes[n] == absent) {
      info.key = absent_box;
      return;
    }
    const Tree::Node& node = tree_.nodes[plan_.nodes[n]];
    info.key = encode(node.bounds, frame);
    info.axis = axis_byte(node);
  }

  Tree& tree_;
  const QuantizedOptions& options_;
  Plan plan_;
  QuantizedChunks out_;
};

}  // namespace

QuantizedChunks encode_quantized_chunks(Tree& tree, const QuantizedOptions& options) {
  check_walkable(tree, options.arity(), fmt::format("quantized({})", options.arity()));
  return ChunkEncoder(tree, options).run();
}

std::vector<LayoutFact> QuantizedChunks::facts() const {
  std::vector<LayoutFact> facts = {{"absent_children", static_cast<double>(absent)}};
  if (form == QuantizedForm::milestones) return facts;
  facts.push_back({"chunks", static_cast<double>(chunks)});
  facts.push_back({"chunk_fill", static_cast<double>(infos.size()), static_cast<double>(chunks) * groups * k});
  return facts;
}

}  // namespace boxwood
