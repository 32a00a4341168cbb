#include "logic/projection.h"

#include <algorithm>
#include <cmath>

namespace boxwood::viewer {

Projection::Projection(const Camera& camera, float width, float height)
    : eye_(camera.eye), ahead_(normalize(camera.direction)), width_(width), height_(height) {
  right_ = normalize(cross(ahead_, camera.up));
  if (right_ == Vec3{}) right_ = {1, 0, 0};
  up_ = cross(right_, ahead_);
  const float half = std::tan(camera.fov * 3.14159265f / 360);
  scale_ = std::min(width, height) / (2 * half);
}

Vec3 Projection::in_camera(const Vec3& p) const {
  const Vec3 way = p - eye_;
  return {dot(way, right_), dot(way, up_), dot(way, ahead_)};
}

PicturePoint Projection::on_picture(const Vec3& seen) const {
  return {width_ / 2 + seen.x / seen.z * scale_, height_ / 2 - seen.y / seen.z * scale_};
}

std::optional<PicturePoint> Projection::point(const Vec3& p) const {
  const Vec3 seen = in_camera(p);
  if (!(seen.z > 0)) return std::nullopt;
  return on_picture(seen);
}

std::optional<Projection::Line> Projection::line(Vec3 a, Vec3 b) const {
  Vec3 from = in_camera(a), to = in_camera(b);
  const float nearest = 1e-4f * std::max({std::fabs(from.z), std::fabs(to.z), 1e-20f});
  if (from.z < nearest && to.z < nearest) return std::nullopt;
  const auto clip = [&](Vec3& behind, const Vec3& before) {
    if (behind.z < nearest) behind = before + (behind - before) * ((before.z - nearest) / (before.z - behind.z));
  };
  clip(from, to);
  clip(to, from);
  return Line{on_picture(from), on_picture(to)};
}

}  // namespace boxwood::viewer
