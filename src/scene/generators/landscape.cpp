// Out of doors: a fractal terrain, a lawn, hair.
#include <tbb/parallel_for.h>

#include <algorithm>

#include "math/random.h"
#include "math/sampling.h"
#include "scene/generators/generator.h"
#include "scene/generators/shapes.h"

namespace boxwood {
namespace {

/// Value noise in [-1, 1]: random values on the integer grid, smoothly joined.
double noise(double x, double y, std::uint64_t seed) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto ix = static_cast<std::int64_t>(fx), iy = static_cast<std::int64_t>(fy);
  const auto value = [&](std::int64_t i, std::int64_t j) {
    const std::uint64_t cell = (static_cast<std::uint64_t>(i) << 32) ^ (static_cast<std::uint64_t>(j) & 0xffffffffu);
    return static_cast<double>(mix_bits(mix_bits(seed) ^ cell) >> 40) * 0x1p-23 - 1;
  };
  const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
  const auto mix = [](double a, double b, double t) { return a + (b - a) * t; };
  const double u = smooth(x - fx), v = smooth(y - fy);
  return mix(mix(value(ix, iy), value(ix + 1, iy), u), mix(value(ix, iy + 1), value(ix + 1, iy + 1), u), v);
}

struct Terrain {
  std::uint32_t size = 256;
  float height = 0.3f;
  std::uint32_t seed = 1;
};

Mesh terrain_mesh(const Terrain& o) {
  const std::uint32_t side = o.size + 1;
  Mesh mesh;
  mesh.positions.resize(std::size_t{side} * side);
  mesh.triangles.resize(std::size_t{2} * o.size * o.size);
  tbb::parallel_for(std::uint32_t{0}, side, [&](std::uint32_t j) {
    for (std::uint32_t i = 0; i < side; ++i) {
      const double x = static_cast<double>(i) / o.size, z = static_cast<double>(j) / o.size;
      double y = 0, amplitude = 0.5, frequency = 4;
      for (std::uint64_t octave = 0; octave < 10; ++octave, amplitude *= 0.5, frequency *= 2) {
        y += amplitude * noise(x * frequency, z * frequency, o.seed + (octave << 32));
      }
      mesh.positions[std::size_t{j} * side + i] = {static_cast<float>(x), static_cast<float>(y) * o.height,
                                                   static_cast<float>(z)};
      if (i == o.size || j == o.size) continue;
      const std::uint32_t a = j * side + i;
      const std::size_t cell = std::size_t{j} * o.size + i;
      mesh.triangles[2 * cell] = {a, a + side, a + side + 1};
      mesh.triangles[2 * cell + 1] = {a, a + side + 1, a + 1};
    }
  });
  return mesh;
}

/// A narrow band of two triangles per piece along a bent line, which starts at `root` along `direction`.
struct Ribbon {
  Vec3 root, direction, bend, side;
  float length, half_width;
  bool pointed;
};

void append_ribbon(Mesh& to, const Ribbon& ribbon, std::uint32_t pieces) {
  const auto first = static_cast<std::uint32_t>(to.positions.size());
  for (std::uint32_t i = 0; i <= pieces; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(pieces);
    const Vec3 center = ribbon.root + (ribbon.direction * t + ribbon.bend * (t * t)) * ribbon.length;
    if (ribbon.pointed && i == pieces) {
      to.positions.push_back(center);
      to.triangles.push_back({first + 2 * i - 2, first + 2 * i - 1, first + 2 * i});
      return;
    }
    const Vec3 half = ribbon.side * (ribbon.half_width * (ribbon.pointed ? 1 - t : 1));
    to.positions.push_back(center - half);
    to.positions.push_back(center + half);
    if (i == 0) continue;
    const std::uint32_t a = first + 2 * i - 2;
    to.triangles.push_back({a, a + 1, a + 3});
    to.triangles.push_back({a, a + 3, a + 2});
  }
}

struct Hair {
  std::uint32_t strands = 2'000;
  std::uint32_t pieces = 8;
  float width = 0.002f;
  std::uint32_t seed = 1;
};

/// Strands on a ball, drawn down by their weight.
Mesh hair_mesh(const Hair& o) {
  check_size(std::uint64_t{2} * o.strands * o.pieces);
  Mesh mesh;
  for (std::uint32_t i = 0; i < o.strands; ++i) {
    Random random(o.seed, i);
    const float u = random.uniform(), v = random.uniform();
    const Vec3 root = uniform_sphere(u, v);
    const Basis basis(root);
    const float turn = random.uniform(), lean = random.uniform();
    const Vec3 direction = normalize(root + basis.around_normal(uniform_sphere(lean, turn)) * 0.4f);
    append_ribbon(mesh,
                  {.root = root,
                   .direction = direction,
                   .bend = {0, random.uniform(-0.8f, -0.3f), 0},
                   .side = normalize(cross(direction, basis.x)),
                   .length = random.uniform(0.6f, 1.2f),
                   .half_width = o.width * 0.5f,
                   .pointed = false},
                  o.pieces);
  }
  return mesh;
}

struct Lawn {
  std::uint32_t blades = 20'000;
  std::uint32_t seed = 1;
};

/// Pointed blades of seven triangles on a square of two.
Mesh lawn_mesh(const Lawn& o) {
  constexpr std::uint32_t pieces = 4;
  const float side = std::sqrt(static_cast<float>(std::max(o.blades, 1u))) * 0.02f;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, side}, {side, 0, side}, {side, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (std::uint32_t i = 0; i < o.blades; ++i) {
    Random random(o.seed, i);
    const float x = random.uniform() * side, z = random.uniform() * side;
    const SineCosine facing = sine_cosine_of_turns(static_cast<double>(random.uniform()));
    const auto sine = static_cast<float>(facing.sine), cosine = static_cast<float>(facing.cosine);
    append_ribbon(mesh,
                  {.root = {x, 0, z},
                   .direction = {0, 1, 0},
                   .bend = Vec3{-sine, -0.3f, cosine} * random.uniform(0.1f, 0.6f),
                   .side = {cosine, 0, sine},
                   .length = random.uniform(0.08f, 0.2f),
                   .half_width = 0.004f,
                   .pointed = true},
                  pieces);
  }
  return mesh;
}

}  // namespace

Generator terrain_generator() {
  return mesh_generator("terrain", "a fractal height field on the unit square",
                        OptionsOf<Terrain>()
                            .integer("size", &Terrain::size, 1, 10'000, "cells along each side; 2 * size^2 triangles")
                            .positional()
                            .real("height", &Terrain::height, 0, 10, "of the highest peak")
                            .integer("seed", &Terrain::seed, 0, 0xffffffffu, "another one, another scene"),
                        terrain_mesh);
}

Generator hair_generator() {
  return mesh_generator("hair", "long thin triangles: strands on a ball",
                        OptionsOf<Hair>()
                            .integer("strands", &Hair::strands, 0, 10'000'000, "how many")
                            .positional()
                            .integer("pieces", &Hair::pieces, 1, 1'000, "per strand, two triangles each")
                            .real("width", &Hair::width, 0, 1, "of a strand; the ball has radius 1")
                            .integer("seed", &Hair::seed, 0, 0xffffffffu, "another one, another scene"),
                        hair_mesh);
}

Generator lawn_generator() {
  return mesh_generator("lawn", "blades of grass on a square of ground",
                        OptionsOf<Lawn>()
                            .integer("blades", &Lawn::blades, 0, 20'000'000, "seven triangles each")
                            .positional()
                            .integer("seed", &Lawn::seed, 0, 0xffffffffu, "another one, another scene"),
                        lawn_mesh);
}

}  // namespace boxwood
