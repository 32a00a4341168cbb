// Quantized boxes hold the exact ones, and every quantized layout gives the answers of brute force to the bit.
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>

#include "boxwood/error.h"
#include "layout/quantized/quantized_nodes.h"
#include "layout/quantized/stages.h"
#include "layout/quantized/testers-inl.h"
#include "options/call.h"
#include "support/differential.h"
#include "support/layouts.h"
#include "support/rays.h"

namespace boxwood {
namespace {

/// A box inside `frame`; now and then it is flat or reaches to the frame's sides.
Box box_within(const Box& frame, Random& random) {
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto within = [&] {
      const float share = random.below(6) == 0 ? static_cast<float>(random.below(2)) : random.uniform();
      return std::clamp(frame.lower[axis] + (frame.upper[axis] - frame.lower[axis]) * share, frame.lower[axis],
                        frame.upper[axis]);
    };
    const float a = within(), b = random.below(8) == 0 ? a : within();
    box.lower[axis] = std::min(a, b), box.upper[axis] = std::max(a, b);
  }
  return box;
}

Box random_frame(Random& random) {
  const float scale = std::pow(10.0f, random.uniform(-44, 11));
  const Vec3 center = test::random_point(random, scale * std::pow(10.0f, random.uniform(0, 5)));
  Vec3 half = test::random_point(random, scale);
  half = max(half, -half);
  if (random.below(5) == 0) half[random.below(3)] = 0;
  return {center - half, center + half};
}

TEST(QuantizedBox, HoldsTheExactBox) {
  Random random(1);
  for (int i = 0; i < 300000; ++i) {
    const Box frame = random_frame(random), box = box_within(frame, random);
    ASSERT_TRUE(decode(encode(box, frame), frame).contains(box)) << i;
  }
}

TEST(QuantizedBox, IsLessThanACellLarger) {
  Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const Box frame = random_frame(random), box = box_within(frame, random);
    const Box decoded = decode(encode(box, frame), frame);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double step = static_cast<double>(grid_step(frame.lower[axis], frame.upper[axis]));
      const double rounding = 0x1p-23 * std::max(std::fabs(frame.lower[axis]), std::fabs(frame.upper[axis])) + 1e-44;
      EXPECT_LT(static_cast<double>(box.lower[axis]) - static_cast<double>(decoded.lower[axis]), step + rounding) << i;
      EXPECT_LT(static_cast<double>(decoded.upper[axis]) - static_cast<double>(box.upper[axis]), step + rounding) << i;
    }
  }
}

TEST(QuantizedBox, OfTheFrameItself_IsTheWholeGrid) {
  const Box frame{{-1, 2, 3}, {5, 8, 1000}};
  const QuantizedBox key = encode(frame, frame);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(key.lower[axis], 0);
    EXPECT_GE(key.upper[axis], 254);
  }
  EXPECT_EQ(decode(key, frame).lower, frame.lower);
}

const std::vector<std::string> texts = {"quantized",
                                        "quantized(frame=parent)",
                                        "quantized(chunk=128)",
                                        "quantized(frame=parent, chunk=128)",
                                        "quantized(form=pointers, frame=parent)",
                                        "quantized(4)",
                                        "quantized(8, frame=parent)",
                                        "quantized(8, chunk=128)",
                                        "quantized(form=free)",
                                        "quantized(4, form=free, chunk=128)",
                                        "quantized(form=free, fill=packed)",
                                        "quantized(form=milestones)",
                                        "quantized(8, form=milestones)"};

test::LayoutCall layout_call(const std::string& text) {
  const CallText parts = parse_call_text(text);
  test::LayoutCall call(quantized_stage());
  for (const std::string_view argument : parts.arguments) {
    set_option(call.stage.name, call.stage.options, call.options, argument);
  }
  return call;
}

class Quantized : public testing::TestWithParam<std::string> {};

TEST_P(Quantized, GivesTheAnswersOfBruteForceHoweverItIsWalked) {
  const test::LayoutCall call = layout_call(GetParam());
  std::size_t seed = 0;
  for (const test::NamedScene& named : test::troubled_scenes()) {
    const test::Expected expected(named.scene, test::troubling_rays(named.scene, 300, ++seed));
    for (const ChildOrder order : {ChildOrder::none, ChildOrder::axis, ChildOrder::near}) {
      for (const bool cull : {true, false}) {
        for (const TraversalMode mode : {TraversalMode::iterative, TraversalMode::recursive}) {
          test::expect_brute_force_answers(*test::encode_scene(named.scene, call, {order, cull, mode}), expected,
                                           GetParam() + " over " + named.name);
        }
      }
    }
  }
}

TEST_P(Quantized, ClosedMesh_IsNeverLeftFromInside) {
  const test::LayoutCall call = layout_call(GetParam());
  for (const Scene& scene : {test::sphere(12), test::transformed(test::sphere(8), 1, {1000, -2000, 3000})}) {
    const auto layout = test::encode_scene(scene, call, {});
    const Mesh& mesh = scene.meshes[0];
    Random random(3);
    for (int i = 0; i < 3000; ++i) {
      const Triangle& triangle = mesh.triangles[random.below(static_cast<std::uint32_t>(mesh.triangles.size()))];
      const Vec3 a = mesh.positions[triangle[0]], b = mesh.positions[triangle[1]];
      const Vec3 origin = scene.bounds().center() + test::random_point(random, 0.3f);
      const Ray ray{origin, 0, test::jitter(a + (b - a) * random.uniform(), random) - origin};
      ASSERT_TRUE(layout->closest_hit(ray).valid()) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Each, Quantized, testing::ValuesIn(texts), [](const auto& test) {
  std::string name;
  for (const char c : test.param) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
});

TEST(Quantized, LooserFramesCostMoreTests) {
  const Scene scene = test::soup(4000, 0.05f, 7);
  const std::vector<Ray> rays = test::troubling_rays(scene, 600, 1);
  const auto cost = [&](const test::LayoutCall& call) {
    return test::total_cost(*test::encode_scene(scene, call, {.order = ChildOrder::axis}, 2, false), rays);
  };
  const RayCounters exact = cost(test::LayoutCall(binary_stage())),
                    parent = cost(layout_call("quantized(frame=parent)")), chunk = cost(layout_call("quantized"));
  EXPECT_LE(exact.primitive_tests, parent.primitive_tests);
  EXPECT_LE(parent.primitive_tests, chunk.primitive_tests);
  EXPECT_LE(exact.node_tests, parent.node_tests);
  EXPECT_LT(static_cast<double>(chunk.primitive_tests), 1.5 * exact.primitive_tests);
}

double fact(const Layout& layout, const std::string& name) {
  for (const LayoutFact& f : layout.facts()) {
    if (f.name == name) return f.figure();
  }
  ADD_FAILURE() << "no fact " << name;
  return 0;
}

TEST(Quantized, ReportsTheBytesOfTheFormulas) {
  const Scene scene = test::soup(1000, 0.1f, 4);
  const double nodes = 1999;
  for (const char* chunk : {"64", "128"}) {
    test::LayoutCall call(quantized_stage());
    const auto layout = test::encode_scene(scene, call.set("chunk", chunk), {}, 1);
    EXPECT_EQ(fact(*layout, "topology_bytes"), fact(*layout, "chunks") * std::stod(chunk) + 7 * (nodes - 1));
    const double room = (std::stod(chunk) - 40) * 8;
    EXPECT_DOUBLE_EQ(fact(*layout, "chunk_fill"), (nodes - 1) / (fact(*layout, "chunks") * room));
  }
  const auto pointers = test::encode_scene(scene, layout_call("quantized(form=pointers, frame=parent)"), {}, 1);
  EXPECT_EQ(fact(*pointers, "topology_bytes"), 16 * nodes + 24);
  EXPECT_EQ(fact(*test::encode_scene(scene, test::LayoutCall(binary_stage()), {}, 1), "topology_bytes"), 32 * nodes);
}

/// Boxes at every node, decoded on the way down, hold the exact ones, and the tree is the same.
template <class Tester>
void expect_holds(const Tester& tester, const typename Tester::Slot& slot, const Link& link, const Tree& tree,
                  std::uint32_t node) {
  ASSERT_EQ(link.leaf != 0, tree.nodes[node].is_leaf());
  if (link.leaf) {
    ASSERT_EQ(std::uint32_t{link.count}, std::uint32_t{tree.nodes[node].count});
    return;
  }
  for (std::uint32_t c = 0; c < tree.nodes[node].count; ++c) {
    const typename Tester::Slot child = tester.slot_of(slot, link, c);
    ASSERT_TRUE(child.box().contains(tree.nodes[tree.nodes[node].first + c].bounds));
    expect_holds(tester, child, tester.link(child), tree, tree.nodes[node].first + c);
  }
}

TEST(Quantized, DecodedBoxesHoldTheExactOnesAtEveryNode) {
  const HWY_NAMESPACE::PreparedRay no_ray = HWY_NAMESPACE::prepare({{0, 0, 0}, 0, {0, 0, 1}}, 1);
  for (const float scale : {1e-6f, 1.0f, 1e9f}) {
    const Scene scene = test::soup(3000, 0.05f, 5, scale, {scale * 100, 0, 0});
    for (const std::uint32_t k : {2u, 4u, 8u}) {
      Tree tree = test::split_tree(test::triangle_boxes(scene.meshes[0]), {k, 1, true});
      const Tree exact = tree;
      const QuantizedArity arity = k == 2 ? QuantizedArity::k2 : k == 4 ? QuantizedArity::k4 : QuantizedArity::k8;
      const QuantizedChunks chunks = encode_quantized_chunks(tree, {.k = arity, .frame = QuantizedFrame::parent});
      const HWY_NAMESPACE::ParentFrameTester tester(chunks, no_ray);
      expect_holds(tester, tester.root_slot(), tester.root_link(), exact, 0);
    }
    const Tree tree = test::split_tree(test::triangle_boxes(scene.meshes[0]), {2, 1, true});
    const QuantizedPointers pointers = encode_quantized_pointers(tree);
    const HWY_NAMESPACE::PointerTester tester(pointers, no_ray);
    expect_holds(tester, tester.root_slot(), tester.root_link(), tree, 0);
  }
}

TEST(Quantized, OptionsThatDoNotGoTogether_AreRefused) {
  const Scene scene = test::soup(20, 0.1f, 4);
  for (const char* text : {"quantized(form=pointers)", "quantized(4, form=pointers, frame=parent)",
                           "quantized(form=pointers, frame=parent, chunk=128)", "quantized(fill=packed)",
                           "quantized(form=free, frame=parent)", "quantized(form=milestones, chunk=128)"}) {
    EXPECT_THROW(test::encode_scene(scene, layout_call(text), {}), UsageError) << text;
  }
}

}  // namespace
}  // namespace boxwood
