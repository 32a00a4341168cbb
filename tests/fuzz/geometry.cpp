// Any floats as triangles and rays, on any of a few recipes, against testing every triangle.
#include <cstring>

#include "boxwood/recipe.h"
#include "boxwood/scene.h"
#include "fuzz/support.h"
#include "soak/soak.h"

namespace boxwood::fuzz {
namespace {

/// Every layout and every kind of builder once.
constexpr const char* recipes[] = {
    "median > binary",
    "binned > wide(4)",
    "default",
    "best",
    "compact",
    "sweep > slab",
    "middle(plane=box) > slab(packet=8)",
    "sweep > binary-split(packet=4)",
    "binned > wide-slab(8, planes=4)",
    "middle > bih",
    "octree(primitives=2) > octree",
    "octree(primitives=2) > bit-octree(form=milestones)",
    "octree(primitives=2) > bit-octree(chunk=16)",
    "binned > quantized(form=milestones)",
    "binned > quantized(form=free, fill=packed)",
    "binned > quantized(form=pointers, frame=parent)",
    "sweep > oriented",
    "sweep > oriented(4, area=100)",
    "pca > wide(8) > trace(simd=off)",
    "hlbvh > rotate > wide(4)",
    "spatial(alpha=0, budget=4) > wide(16)",
    "exhaustive(most=6) > order(by=sato) > binary",
    "distance > binary > trace(order=none, cull=off, mode=recursive)",
    "binned(cost=interior-hq) > compressed(16)",
};
constexpr std::size_t most_triangles = 64, most_rays = 64;

class FloatReader {
 public:
  explicit FloatReader(Bytes bytes) : bytes_(bytes) {}
  bool has(std::size_t floats) const { return bytes_.size() >= 4 * floats; }
  float next() {
    float value = 0;
    std::memcpy(&value, bytes_.data(), 4);
    bytes_ = bytes_.subspan(4);
    return value;
  }
  Vec3 vector() {
    const float x = next(), y = next(), z = next();
    return {x, y, z};
  }

 private:
  Bytes bytes_;
};

}  // namespace

void trace_geometry(Bytes bytes) {
  if (bytes.size() < 2) return;
  const char* recipe = recipes[bytes[0] % std::size(recipes)];
  FloatReader in(bytes.subspan(2));
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  for (std::size_t left = bytes[1] % most_triangles; left > 0 && in.has(9); --left) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (int corner = 0; corner < 3; ++corner) positions.push_back(in.vector());
    triangles.push_back({first, first + 1, first + 2});
  }
  std::vector<Ray> rays;
  while (in.has(8) && rays.size() < most_rays) {
    Ray ray;
    ray.origin = in.vector();
    ray.t_near = in.next();
    ray.direction = in.vector();
    ray.t_far = in.next();
    rays.push_back(ray);
  }
  if (rays.empty()) return;
  Scene scene;
  scene.add_mesh(std::move(positions), std::move(triangles));
  accept_or_refuse([&] {
    std::string refused;
    const std::string what = find_disagreement(scene, Recipe::parse(recipe), rays, refused);
    require(what.empty(), what);
  });
}

}  // namespace boxwood::fuzz
