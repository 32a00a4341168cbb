#pragma once
#include "boxwood/box.h"
#include "boxwood/scene.h"

namespace boxwood::viewer {

enum class CameraScheme { trackball, first_person };

/// Which of the keys that move the camera are held down.
struct MoveKeys {
  bool forward = false, back = false, left = false, right = false, up = false, down = false;
  bool any() const { return forward || back || left || right || up || down; }
};

/// Turns mouse and keyboard into a camera. A trackball turns about, and zooms towards, the centre of the scene; a first
/// person turns about its own eye and walks.
class CameraControl {
 public:
  CameraScheme scheme = CameraScheme::trackball;

  CameraControl() = default;
  /// `bounds` of the scene may be empty.
  CameraControl(const Camera& camera, const Box& bounds);

  const Camera& camera() const { return camera_; }
  void set_camera(const Camera& camera) { camera_ = camera; }

  /// Mouse movement in heights of the window, right and down positive.
  void turn(float right, float down);
  void pan(float right, float down);
  /// Steps of the mouse wheel; forward is positive. Never passes the pivot.
  void zoom(float steps);
  /// Moves for `seconds` at a speed of half the scene's diagonal a second, times `pace`.
  void move(const MoveKeys& keys, float seconds, float pace = 1);

 private:
  Vec3 right() const;
  Vec3 upward() const;  // at right angles to the view
  Camera camera_;
  Vec3 pivot_;
  float size_ = 1;
};

/// `vector` turned by `angle` radians about the unit `axis`, counter-clockwise as seen from its tip (Rodrigues).
Vec3 rotated(const Vec3& vector, const Vec3& axis, float angle);

}  // namespace boxwood::viewer
