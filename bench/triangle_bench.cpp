// What the watertight leaf test costs over Möller and Trumbore's (1997): the same blocks of four triangles, all in the
// first-level cache, the same rays, in turn. Prints CPU nanoseconds per block and the ratio.
#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <vector>

#include "layout/simd/targets.h"
#include "layout/simd/wide_node.h"
#include "measure/clock.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "triangle_bench.cpp"
#include <hwy/foreach_target.h>

#include "layout/simd/triangles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

using D = Floats<4>;

std::uint32_t watertight(const LeafBlock<4>& block, const TriangleRay& ray, const Ray&) {
  const D d;
  const auto vertex = [&](int v) { return load_vertices(d, block, v, 0, ray.axes); };
  const Vertices<D> triangle[3] = {vertex(0), vertex(1), vertex(2)};
  const TriangleHits<D> hits = hit_triangles(d, triangle, broadcast_sheared(d, ray));
  return bits_of(d, hn::And(hits.hit, hn::Ge(hits.t, hn::Zero(d))));
}

std::uint32_t moeller_trumbore(const LeafBlock<4>& block, const TriangleRay&, const Ray& ray) {
  const D d;
  using V = hn::Vec<D>;
  struct Vector {
    V x, y, z;
  };
  const auto load = [&](int v) {
    return Vector{hn::Load(d, block.vertices[v][0]), hn::Load(d, block.vertices[v][1]),
                  hn::Load(d, block.vertices[v][2])};
  };
  const auto set = [&](const Vec3& v) { return Vector{hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)}; };
  const auto minus = [](const Vector& a, const Vector& b) {
    return Vector{hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
  };
  const auto cross = [](const Vector& a, const Vector& b) {
    return Vector{hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
                  hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
  };
  const auto dot = [](const Vector& a, const Vector& b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
  };
  const Vector a = load(0), edge1 = minus(load(1), a), edge2 = minus(load(2), a), direction = set(ray.direction);
  const Vector p = cross(direction, edge2), s = minus(set(ray.origin), a), q = cross(s, edge1);
  const V inverse = hn::Div(hn::Set(d, 1.0f), dot(edge1, p));
  const V u = hn::Mul(dot(s, p), inverse), v = hn::Mul(dot(direction, q), inverse), t = hn::Mul(dot(edge2, q), inverse);
  const V zero = hn::Zero(d);
  const auto inside = hn::And(hn::And(hn::Ge(u, zero), hn::Ge(v, zero)), hn::Le(hn::Add(u, v), hn::Set(d, 1.0f)));
  return bits_of(d, hn::And(inside, hn::Ge(t, zero)));
}

template <auto test>
double seconds(const std::vector<LeafBlock<4>>& blocks, const std::vector<Ray>& rays, std::uint64_t& hits) {
  std::vector<TriangleRay> prepared;
  for (const Ray& ray : rays) prepared.push_back(triangle_ray(prepare(ray, 2)));
  const double begin = now(Clock::thread_cpu);
  for (int repeat = 0; repeat < 200; ++repeat) {
    for (std::size_t r = 0; r < rays.size(); ++r) {
      for (const LeafBlock<4>& block : blocks) hits += test(block, prepared[r], rays[r]);
    }
  }
  return now(Clock::thread_cpu) - begin;
}

void compare_tests(const std::vector<LeafBlock<4>>& blocks, const std::vector<Ray>& rays) {
  std::vector<double> ratios, ours, theirs;
  std::uint64_t hits = 0;
  for (int repeat = 0; repeat < 21; ++repeat) {
    theirs.push_back(seconds<moeller_trumbore>(blocks, rays, hits));
    ours.push_back(seconds<watertight>(blocks, rays, hits));
    ratios.push_back(ours.back() / theirs.back());
  }
  for (auto* values : {&ratios, &ours, &theirs}) std::ranges::sort(*values);
  const double tests = 200.0 * static_cast<double>(blocks.size() * rays.size());
  fmt::print(
      "four triangles: Moeller-Trumbore {:.2f} ns, watertight {:.2f} ns, ratio {:.2f} ({:.2f} to {:.2f}); hits {}\n",
      theirs[10] / tests * 1e9, ours[10] / tests * 1e9, ratios[10], ratios[5], ratios[15], hits);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {
HWY_EXPORT(compare_tests);
}

int main() {
  using namespace boxwood;
  std::mt19937 random(1);
  const auto number = [&] { return static_cast<float>(random() >> 8) * 0x1p-23f - 1; };
  std::vector<LeafBlock<4>> blocks(64);
  for (LeafBlock<4>& block : blocks) {
    for (auto& vertex : block.vertices) {
      for (auto& axis : vertex) std::ranges::generate(axis, number);
    }
  }
  std::vector<Ray> rays(64);
  for (Ray& ray : rays) {
    ray.origin = {number(), number(), number()};
    ray.direction = {number(), number(), number()};
  }
  HWY_DYNAMIC_DISPATCH(compare_tests)(blocks, rays);
}
#endif
