// What builders are tried on, and how their stages are called by name.
#pragma once
#include <limits>
#include <string>
#include <vector>

#include "boxwood/error.h"
#include "build/build_input.h"
#include "build/stages.h"
#include "math/random.h"
#include "options/call.h"

namespace boxwood {

struct NamedBoxes {
  std::string name;
  std::vector<Box> boxes;  ///< by primitive; an empty box stands for an unusable one
};

inline Vec3 random_point(Random& random) {
  const float x = random.uniform(), y = random.uniform(), z = random.uniform();
  return {x, y, z};
}

/// Boxes of up to `size` with their lower corners in the unit cube.
inline std::vector<Box> random_boxes(std::size_t count, float size = 0.05f, std::uint64_t seed = 1) {
  Random random(seed);
  std::vector<Box> boxes(count);
  for (Box& box : boxes) {
    box.lower = random_point(random);
    box.upper = box.lower + random_point(random) * size;
  }
  return boxes;
}

inline std::vector<NamedBoxes> named_boxes() {
  std::vector<NamedBoxes> all;
  all.push_back({"none", {}});
  all.push_back({"one", random_boxes(1)});
  all.push_back({"two", random_boxes(2)});
  all.push_back({"random", random_boxes(1500)});
  all.push_back({"large", random_boxes(300, 1)});
  all.push_back({"coincident", std::vector<Box>(333, Box{{1, 2, 3}, {2, 3, 4}})});
  all.push_back({"points", std::vector<Box>(100, Box{{1, 2, 3}, {1, 2, 3}})});

  all.push_back({"coplanar", random_boxes(500)});
  for (Box& box : all.back().boxes) box.lower.z = box.upper.z = -0.0f;
  all.push_back({"collinear", random_boxes(500)});
  for (Box& box : all.back().boxes) box.lower.x = box.upper.x = box.lower.z = box.upper.z = 3;

  // Same centre, different sizes: nothing to order by.
  all.push_back({"concentric", random_boxes(200)});
  for (Box& box : all.back().boxes) box.lower = -box.upper;

  // Ever smaller towards one corner: splits in the middle peel off one box at a time.
  all.push_back({"clustered", random_boxes(400, 0.1f)});
  float scale = 1e10f;
  for (Box& box : all.back().boxes) {
    box = {box.lower * scale, box.upper * scale};
    scale *= 0.8f;
  }

  all.push_back({"unusable", random_boxes(300)});
  for (std::size_t i = 0; i < 300; i += 3) all.back().boxes[i] = Box{};
  return all;
}

inline BuildInput input_of(const std::vector<Box>& boxes, const Geometry* geometry = nullptr) {
  BuildInput input;
  input.geometry = geometry;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (!boxes[i].empty()) input.references.push_back({boxes[i].lower, i, boxes[i].upper});
  }
  return input;
}

/// Rays to and fro through the boxes, every third primitive seen, a camera among them and one outside.
inline KnownUse use_of(const std::vector<Box>& boxes) {
  KnownUse use;
  Box all;
  for (const Box& box : boxes) all.grow(box);
  use.seen.resize(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); i += 3) use.seen[i] = 1;
  if (all.empty()) return use;
  Random random(99);
  ExpectedRays rays{"primary", Query::closest_hit, {}, {}};
  for (int i = 0; i < 300; ++i) {
    Ray ray;
    ray.origin = all.lower + all.extent() * random_point(random);
    ray.direction = all.extent() * (random_point(random) - Vec3{0.5f, 0.5f, 0.5f});
    rays.rays.push_back(ray);
    rays.ends.push_back(i % 4 == 0 ? std::numeric_limits<float>::infinity() : random.uniform());
  }
  use.rays.push_back(std::move(rays));
  const float size = length(all.extent());
  for (const float away : {0.0f, 2.0f}) {
    use.windows.push_back({all.center() - Vec3{0, 0, away * size}, {0.1f, 0, 1}, {0.5f, 0, 0}, {0, 0.5f, 0}});
  }
  return use;
}

/// Geometry whose centroids are not the boxes' centres.
class LopsidedGeometry final : public Geometry {
 public:
  explicit LopsidedGeometry(const std::vector<Box>& boxes) : boxes_(boxes) {}
  Vec3 centroid(std::uint32_t primitive) const override {
    const Box& box = boxes_[primitive];
    return box.lower * 0.75f + box.upper * 0.25f;
  }
  Box clip(std::uint32_t primitive, const Box& region) const override { return intersect(boxes_[primitive], region); }

 private:
  const std::vector<Box>& boxes_;
};

/// A stage and its options from a text such as "sweep(k=4)".
inline StageCall stage_call(const std::vector<Stage>& stages, const std::string& text) {
  const CallText call = parse_call_text(text);
  for (const Stage& stage : stages) {
    if (stage.name != call.name) continue;
    StageCall result{&stage, stage.defaults};
    set_options(stage.options, result.options, call);
    return result;
  }
  throw UsageError("no stage '" + text + "'");
}

inline const std::vector<Stage>& builder_stages() {
  static const std::vector<Stage> all = {median_stage(), middle_stage(), equal_stage(), sweep_stage(), binned_stage()};
  return all;
}

inline Tree build_tree(const std::string& text, const std::vector<Box>& boxes) {
  const LopsidedGeometry geometry(boxes);
  const StageCall call = stage_call(builder_stages(), text);
  const KnownUse use = use_of(boxes);
  BuildInput input = input_of(boxes, &geometry);
  input.use = &use;
  return call.stage->build(call.options, std::move(input));
}

}  // namespace boxwood
