#include "logic/camera_control.h"

#include <algorithm>
#include <cmath>

namespace boxwood::viewer {
namespace {

constexpr float turn_per_height = 3.14159265f;  // radians for a drag across the window
constexpr float zoom_per_step = 0.88f;          // of the distance to the pivot that is left
constexpr float least_angle = 0.02f;            // that the view keeps from straight up and down

}  // namespace

Vec3 rotated(const Vec3& vector, const Vec3& axis, float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  return vector * c + cross(axis, vector) * s + axis * (dot(axis, vector) * (1 - c));
}

CameraControl::CameraControl(const Camera& camera, const Box& bounds) : camera_(camera) {
  if (bounds.empty()) return;
  pivot_ = bounds.center();
  size_ = std::max(length(bounds.extent()), 1e-20f);
}

Vec3 CameraControl::right() const {
  const Vec3 right = normalize(cross(camera_.direction, camera_.up));
  return right == Vec3{} ? Vec3{1, 0, 0} : right;
}

Vec3 CameraControl::upward() const { return normalize(cross(right(), camera_.direction)); }

void CameraControl::turn(float to_right, float down) {
  const Vec3 up = normalize(camera_.up), side = right();
  const Vec3 direction = normalize(camera_.direction);
  // Tilting stops short of the poles, where the side would flip.
  const float above = std::acos(std::clamp(dot(direction, up), -1.0f, 1.0f));
  float tilt = -down * turn_per_height;
  tilt = std::clamp(tilt, above - (3.14159265f - least_angle), above - least_angle);
  const float yaw = -to_right * turn_per_height;
  const auto turned = [&](const Vec3& v) { return rotated(rotated(v, side, tilt), up, yaw); };
  if (scheme == CameraScheme::trackball) camera_.eye = pivot_ + turned(camera_.eye - pivot_);
  camera_.direction = normalize(turned(direction));
}

void CameraControl::pan(float to_right, float down) {
  const float half_angle = camera_.fov * 3.14159265f / 360;
  const float distance = std::max(length(pivot_ - camera_.eye), 0.01f * size_);
  const float heights = 2 * std::tan(half_angle) * distance;
  const Vec3 step = right() * (-to_right * heights) + upward() * (down * heights);
  camera_.eye += step;
  pivot_ += step;
}

void CameraControl::zoom(float steps) {
  if (scheme == CameraScheme::first_person) {
    camera_.eye += normalize(camera_.direction) * (0.05f * size_ * steps);
    return;
  }
  const Vec3 away = camera_.eye - pivot_;
  camera_.eye = pivot_ + away * std::pow(zoom_per_step, steps);
}

void CameraControl::move(const MoveKeys& keys, float seconds, float pace) {
  const auto sign = [](bool plus, bool minus) { return static_cast<float>(plus) - static_cast<float>(minus); };
  const float step = 0.5f * size_ * seconds * pace;
  const Vec3 way = normalize(camera_.direction) * sign(keys.forward, keys.back) +
                   right() * sign(keys.right, keys.left) + upward() * sign(keys.up, keys.down);
  const Vec3 moved = normalize(way) * step;
  camera_.eye += moved;
  if (scheme == CameraScheme::trackball) pivot_ += moved;
}

}  // namespace boxwood::viewer
