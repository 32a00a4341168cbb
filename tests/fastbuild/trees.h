// Triangles to build over, and trees from the text of a pipeline.
#pragma once
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "build/morton/stages.h"
#include "build/spatial/stages.h"
#include "build/stages.h"
#include "math/clip.h"
#include "math/random.h"
#include "options/call.h"
#include "refine/optimal_collapse/stages.h"
#include "refine/reinsert/stages.h"
#include "refine/stages.h"
#include "tree/statistics.h"
#include "tree/validate.h"

namespace boxwood {

using Corners = std::array<Vec3, 3>;

/// Triangles as a builder may ask about them.
class Triangles final : public Geometry {
 public:
  Triangles(std::string name, std::vector<Corners> triangles) : name_(std::move(name)), all_(std::move(triangles)) {}

  const std::string& name() const { return name_; }
  std::size_t size() const { return all_.size(); }
  Vec3 centroid(std::uint32_t i) const override { return (all_[i][0] + all_[i][1] + all_[i][2]) * (1.0f / 3); }
  Box clip(std::uint32_t i, const Box& region) const override {
    return clip_triangle(all_[i][0], all_[i][1], all_[i][2], region);
  }
  bool corners(std::uint32_t i, Vec3 (&out)[3]) const override {
    std::copy(all_[i].begin(), all_[i].end(), out);
    return true;
  }
  const Corners& operator[](std::size_t i) const { return all_[i]; }

  std::vector<Box> boxes() const {
    std::vector<Box> out(all_.size());
    for (std::size_t i = 0; i < all_.size(); ++i) {
      for (const Vec3& corner : all_[i]) out[i].grow(corner);
    }
    return out;
  }
  BuildInput input() const {
    BuildInput input{{}, this};
    const std::vector<Box> bounds = boxes();
    for (std::uint32_t i = 0; i < bounds.size(); ++i) {
      input.references.push_back({bounds[i].lower, i, bounds[i].upper});
    }
    return input;
  }

 private:
  std::string name_;
  std::vector<Corners> all_;
};

inline Vec3 point_in_cube(Random& random) {
  const float x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(-1, 1);
  return {x, y, z};
}

/// Triangles with corners at most `size` from a random point in the cube from -1 to 1.
inline std::vector<Corners> scattered(std::size_t count, float size, std::uint64_t seed = 1) {
  Random random(seed);
  std::vector<Corners> out(count);
  for (Corners& triangle : out) {
    const Vec3 center = point_in_cube(random);
    for (Vec3& corner : triangle) corner = center + point_in_cube(random) * size;
  }
  return out;
}

/// Thin triangles from one side of the cube to the other, at all angles.
inline std::vector<Corners> needles(std::size_t count, std::uint64_t seed = 2) {
  Random random(seed);
  std::vector<Corners> out(count);
  for (Corners& triangle : out) {
    triangle[0] = point_in_cube(random);
    triangle[1] = point_in_cube(random);
    triangle[2] = triangle[1] + point_in_cube(random) * 0.01f;
  }
  return out;
}

/// A bumpy surface: neighbours share edges, as in meshes.
inline std::vector<Corners> surface(std::uint32_t side) {
  const auto at = [&](std::uint32_t x, std::uint32_t y) {
    const float u = static_cast<float>(x) / static_cast<float>(side),
                v = static_cast<float>(y) / static_cast<float>(side);
    return Vec3{u, 0.1f * std::sin(13 * u) * std::cos(9 * v), v};
  };
  std::vector<Corners> out;
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      out.push_back({at(x, y), at(x + 1, y), at(x, y + 1)});
      out.push_back({at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return out;
}

/// Everything that has broken a builder somewhere.
inline std::vector<Triangles> troubling_triangles() {
  std::vector<Triangles> all;
  all.emplace_back("none", std::vector<Corners>{});
  for (const std::size_t count : {1u, 2u, 3u, 5u, 130u}) {
    all.emplace_back("scattered " + std::to_string(count), scattered(count, 0.1f));
  }
  all.emplace_back("scattered", scattered(3000, 0.05f));
  all.emplace_back("large", scattered(300, 1));
  all.emplace_back("needles", needles(800));
  all.emplace_back("surface", surface(40));
  all.emplace_back("coincident", std::vector<Corners>(700, scattered(1, 1).front()));
  std::vector<Corners> coplanar = scattered(1000, 0.2f), concentric = scattered(500, 1), shrinking = scattered(500, 1);
  for (Corners& triangle : coplanar) {
    for (Vec3& corner : triangle) corner.y = 0.25f;
  }
  float size = 1;
  for (Corners& triangle : concentric) {
    triangle = {Vec3{-size, -size, -size}, {size, size, size}, {size, -size, 0}};
    size *= 1.01f;
  }
  size = 1e11f;
  for (Corners& triangle : shrinking) {
    for (Vec3& corner : triangle) corner = corner * size;
    size *= 0.9f;
  }
  all.emplace_back("coplanar", std::move(coplanar));
  all.emplace_back("concentric", std::move(concentric));
  all.emplace_back("from huge to tiny", std::move(shrinking));
  return all;
}

inline const std::vector<Stage>& stages_here() {
  static const std::vector<Stage> all = {ploc_stage(),     spatial_stage(), reinsert_stage(), optimal_collapse_stage(),
                                         collapse_stage(), binned_stage(),  median_stage()};
  return all;
}

/// The tree of "builder(…) > refinement(…) > …".
inline Tree build_tree(const std::string& pipeline, const Triangles& triangles) {
  Tree tree;
  for (std::size_t begin = 0; begin < pipeline.size();) {
    const std::size_t end = std::min(pipeline.find('>', begin), pipeline.size());
    const CallText call = parse_call_text(trim(std::string_view(pipeline).substr(begin, end - begin)));
    for (const Stage& stage : stages_here()) {
      if (stage.name != call.name) continue;
      std::any options = stage.defaults;
      set_options(stage.options, options, call);
      tree = stage.build ? stage.build(options, triangles.input()) : stage.refine(options, std::move(tree));
    }
    begin = end + 1;
  }
  return tree;
}

inline Tree build_with_threads(const std::string& pipeline, const Triangles& triangles, int threads) {
  tbb::task_arena arena(threads);
  return arena.execute([&] { return build_tree(pipeline, triangles); });
}

}  // namespace boxwood
