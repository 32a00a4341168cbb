#include "scene/generators/shapes.h"

#include <unordered_map>

#include "math/sampling.h"
#include "scene/generators/generator.h"

namespace boxwood {
namespace {

void append_quad(Mesh& to, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  to.triangles.push_back({a, b, c});
  to.triangles.push_back({a, c, d});
}

/// Numbers the lattice points on a cube's surface in the order of their first use.
class CubeLattice {
 public:
  explicit CubeLattice(std::uint32_t detail) : detail_(detail) {}

  std::uint32_t vertex(const std::uint32_t (&at)[3], Mesh& mesh) {
    const std::uint64_t side = std::uint64_t{detail_} + 1;
    const auto [found, is_new] =
        numbers_.try_emplace((at[2] * side + at[1]) * side + at[0], static_cast<std::uint32_t>(mesh.positions.size()));
    if (is_new) {
      const auto map = [&](std::uint32_t i) { return static_cast<float>(2 * static_cast<double>(i) / detail_ - 1); };
      mesh.positions.push_back({map(at[0]), map(at[1]), map(at[2])});
    }
    return found->second;
  }

 private:
  std::uint32_t detail_;
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;
};

/// A closed tube around a closed curve; `point(turns along, turns around)` lies on it, counter-clockwise around the
/// curve's direction.
template <class Point>
Mesh tube_mesh(std::uint32_t along, std::uint32_t around, const Point& point) {
  check_size(std::uint64_t{2} * along * around);
  Mesh mesh;
  for (std::uint32_t i = 0; i < along; ++i) {
    for (std::uint32_t j = 0; j < around; ++j) {
      mesh.positions.push_back(point(static_cast<double>(i) / along, static_cast<double>(j) / around));
      const std::uint32_t next_i = (i + 1) % along, next_j = (j + 1) % around;
      append_quad(mesh, i * around + j, i * around + next_j, next_i * around + next_j, next_i * around + j);
    }
  }
  return mesh;
}

}  // namespace

Mesh cube_mesh(std::uint32_t detail) {
  check_size(std::uint64_t{12} * detail * detail);
  Mesh mesh;
  CubeLattice lattice(detail);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool upper : {false, true}) {
      for (std::uint32_t j = 0; j < detail; ++j) {
        for (std::uint32_t i = 0; i < detail; ++i) {
          const auto corner = [&](std::uint32_t du, std::uint32_t dv) {
            std::uint32_t at[3];
            at[axis] = upper ? detail : 0;
            at[u] = i + du;
            at[v] = j + dv;
            return lattice.vertex(at, mesh);
          };
          const std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          upper ? append_quad(mesh, a, b, c, d) : append_quad(mesh, a, d, c, b);
        }
      }
    }
  }
  return mesh;
}

Mesh sphere_mesh(std::uint32_t detail) {
  Mesh mesh = cube_mesh(detail);
  for (Vec3& position : mesh.positions) position = normalize(position);
  return mesh;
}

Mesh torus_mesh(std::uint32_t detail) {
  constexpr double tube = 0.35;
  return tube_mesh(2 * detail, detail, [&](double along, double around) {
    const SineCosine ring = sine_cosine_of_turns(along), circle = sine_cosine_of_turns(around);
    const double radius = 1 + tube * circle.cosine;
    return Vec3{static_cast<float>(radius * ring.sine), static_cast<float>(-tube * circle.sine),
                static_cast<float>(radius * ring.cosine)};
  });
}

Mesh knot_mesh(std::uint32_t detail) {
  // The curve winds twice around the y axis and three times around a torus, whose normal gives a frame that closes.
  constexpr double ring_radius = 0.7, winding_radius = 0.3, tube = 0.11;
  const auto curve = [&](double along, Vec3* normal) {
    const SineCosine ring = sine_cosine_of_turns(2 * along), winding = sine_cosine_of_turns(3 * along);
    const double radius = ring_radius + winding_radius * winding.cosine;
    if (normal) {
      *normal = {static_cast<float>(winding.cosine * ring.sine), static_cast<float>(winding.sine),
                 static_cast<float>(winding.cosine * ring.cosine)};
    }
    return Vec3{static_cast<float>(radius * ring.sine), static_cast<float>(winding_radius * winding.sine),
                static_cast<float>(radius * ring.cosine)};
  };
  return tube_mesh(8 * detail, detail, [&](double along, double around) {
    constexpr double step = 1e-3;
    Vec3 normal;
    const Vec3 center = curve(along, &normal);
    const Vec3 tangent = normalize(curve(along + step, nullptr) - curve(along - step, nullptr));
    normal = normalize(normal - tangent * dot(normal, tangent));
    const SineCosine circle = sine_cosine_of_turns(around);
    return center +
           (normal * static_cast<float>(circle.cosine) + cross(tangent, normal) * static_cast<float>(circle.sine)) *
               static_cast<float>(tube);
  });
}

Vec3 uniform_point(Random& random, float low, float high) {
  const float x = random.uniform(low, high), y = random.uniform(low, high), z = random.uniform(low, high);
  return {x, y, z};
}

void append(Mesh& to, const Mesh& mesh, float scale, const Vec3& move) {
  const auto first = static_cast<std::uint32_t>(to.positions.size());
  for (const Vec3& position : mesh.positions) to.positions.push_back(position * scale + move);
  for (const Triangle& t : mesh.triangles) to.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

void append_triangle(Mesh& to, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto first = static_cast<std::uint32_t>(to.positions.size());
  to.positions.insert(to.positions.end(), {a, b, c});
  to.triangles.push_back({first, first + 1, first + 2});
}

void append_box(Mesh& to, const Box& box) {
  const auto first = static_cast<std::uint32_t>(to.positions.size());
  for (int corner = 0; corner < 8; ++corner) {
    to.positions.push_back({(corner & 1) ? box.upper.x : box.lower.x, (corner & 2) ? box.upper.y : box.lower.y,
                            (corner & 4) ? box.upper.z : box.lower.z});
  }
  constexpr std::uint32_t sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& [a, b, c, d] : sides) append_quad(to, first + a, first + b, first + c, first + d);
}

}  // namespace boxwood
