#include "trace/judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "boxwood/error.h"
#include "trace/instance_error.h"

namespace boxwood {
namespace {

using Vec3d = std::array<double, 3>;

Vec3d widen(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3d subtract(const Vec3d& a, const Vec3d& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vec3d& a, const Vec3d& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec3d cross(const Vec3d& a, const Vec3d& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Vec3d& a) { return std::sqrt(dot(a, a)); }

Vec3d map(const Transform& t, const Vec3& p) {
  const Vec3d x = widen(t.x), y = widen(t.y), z = widen(t.z), offset = widen(t.translation), v = widen(p);
  Vec3d out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = x[i] * v[0] + y[i] * v[1] + z[i] * v[2] + offset[i];
  return out;
}

/// How a ray meets one triangle, with the uncertainty of a float test.
struct Meeting {
  enum Kind { none, possible, definite } kind = none;
  double t = 0;
  double t_error = 0;
};

/// Distance from the ray to the line of an edge, seen along the ray: positive inside. `doubled_area` is the edge's
/// barycentric numerator, signed to be positive inside.
double distance_to_edge(double doubled_area, const Vec3d& direction, const Vec3d& edge) {
  const double size = length(cross(direction, edge));
  // An edge seen end-on is a point; its neighbours decide.
  return size > 0 ? doubled_area / size : 0;
}

Meeting meet(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Ray& ray, double tolerance) {
  const Vec3d origin = widen(ray.origin), direction = widen(ray.direction);
  const Vec3d ab = subtract(b, a), ac = subtract(c, a), s = subtract(origin, a);
  const Vec3d p = cross(direction, ac), q = cross(s, ab);
  const double determinant = dot(ab, p);
  const double sign = determinant < 0 ? -1 : 1;
  const double v = sign * dot(s, p), w = sign * dot(direction, q), u = sign * determinant - v - w;

  const double inside = std::min({distance_to_edge(u, direction, subtract(c, b)), distance_to_edge(v, direction, ac),
                                  distance_to_edge(w, direction, ab)});
  if (inside < -tolerance) return {};
  Meeting meeting;
  const double size = length(direction);
  // The sine of the angle between ray and plane: a ray that grazes the plane may meet it anywhere along the triangle.
  const double normal = length(cross(ab, ac));
  const double slope = normal > 0 ? std::fabs(determinant) / (normal * size) : 0;
  const double reach = std::max(length(ab), length(ac)) + tolerance;
  meeting.t_error = (slope > 0 ? std::min(tolerance / slope, 2 * reach) + tolerance : 2 * reach + tolerance) / size;
  meeting.t = determinant != 0 ? dot(ac, q) / determinant : -dot(s, direction) / (size * size);
  const double t_near = ray.t_near, t_far = ray.t_far;
  if (meeting.t < t_near - meeting.t_error || meeting.t > t_far + meeting.t_error) return {};
  const bool certain = inside > tolerance && determinant != 0 && meeting.t > t_near + meeting.t_error &&
                       meeting.t < t_far - meeting.t_error;
  meeting.kind = certain ? Meeting::definite : Meeting::possible;
  return meeting;
}

bool is_valid(const Ray& ray) {
  const double largest =
      std::max({std::fabs(static_cast<double>(ray.direction.x)), std::fabs(static_cast<double>(ray.direction.y)),
                std::fabs(static_cast<double>(ray.direction.z))});
  const Vec3 origin = ray.origin;
  const float limit = largest_coordinate;
  return is_finite(ray.direction) && is_finite(origin) && largest <= static_cast<double>(limit) &&
         largest >= 1 / static_cast<double>(limit) && std::fabs(origin.x) <= limit && std::fabs(origin.y) <= limit &&
         std::fabs(origin.z) <= limit && ray.t_near <= ray.t_far;
}

}  // namespace

Judge::Judge(const Scene& scene) {
  const bool single = scene.single_level();
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[instance.mesh];
    Box box;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (!is_usable(mesh, t)) continue;
      for (const std::uint32_t vertex : mesh.triangles[t]) box.grow(mesh.positions[vertex]);
    }
    if (box.empty()) continue;
    const Transform& placed = instance.object_to_world;
    const InstanceError error = instance_error(placed, single ? placed : placed.inverse(), box);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (!is_usable(mesh, t)) continue;
      WorldTriangle triangle{{}, t, i, error.offset, error.gain};
      for (std::size_t vertex = 0; vertex < 3; ++vertex) {
        const Vec3d point = map(placed, mesh.positions[mesh.triangles[t][vertex]]);
        std::ranges::copy(point, triangle.vertices[vertex]);
      }
      triangles_.push_back(triangle);
    }
  }
}

Judgement Judge::closest_hit(const Ray& ray, const Hit& claimed) const {
  if (!is_valid(ray)) return claimed.valid() ? Judgement::wrong : Judgement::agrees;
  const double from_origin = std::max({std::fabs(ray.origin.x), std::fabs(ray.origin.y), std::fabs(ray.origin.z)});
  // The claim must lie no farther than what is surely hit, and on a triangle that may be hit there.
  double nearest_surely = std::numeric_limits<double>::infinity();
  Meeting own;
  std::uint32_t rivals = 0;
  for (const WorldTriangle& triangle : triangles_) {
    const double tolerance = (static_cast<double>(triangle.gain) * from_origin + triangle.magnitude) * 0x1p-20;
    const auto vertex = [&](std::size_t n) {
      return Vec3d{triangle.vertices[n][0], triangle.vertices[n][1], triangle.vertices[n][2]};
    };
    const Meeting meeting = meet(vertex(0), vertex(1), vertex(2), ray, tolerance);
    if (meeting.kind == Meeting::none) continue;
    const bool is_own = claimed.primitive == triangle.primitive && claimed.instance == triangle.instance;
    if (is_own) own = meeting;
    if (meeting.kind == Meeting::definite) nearest_surely = std::min(nearest_surely, meeting.t + meeting.t_error);
    if (!is_own && meeting.t - meeting.t_error <= static_cast<double>(claimed.t)) ++rivals;
  }
  if (!claimed.valid()) {
    if (nearest_surely < std::numeric_limits<double>::infinity()) return Judgement::wrong;
    return rivals == 0 ? Judgement::agrees : Judgement::edge_or_tie;
  }
  const double t = claimed.t;
  if (own.kind == Meeting::none || std::fabs(t - own.t) > own.t_error || t - own.t_error > nearest_surely) {
    return Judgement::wrong;
  }
  return own.kind == Meeting::definite && rivals == 0 ? Judgement::agrees : Judgement::edge_or_tie;
}

}  // namespace boxwood
