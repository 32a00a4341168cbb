// Octree of one or two bits per node: Kilian 2021 after Jacobson 1989; spec 004, sections 2.3, 2.4 and 7.2.
#include <fmt/format.h>

#include <cstring>

#include "boxwood/error.h"
#include "layout/bits/chunk_plan.h"
#include "layout/bits/rank.h"
#include "layout/octree/bit_octree_nodes.h"
#include "layout/octree/encode_octree.h"
#include "layout/octree/stages.h"
#include "layout/octree/subtree_packing.h"

namespace boxwood {
namespace {

using Plan = ChunkPlan<OctreeItem>;

Plan plan_octree(const OctreeTopology& topology, BitForm form, std::uint32_t groups) {
  const auto children = [&](const OctreeItem& item, OctreeItem(&out)[8]) { topology.children(item, out); };
  const auto is_inner = [&](const OctreeItem& item) { return topology.is_inner(item); };
  const auto plan = [&](const auto& keeps) { return plan_chunks<8>(topology.root(), children, is_inner, keeps); };
  if (form == BitForm::chunks) return plan(keeps_while_room(groups));
  if (form == BitForm::free) {
    const auto beginnings = pack_subtrees(topology, groups);
    return plan([&](const OctreeItem& item, std::uint32_t) { return !beginnings.contains(item.code); });
  }
  return plan([](const OctreeItem&, std::uint32_t) { return true; });
}

/// `plan` in chunks of `out.chunk_bytes`.
void write_chunks(const Plan& plan, BitOctreeNodes& out) {
  out.chunks = plan.chunks.size();
  out.memory.assign(out.chunks * out.chunk_bytes + BitOctreeNodes::spare, std::byte{0});
  for (std::size_t c = 0; c < plan.chunks.size(); ++c) {
    const PlannedChunk& chunk = plan.chunks[c];
    std::byte* const at = out.memory.data() + c * out.chunk_bytes;
    std::memcpy(at, &chunk.child_chunks, sizeof chunk.child_chunks);
    std::memcpy(at + 4, &chunk.first_leaf, sizeof chunk.first_leaf);
    std::byte* const bits = at + octree_chunk_header;
    for (std::uint32_t i = 0; i < plan.nodes_of(c); ++i) {
      const std::size_t n = chunk.first_node + i;
      if (!plan.inner[n]) continue;
      const bool elsewhere = out.form == BitForm::free && !plan.kept[n];
      set_bit(elsewhere ? bits + out.groups : bits, i);
    }
  }
}

/// `plan`, which is one chunk of any length, in one field.
void write_field(const Plan& plan, BitOctreeNodes& out) {
  const std::size_t words = (plan.nodes.size() + 63) / 64;
  const bool milestones = out.form == BitForm::milestones;
  const std::size_t stride = milestones ? sizeof(Milestone) : sizeof(std::uint64_t);
  out.memory.assign(words * stride + BitOctreeNodes::spare, std::byte{0});
  Milestone word;
  for (std::size_t w = 0; w < words; ++w) {
    word.ones_before += count_ones(word.bits);
    word.bits = 0;
    for (std::size_t i = w * 64; i < std::min(plan.nodes.size(), w * 64 + 64); ++i) {
      word.bits |= std::uint64_t{plan.inner[i]} << i % 64;
    }
    std::memcpy(out.memory.data() + w * stride, &word, stride);
  }
}

struct ChooseBitOctree {
  BitForm form;
  WordBits word;

  auto operator()(const Level<BitOctreeNodes, TriangleLeaves>&) const {
    return bit_octree_triangle_kernels(form, word);
  }
  auto operator()(const Level<BitOctreeNodes, InstanceLeaves>&) const {
    return bit_octree_instance_kernels(form, word);
  }
};

void check(const BitOctreeOptions& options) {
  const std::uint32_t word_bytes = 1u << static_cast<std::uint32_t>(options.word);
  if (options.form != BitForm::chunks && word_bytes != 8) {
    throw UsageError("'bit-octree' counts in words of other than 64 bits only with form=chunks");
  }
  if (options.form == BitForm::flat || options.form == BitForm::milestones) {
    if (options.chunk != ChunkBytes::b16) {
      throw UsageError("'bit-octree' has no chunks with form=flat or milestones; leave out 'chunk'");
    }
  }
}

std::shared_ptr<const Layout> encode(const BitOctreeOptions& options, Tree tree, const Contents& contents,
                                     const TraceOptions& trace) {
  check(options);
  const auto nodes_of = [&](const OctreeTopology& topology, OctreeReferences& references) {
    return encode_bit_octree(topology, tree, options, references);
  };
  return encode_octree(tree, contents, trace, options.mailbox, nodes_of, ChooseBitOctree{options.form, options.word});
}

}  // namespace

BitOctreeNodes encode_bit_octree(const OctreeTopology& topology, const Tree& tree, const BitOctreeOptions& options,
                                 OctreeReferences& references) {
  BitOctreeNodes out;
  out.form = options.form;
  const bool chunked = options.form == BitForm::chunks || options.form == BitForm::free;
  if (chunked) {
    out.chunk_bytes = options.chunk_bytes();
    out.groups = octree_chunk_groups(options.form, out.chunk_bytes);
  }
  out.memory.assign(BitOctreeNodes::spare, std::byte{0});
  out.leaf_offsets.push_back(0);
  if (topology.root().empty()) return out;
  const auto add_leaf = [&](const OctreeItem& item) {
    if (!item.empty()) {
      const Tree::Node& leaf = topology.leaf(item);
      references.append({tree.references.data() + leaf.first, leaf.count});
    }
    out.leaf_offsets.push_back(static_cast<std::uint32_t>(references.references.size()));
  };

  const Plan plan = plan_octree(topology, options.form, out.groups);
  out.root_is_leaf = plan.nodes.empty();
  if (out.root_is_leaf) add_leaf(topology.root());
  out.head.inner_nodes = plan.nodes.size() / 8;
  if (plan.nodes.size() >> 32 != 0) {
    throw Error("'bit-octree' has room for 2^32 nodes; raise the builder's 'primitives'");
  }
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    if (!plan.inner[i]) add_leaf(plan.nodes[i]);
  }
  if (chunked) {
    write_chunks(plan, out);
  } else {
    write_field(plan, out);
  }
  return out;
}

std::vector<LayoutFact> BitOctreeNodes::facts() const {
  std::vector<LayoutFact> facts;
  head.add_facts(facts);
  if (chunk_bytes == 0) return facts;
  const double stored = static_cast<double>(head.inner_nodes) * 8;
  facts.push_back({"chunks", static_cast<double>(chunks)});
  facts.push_back({"chunk_fill", stored, static_cast<double>(chunks) * groups * 8});
  return facts;
}

Stage bit_octree_stage() {
  Stage stage = layout_stage<BitOctreeOptions>(
      "bit-octree", "octree of one or two bits per node", "Kilian 2021, after Jacobson 1989; spec 004",
      OptionsOf<BitOctreeOptions>()
          .choice("chunk", &BitOctreeOptions::chunk, {"16", "32", "64", "128"}, "bytes of a chunk")
          .choice("word", &BitOctreeOptions::word, {"8", "16", "32", "64"}, "bits counted at once")
          .choice("form", &BitOctreeOptions::form, {"chunks", "free", "milestones", "flat"},
                  "chunks filled breadth first; chunks of two bits per node filled as full as can be; one field with "
                  "a count every 64 bits; one field without")
          .flag("mailbox", &BitOctreeOptions::mailbox, "remember what was tested, for primitives in many cells"),
      encode, [](const BitOctreeOptions&) { return 8u; });
  stage.cells = true;
  return stage;
}

}  // namespace boxwood
