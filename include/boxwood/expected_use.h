#pragma once
#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "boxwood/query.h"
#include "boxwood/ray.h"
#include "boxwood/scene.h"

namespace boxwood {

/// Rays of one kind that stand for the many like them that will be traced.
struct ExpectedRays {
  std::string kind;  ///< as RaySet::kind
  Query query = Query::closest_hit;
  std::vector<Ray> rays;
  std::vector<float> ends;  ///< [i]: the t at which ray i ends: its closest hit, or else its t_far
};

/// A triangle that some ray ends on.
struct SeenTriangle {
  std::uint32_t instance = 0, primitive = 0;
  friend constexpr auto operator<=>(const SeenTriangle&, const SeenTriangle&) = default;  // NOLINT(*-nullptr)
};

/// A camera with the shape of its picture.
struct View {
  Camera camera;
  std::uint32_t width = 512, height = 512;
};

/// What a structure will be used for, for recipes that adapt to it (cost=rdh, osah, perspective, order(by=srdh), …).
/// In world space. Made by expect_use() of boxwood/ray_set.h, or by hand.
struct ExpectedUse {
  std::vector<ExpectedRays> rays;
  std::vector<SeenTriangle> seen;  ///< ascending, each once
  std::vector<View> views;
};

}  // namespace boxwood
