#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "boxwood/scene.h"
#include "boxwood/structure.h"
#include "render/render.h"

namespace boxwood::cli {

/// First, last, least, mean and most of a few times, in seconds.
struct FrameTimes {
  double first = 0, last = 0, least = 0, mean = 0, most = 0;
  FrameTimes() = default;
  explicit FrameTimes(const std::vector<double>& seconds);
};

/// What one structure does on one scene, frame by frame, as the single slab study reports it (spec 003, 1.10).
struct FrameTest {
  std::string recipe, scene;
  std::uint64_t triangles = 0;
  Box bounds;
  std::uint32_t width = 0, height = 0, frames = 0;
  unsigned threads = 0;
  double build_seconds = 0;
  std::uint32_t tree_height = 0;
  std::uint64_t inner_nodes = 0, leaf_nodes = 0;
  std::uint64_t node_bytes = 0;               ///< of the layout without its triangles
  double surface_ratio = 0;                   ///< of single slabs; 0 where nodes are not slabs
  std::string walk;                           ///< "iterative, near"
  double node_tests = 0, triangle_tests = 0;  ///< per ray
  FrameTimes traversal, raytrace;             ///< rays only; rays and shading
};

/// Times `frames` pictures of the primary rays alone, in blocks of 4 x 4 pixels made of blocks of 2 x 2, and as many
/// whole renderings. In the caller's arena.
FrameTest test_frames(const Scene& scene, const Recipe& recipe, const RenderSettings& settings, std::uint32_t frames,
                      unsigned threads);

/// The block of the study's report.
std::string report_text(const FrameTest& test);

}  // namespace boxwood::cli
