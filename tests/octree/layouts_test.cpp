// Every layout of an octree, walked in every way, gives the answers of brute force to the bit, and keeps the tree.
#include "support/layouts.h"

#include <gtest/gtest.h>

#include <cctype>

#include "layout/octree/bit_octree_navigators.h"
#include "layout/octree/octree_nodes.h"
#include "octree/octrees.h"
#include "support/differential.h"
#include "support/rays.h"

namespace boxwood {
namespace {

/// A layout call as a recipe has it.
struct Call {
  Stage stage;
  std::any options;
  std::string text;
};

Call layout_call(const std::string& text) {
  const CallText parts = parse_call_text(text);
  Call call{parts.name == "octree" ? octree_layout_stage() : bit_octree_stage(), {}, text};
  call.options = call.stage.defaults;
  for (const std::string_view argument : parts.arguments) {
    set_option(call.stage.name, call.stage.options, call.options, argument);
  }
  return call;
}

const std::vector<std::string> layout_texts = {"octree",
                                               "octree(mailbox=off)",
                                               "bit-octree",
                                               "bit-octree(word=8)",
                                               "bit-octree(chunk=32, word=16)",
                                               "bit-octree(chunk=64, word=32, mailbox=off)",
                                               "bit-octree(chunk=128)",
                                               "bit-octree(form=free)",
                                               "bit-octree(form=free, chunk=32)",
                                               "bit-octree(form=free, chunk=64)",
                                               "bit-octree(form=free, chunk=128)",
                                               "bit-octree(form=milestones)",
                                               "bit-octree(form=flat)"};

Tree instance_tree(const Scene& scene, const std::string& builder) {
  BuildInput input;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    Box box;
    for (const Box& b : test::triangle_boxes(scene.meshes[scene.instances[i].mesh])) box.grow(b);
    const Box world = scene.instances[i].object_to_world.box(box);
    input.references.push_back({world.lower, i, world.upper});
  }
  const StageCall call = test::octree_call(builder);
  return call.stage->build(call.options, std::move(input));
}

std::shared_ptr<const Layout> encode(const Scene& scene, const Call& layout, const std::string& builder,
                                     const TraceOptions& trace = {}) {
  const auto encode_mesh = [&](const Mesh& mesh) {
    Contents contents;
    contents.mesh = &mesh;
    return layout.stage.encode(layout.options, test::octree_of(mesh, builder), contents, trace);
  };
  if (scene.single_level()) return encode_mesh(scene.meshes[0]);
  std::vector<std::shared_ptr<const Layout>> bottoms;
  for (const Mesh& mesh : scene.meshes) bottoms.push_back(encode_mesh(mesh));
  Contents contents;
  contents.instances = scene.instances;
  contents.bottoms = bottoms;
  return layout.stage.encode(layout.options, instance_tree(scene, builder), contents, trace);
}

struct Case {
  test::NamedScene named;
  test::Expected expected;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> out;
    for (test::NamedScene& named : test::troubled_scenes()) {
      test::Expected expected(named.scene, test::troubling_rays(named.scene, 300, 90 + out.size()));
      out.push_back({std::move(named), std::move(expected)});
    }
    return out;
  }();
  return all;
}

class OctreeLayout : public testing::TestWithParam<std::string> {};

TEST_P(OctreeLayout, GivesTheAnswersOfBruteForceHoweverItIsWalked) {
  const Call layout = layout_call(GetParam());
  const std::string builder = "octree(primitives=3, multiplication=4, depth=5, budget=10000)";
  for (const TraceOptions& trace :
       {TraceOptions{}, TraceOptions{.simd = false}, TraceOptions{.order = ChildOrder::none},
        TraceOptions{.order = ChildOrder::none, .cull = false, .mode = TraversalMode::recursive, .simd = false},
        TraceOptions{.mode = TraversalMode::recursive}}) {
    for (const Case& c : cases()) {
      test::expect_brute_force_answers(*encode(c.named.scene, layout, builder, trace), c.expected,
                                       layout.text + " over " + c.named.name);
    }
  }
}

TEST_P(OctreeLayout, ClosedMesh_IsNeverLeftFromInside) {
  const Call layout = layout_call(GetParam());
  for (const Scene& scene :
       {test::sphere(12), test::cube(8), test::transformed(test::sphere(8), 1, {1000, -2000, 3000})}) {
    const auto encoded = encode(scene, layout, "octree(primitives=2, multiplication=3, depth=6)");
    const Box box = scene.bounds();
    Random random(3);
    for (int i = 0; i < 3000; ++i) {
      const Mesh& mesh = scene.meshes[0];
      const Triangle& triangle = mesh.triangles[random.below(static_cast<std::uint32_t>(mesh.triangles.size()))];
      const Vec3 a = mesh.positions[triangle[0]], b = mesh.positions[triangle[1]];
      const Vec3 target = random.below(2) ? a : a + (b - a) * random.uniform();
      const Vec3 origin =
          random.below(4) == 0 ? box.center() : box.center() + test::random_point(random, 0.2f * box.extent().x);
      const Ray ray{origin, 0, test::jitter(target, random) - origin};
      ASSERT_TRUE(encoded->closest_hit(ray).valid()) << i;
      ASSERT_TRUE(encoded->any_hit(ray)) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Each, OctreeLayout, testing::ValuesIn(layout_texts), [](const auto& test) {
  std::string name;
  for (const char c : test.param) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
});

TEST(OctreeLayouts, AnyBuilderOptions_GiveTheAnswersOfBruteForce) {
  for (const std::string& builder : test::octree_calls()) {
    for (const char* layout : {"octree", "bit-octree"}) {
      for (const Case& c : cases()) {
        test::expect_brute_force_answers(*encode(c.named.scene, layout_call(layout), builder), c.expected,
                                         builder + " > " + layout + " over " + c.named.name);
      }
    }
  }
}

/// The walk through the topology that `navigator` reads must be that of `topology`, leaf for leaf.
template <class Navigator>
void expect_same_tree(const Navigator& navigator, const typename Navigator::Node& node, const OctreeTopology& topology,
                      const OctreeItem& item, const Tree& tree, const OctreeReferences& references) {
  ASSERT_EQ(navigator.is_leaf(node), !topology.is_inner(item));
  if (!topology.is_inner(item)) {
    const OctreeLeaf leaf = navigator.leaf(node);
    std::vector<std::uint32_t> found, expected;
    for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
      found.push_back(references.primitives[references.references[i]]);
    }
    if (!item.empty()) {
      const auto begin = tree.references.begin() + topology.leaf(item).first;
      expected.assign(begin, begin + topology.leaf(item).count);
    }
    ASSERT_EQ(found, expected);
    return;
  }
  OctreeItem children[8];
  topology.children(item, children);
  const auto group = navigator.children(node);
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    expect_same_tree(navigator, navigator.child(group, octant), topology, children[octant], tree, references);
  }
}

template <class Navigator>
void expect_reconstruction(const Tree& tree, const BitOctreeOptions& options) {
  const OctreeTopology topology(tree);
  OctreeReferences references;
  const BitOctreeNodes nodes = encode_bit_octree(topology, tree, options, references);
  const Navigator navigator(nodes);
  expect_same_tree(navigator, navigator.root(), topology, topology.root(), tree, references);
}

TEST(BitOctree, OfAnyForm_IsTheTreeAgain) {
  for (const std::uint32_t triangles : {1u, 5u, 30u, 300u, 3000u}) {
    const Mesh mesh = test::soup(triangles, 0.1f, triangles).meshes[0];
    const Tree tree = test::octree_of(mesh, "octree(primitives=2, multiplication=3, depth=9)");
    for (const ChunkBytes chunk : {ChunkBytes::b16, ChunkBytes::b32, ChunkBytes::b64, ChunkBytes::b128}) {
      expect_reconstruction<ChunkNavigator<std::uint8_t>>(tree, {.chunk = chunk});
      expect_reconstruction<ChunkNavigator<std::uint16_t>>(tree, {.chunk = chunk});
      expect_reconstruction<ChunkNavigator<std::uint32_t>>(tree, {.chunk = chunk});
      expect_reconstruction<ChunkNavigator<std::uint64_t>>(tree, {.chunk = chunk});
      expect_reconstruction<FreeNavigator>(tree, {.form = BitForm::free, .chunk = chunk});
    }
    expect_reconstruction<FieldNavigator<true>>(tree, {.form = BitForm::milestones});
    expect_reconstruction<FieldNavigator<false>>(tree, {.form = BitForm::flat});
  }
}

double fact(const Layout& layout, const std::string& name) {
  for (const LayoutFact& f : layout.facts()) {
    if (f.name == name) return f.figure();
  }
  ADD_FAILURE() << "no fact " << name;
  return 0;
}

TEST(OctreeLayouts, ReportTheBytesOfTheFormulas) {
  const Scene scene = test::soup(3000, 0.1f, 3);
  const auto plain = encode(scene, layout_call("octree"), "octree");
  const double nodes = fact(*plain, "octree_nodes"), references = fact(*plain, "leaf_references");
  EXPECT_EQ(fact(*plain, "octree_leaves"), (nodes - 1) / 8 * 7 + 1);
  EXPECT_EQ(fact(*plain, "topology_bytes"), 4 * (nodes + 7));
  EXPECT_EQ(plain->bytes(), static_cast<std::size_t>(2 * 4 * (nodes + 7) + 4 * references + 40 * 3000));
  EXPECT_EQ(fact(*plain, "primitive_multiplication"), references / 3000);
  for (const std::string chunk : {"16", "32", "64", "128"}) {
    const auto bits = encode(scene, layout_call("bit-octree(chunk=" + chunk + ")"), "octree");
    EXPECT_EQ(fact(*bits, "octree_nodes"), nodes);
    EXPECT_EQ(fact(*bits, "topology_bytes"), fact(*bits, "chunks") * std::stod(chunk));
    EXPECT_DOUBLE_EQ(fact(*bits, "chunk_fill"), (nodes - 1) / (fact(*bits, "chunks") * (std::stod(chunk) - 8) * 8));
    // Free filling never needs more chunks than filling breadth first with as many groups.
    const auto free = encode(scene, layout_call("bit-octree(form=free, chunk=" + chunk + ")"), "octree");
    EXPECT_GT(fact(*free, "chunk_fill"), fact(*bits, "chunk_fill")) << chunk;
  }
  EXPECT_EQ(fact(*encode(scene, layout_call("bit-octree(form=flat)"), "octree"), "topology_bytes"),
            8 * std::ceil((nodes - 1) / 64));
  EXPECT_EQ(fact(*encode(scene, layout_call("bit-octree(form=milestones)"), "octree"), "topology_bytes"),
            12 * std::ceil((nodes - 1) / 64));
}

std::vector<RayCounters> counters_of(const Layout& layout, const std::vector<Ray>& rays) {
  std::vector<Hit> hits(rays.size());
  std::vector<RayCounters> counters(rays.size());
  layout.closest_hits_counted(rays, hits, counters);
  return counters;
}

TEST(OctreeLayouts, WalkTheSameCellsInTheSameOrder) {
  const Scene scene = test::soup(2000, 0.1f, 3);
  const std::vector<Ray> rays = test::troubling_rays(scene, 600, 8);
  // What a mailbox forgets depends on how a layout numbers primitives.
  const auto without_mailbox = [](std::string text) {
    if (text.back() != ')') return text + "(mailbox=off)";
    text.back() = ',';
    return text + " mailbox=off)";
  };
  const auto expected = counters_of(*encode(scene, layout_call("octree(mailbox=off)"), "octree"), rays);
  for (const std::string& text : layout_texts) {
    if (text.find("mailbox") != std::string::npos) continue;
    const Call call = layout_call(without_mailbox(text));
    EXPECT_EQ(counters_of(*encode(scene, call, "octree"), rays), expected) << text;
    EXPECT_EQ(counters_of(*encode(scene, call, "octree", {.simd = false}), rays), expected) << text;
  }
}

TEST(OctreeLayouts, Mailbox_SavesTests) {
  const Scene scene = test::soup(2000, 0.3f, 3);
  const std::vector<Ray> rays = test::troubling_rays(scene, 300, 8);
  const auto tests = [&](const char* layout) {
    std::uint64_t sum = 0;
    for (const RayCounters& c : counters_of(*encode(scene, layout_call(layout), "octree(multiplication=4)"), rays)) {
      sum += c.primitive_tests;
    }
    return sum;
  };
  EXPECT_LT(tests("octree"), tests("octree(mailbox=off)") * 9 / 10);
}

TEST(OctreeLayouts, ATreeWithoutCells_IsRefused) {
  const Scene scene = test::soup(20, 0.1f, 4);
  Contents contents;
  contents.mesh = &scene.meshes[0];
  const Tree tree = test::split_tree(test::triangle_boxes(scene.meshes[0]), {8, 1, false});
  for (const std::string& text : layout_texts) {
    const Call call = layout_call(text);
    EXPECT_THROW(call.stage.encode(call.options, tree, contents, {}), UsageError) << text;
  }
}

}  // namespace
}  // namespace boxwood
