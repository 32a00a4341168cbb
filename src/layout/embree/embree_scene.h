#pragma once
#include <embree3/rtcore.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "boxwood/scene.h"
#include "layout/embree/embree_user.h"

namespace boxwood {

enum class EmbreeQuality : std::uint8_t { low, medium, high };
enum class EmbreeBatch : std::uint8_t { single, packet16, stream };
enum class EmbreeGeometry : std::uint8_t { triangles, user };

struct EmbreeOptions {
  EmbreeQuality quality = EmbreeQuality::medium;
  bool robust = false;
  bool compact = false;
  EmbreeBatch batch = EmbreeBatch::single;  ///< how batches are handed over
  EmbreeGeometry geometry = EmbreeGeometry::triangles;
};

/// A device with one committed scene: the triangles of a single-level scene themselves, or one Embree instance per
/// instance, under its number.
class EmbreeScene {
 public:
  /// Builds in the caller's arena. Throws Error with Embree's own words when it fails.
  EmbreeScene(const Scene& scene, const EmbreeOptions& options);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  RTCScene handle() const { return top_; }
  std::size_t bytes() const { return static_cast<std::size_t>(bytes_.load()); }
  /// Number in its mesh of the triangle that Embree calls `primitive`; unusable triangles are not handed to it.
  std::uint32_t primitive_of(std::uint32_t instance, std::uint32_t primitive) const {
    const std::vector<std::uint32_t>& numbers = numbers_[mesh_of_[instance]];
    return numbers.empty() ? primitive : numbers[primitive];
  }

 private:
  RTCScene new_scene(const EmbreeOptions& options);
  RTCScene commit_mesh(const Mesh& mesh, const EmbreeOptions& options, std::vector<std::uint32_t>& numbers);
  RTCScene commit_user_mesh(const Mesh& mesh, const EmbreeOptions& options);
  void check() const;
  void release();

  RTCDevice device_ = nullptr;
  RTCScene top_ = nullptr;
  std::vector<RTCScene> bottoms_;
  std::vector<std::uint32_t> mesh_of_;                        ///< per instance
  std::vector<std::vector<std::uint32_t>> numbers_;           ///< per mesh; empty when every triangle is usable
  std::vector<std::unique_ptr<EmbreeUserMesh>> user_meshes_;  ///< what callbacks are given
  std::atomic<std::ptrdiff_t> bytes_ = 0;
};

}  // namespace boxwood
