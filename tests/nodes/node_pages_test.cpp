// The byte maps of docs/structures say what the compiler lays out.
#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <iterator>
#include <string>

#include "layout/bih/bih_nodes.h"
#include "layout/binary/binary_nodes.h"
#include "layout/compressed/quantized_node.h"
#include "layout/leaves.h"
#include "layout/octree/bit_octree_nodes.h"
#include "layout/quantized/quantized_nodes.h"
#include "layout/simd/wide_node.h"
#include "layout/slab/split_nodes.h"

namespace boxwood {
namespace {

struct Row {
  const char* page;
  const char* node;  ///< as the table's head has it; empty: the first table
  std::size_t at, bytes;
  const char* what;  ///< how the row goes on
};

#define FIELD(page, type, field) \
  { page, #type, offsetof(type, field), sizeof(type::field), "`" #field }

const Row rows[] = {
    {"binary", "", offsetof(BinaryNode, bounds), sizeof(BinaryNode::bounds), "`bounds"},
    {"binary", "", offsetof(BinaryNode, link), sizeof(BinaryNode::link), "`link"},
    {"simd-wide", "WideNode<8>", offsetof(WideNode<8>, planes), sizeof(WideNode<8>::planes), "`planes[6][8]"},
    {"simd-wide", "WideNode<8>", offsetof(WideNode<8>, children), sizeof(WideNode<8>::children), "`children[8]"},
    {"simd-wide", "LeafBlock<4>", offsetof(LeafBlock<4>, vertices), sizeof(LeafBlock<4>::vertices),
     "`vertices[3][3][4]"},
    {"simd-wide", "LeafBlock<4>", offsetof(LeafBlock<4>, primitives), sizeof(LeafBlock<4>::primitives),
     "`primitives[4]"},
    FIELD("compressed", QuantizedNode8, planes),
    FIELD("compressed", QuantizedNode8, origin),
    FIELD("compressed", QuantizedNode8, exponent),
    FIELD("compressed", QuantizedNode8, inner),
    FIELD("compressed", QuantizedNode8, first_node),
    FIELD("compressed", QuantizedNode8, first_leaf),
    FIELD("compressed", QuantizedNode8, place),
    {"slab", "SlabNode", offsetof(SlabNode<Word32>, plane), sizeof(SlabNode<Word32>::plane), "`plane"},
    {"slab", "SlabNode", offsetof(SlabNode<Word32>, word), sizeof(SlabNode<Word32>::word), "`word"},
    {"binary-split", "BoxNode", offsetof(BoxNode<Word32>, bounds), sizeof(BoxNode<Word32>::bounds), "`bounds"},
    {"binary-split", "BoxNode", offsetof(BoxNode<Word32>, word), sizeof(BoxNode<Word32>::word), "`word"},
    FIELD("bih", BihNode, planes),
    FIELD("bih", BihNode, word),
    FIELD("bit-octree", Milestone, bits),
    FIELD("bit-octree", Milestone, ones_before),
    FIELD("quantized", PointerNode, key),
    FIELD("quantized", PointerNode, count),
    FIELD("quantized", PointerNode, first),
    FIELD("quantized", PointerNode, axis),
    FIELD("quantized", QuantizedMilestone, box),
    FIELD("quantized", QuantizedMilestone, bits),
    FIELD("quantized", QuantizedMilestone, ones_before),
    FIELD("two-levels", InstanceLeaf, world_to_object),
    FIELD("two-levels", InstanceLeaf, bottom),
    FIELD("two-levels", InstanceLeaf, instance),
};

std::string page_text(const char* page) {
  std::ifstream in(std::string(BOXWOOD_SOURCE_DIR) + "/docs/structures/" + page + ".md");
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(NodePages, ByteMapsAreThoseOfTheCode) {
  for (const Row& row : rows) {
    const std::string text = page_text(row.page);
    ASSERT_FALSE(text.empty()) << row.page;
    const std::string head = *row.node ? std::string("| `") + row.node + "` at |" : "| at |";
    const std::size_t table = text.find(head);
    ASSERT_NE(table, std::string::npos) << row.page << " has no table " << head;
    const std::string found = text.substr(table, text.find("\n\n", table) - table);
    const std::string line = "| " + std::to_string(row.at) + " | " + std::to_string(row.bytes) + " | " + row.what;
    EXPECT_NE(found.find(line), std::string::npos) << row.page << ".md, " << head << " has no row " << line;
  }
}

TEST(NodePages, SizesAreThoseOfTheCode) {
  const auto says = [](const char* page, const std::string& words) {
    EXPECT_NE(page_text(page).find(words), std::string::npos) << page << ".md does not say '" << words << "'";
  };
  const auto size = [](const char* node, std::size_t bytes) {
    return std::string(node) + ", " + std::to_string(bytes) + " bytes";
  };
  says("binary", size("BinaryNode", sizeof(BinaryNode)));
  says("binary", std::to_string(sizeof(LeafTriangle)) + " bytes each");
  says("simd-wide", size("WideNode<8>", sizeof(WideNode<8>)));
  says("simd-wide", "Sizes: " + std::to_string(sizeof(WideNode<4>)) + " bytes for four children, " +
                        std::to_string(sizeof(WideNode<8>)) + " for eight, " + std::to_string(sizeof(WideNode<16>)));
  says("simd-wide", "blocks of eight triangles (" + std::to_string(sizeof(LeafBlock<8>)) + " bytes)");
  says("compressed", size("QuantizedNode8", sizeof(QuantizedNode8)));
  says("compressed", "`QuantizedNode16` has " + std::to_string(sizeof(QuantizedNode16)) + " bytes");
  says("slab", size("SlabNode", sizeof(SlabNode<Word32>)));
  says("slab", "takes " + std::to_string(sizeof(SlabNode<Word64>)) + " bytes");
  says("binary-split", size("BoxNode", sizeof(BoxNode<Word32>)));
  says("bih", size("BihNode", sizeof(BihNode)));
  says("quantized", size("PointerNode", sizeof(PointerNode)));
  says("quantized", std::to_string(sizeof(NodeInfo)) + " bytes per node");
  says("quantized", std::to_string(sizeof(ChunkHeader)) + " bytes (`ChunkHeader`");
  says("two-levels", size("InstanceLeaf", sizeof(InstanceLeaf)));
}

}  // namespace
}  // namespace boxwood
