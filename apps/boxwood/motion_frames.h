#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "boxwood/scene.h"

namespace boxwood::cli {

/// A scene over time: files of the same topology, or one scene that is deformed.
class MotionFrames {
 public:
  /// Frame 0 is the first file; each further file is one frame. With one file, `motion` (of motion_names()) makes
  /// `count` frames of it. `strength` is how far it goes: turns of `twist`, half the height of a `wave` and the way of
  /// an `explode` in sizes of a mesh. Throws UsageError on files together with a motion.
  MotionFrames(const std::vector<std::string>& files, const std::string& motion, std::uint32_t count, double strength);

  static const std::vector<std::string>& motion_names();

  /// As it stands at first.
  const Scene& rest() const { return rest_; }
  /// Frames that follow.
  std::uint32_t count() const { return count_; }
  /// Positions of every mesh in frame 1 … count(). Throws Error when a file has other triangles than the first.
  std::vector<std::vector<Vec3>> positions(std::uint32_t frame) const;

 private:
  std::vector<std::string> files_;
  std::string motion_;
  std::uint32_t count_ = 0;
  double strength_ = 1;
  Scene rest_;
};

}  // namespace boxwood::cli
