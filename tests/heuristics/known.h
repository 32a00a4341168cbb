// Rays, boxes and builders for tests of what adapts to rays.
#pragma once
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "build/stages.h"
#include "cost/registry.h"
#include "math/random.h"
#include "math/sampling.h"
#include "options/call.h"
#include "tree/tree.h"

namespace boxwood::test {

inline Vec3 point_in(Random& random, const Box& box) {
  const float x = random.uniform(), y = random.uniform(), z = random.uniform();
  return box.lower + box.extent() * Vec3{x, y, z};
}

/// Boxes of up to `size` in the unit cube.
inline std::vector<Box> small_boxes(std::size_t count, float size, std::uint64_t seed) {
  Random random(seed);
  std::vector<Box> boxes(count);
  for (Box& box : boxes) {
    box.lower = point_in(random, {{0, 0, 0}, {1 - size, 1 - size, 1 - size}});
    box.upper = box.lower + point_in(random, {{0, 0, 0}, {size, size, size}});
  }
  return boxes;
}

/// Rays that start in `from` and go anywhere, each for some way.
inline ExpectedRays scattered_rays(std::size_t count, const Box& from, std::uint64_t seed) {
  Random random(seed);
  ExpectedRays rays{"diffuse1", Query::closest_hit, {}, {}};
  for (std::size_t i = 0; i < count; ++i) {
    Ray ray;
    ray.origin = point_in(random, from);
    ray.direction = uniform_sphere(random.uniform(), random.uniform());
    rays.rays.push_back(ray);
    rays.ends.push_back(random.uniform());
  }
  return rays;
}

inline BuildInput input_of(const std::vector<Box>& boxes, const KnownUse* use = nullptr) {
  BuildInput input;
  input.use = use;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) input.references.push_back({boxes[i].lower, i, boxes[i].upper});
  return input;
}

/// The tree of a builder such as "binned(cost=rdh)".
inline Tree tree_by(const std::string& text, BuildInput input) {
  const CallText call = parse_call_text(text);
  const Stage stage = call.name == "sweep" ? sweep_stage() : binned_stage();
  std::any options = stage.defaults;
  set_options(stage.options, options, call);
  return stage.build(options, std::move(input));
}

inline bool same_tree(const Tree& a, const Tree& b) {
  if (a.references != b.references || a.nodes.size() != b.nodes.size()) return false;
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    const Tree::Node &x = a.nodes[i], &y = b.nodes[i];
    if (x.bounds != y.bounds || x.first != y.first || x.count != y.count || x.leaf != y.leaf) return false;
  }
  return true;
}

/// What a model says of one side.
inline float probability(const CostModel& model, const Box& parent, const Side& side, std::uint32_t count = 0,
                         std::uint32_t seen = 0) {
  float out = -1;
  const auto memory = model.enter(parent, nullptr);
  model.probabilities({parent, count, seen, memory.get()}, {&side, 1}, {&out, 1});
  return out;
}

}  // namespace boxwood::test
