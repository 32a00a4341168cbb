#include "motion_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "boxwood/error.h"
#include "math/random.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

constexpr float whole_turn = 6.28318530717958647692f;

/// Where things are in a mesh: its box, cut into cells.
struct MeshFrame {
  Box box;
  float size = 1;
  std::size_t along = 2;  ///< the longest axis

  explicit MeshFrame(const std::vector<Vec3>& positions) {
    for (const Vec3& p : positions) box.grow(p);
    if (box.empty()) return;
    along = static_cast<std::size_t>(longest_axis(box.extent()));
    size = box.extent()[along];
  }
  float part(const Vec3& p) const { return size > 0 ? (p[along] - box.lower[along]) / size : 0; }
};

/// Turns sections about the longest axis, the farther along the more.
Vec3 twist(const MeshFrame& frame, const Vec3& p, float amount) {
  const float angle = whole_turn * amount * (frame.part(p) - 0.5f);
  const std::size_t a = (frame.along + 1) % 3, b = (frame.along + 2) % 3;
  const Vec3 center = frame.box.center();
  const float x = p[a] - center[a], y = p[b] - center[b];
  Vec3 out = p;
  out[a] = center[a] + x * std::cos(angle) - y * std::sin(angle);
  out[b] = center[b] + x * std::sin(angle) + y * std::cos(angle);
  return out;
}

/// A wave that runs along the longest axis.
Vec3 wave(const MeshFrame& frame, const Vec3& p, float amount, float time) {
  Vec3 out = p;
  out[(frame.along + 1) % 3] += 0.2f * amount * frame.size * std::sin(whole_turn * (2 * frame.part(p) - time));
  return out;
}

/// Cubes of an eighth of the size fly apart, each its own way; triangles between them are drawn out.
Vec3 explode(const MeshFrame& frame, const Vec3& p, float amount) {
  const Vec3 at = (p - frame.box.lower) * (8 / frame.size);
  if (!(at.x >= 0 && at.x < 9 && at.y >= 0 && at.y < 9 && at.z >= 0 && at.z < 9)) return p;  // not finite
  const auto cell =
      static_cast<std::uint64_t>(at.x) + 16 * static_cast<std::uint64_t>(at.y) + 256 * static_cast<std::uint64_t>(at.z);
  Random random(1, cell);
  const float x = random.uniform(-1, 1), y = random.uniform(-1, 1);
  const Vec3 way{x, y, random.uniform(-1, 1)};
  return p + (way * frame.size + (p - frame.box.center())) * amount;
}

void check_same_topology(const Scene& first, const Scene& frame, const std::string& file) {
  const bool same = std::ranges::equal(first.meshes, frame.meshes, [](const Mesh& a, const Mesh& b) {
    return a.positions.size() == b.positions.size() && a.triangles == b.triangles;
  });
  if (!same) {
    throw Error(
        fmt::format("{}: its triangles are not those of the first frame; frames must differ in the places of "
                    "vertices only",
                    file));
  }
}

}  // namespace

const std::vector<std::string>& MotionFrames::motion_names() {
  static const std::vector<std::string> names = {"twist", "wave", "explode"};
  return names;
}

MotionFrames::MotionFrames(const std::vector<std::string>& files, const std::string& motion, std::uint32_t count,
                           double strength)
    : files_(files), motion_(motion), count_(count), strength_(strength), rest_(load_scene(files.front())) {
  if (files.size() > 1) {
    if (!motion.empty()) throw UsageError("--motion moves one scene; with files for frames, leave it out");
    count_ = static_cast<std::uint32_t>(files.size() - 1);
  } else if (motion.empty()) {
    motion_ = "twist";
  }
  if (rest_.empty()) throw Error(fmt::format("{} has no triangles that could move", files.front()));
}

std::vector<std::vector<Vec3>> MotionFrames::positions(std::uint32_t frame) const {
  std::vector<std::vector<Vec3>> out;
  if (files_.size() > 1) {
    Scene scene = load_scene(files_[frame]);
    check_same_topology(rest_, scene, files_[frame]);
    for (Mesh& mesh : scene.meshes) out.push_back(std::move(mesh.positions));
    return out;
  }
  const float time = static_cast<float>(frame) / static_cast<float>(count_);
  const float amount = static_cast<float>(strength_) * time;
  for (const Mesh& mesh : rest_.meshes) {
    const MeshFrame of_mesh(mesh.positions);
    out.push_back(mesh.positions);
    if (of_mesh.box.empty() || !(of_mesh.size > 0)) continue;
    for (Vec3& p : out.back()) {
      p = motion_ == "twist"  ? twist(of_mesh, p, amount)
          : motion_ == "wave" ? wave(of_mesh, p, static_cast<float>(strength_), time)
                              : explode(of_mesh, p, amount);
    }
  }
  return out;
}

}  // namespace boxwood::cli
