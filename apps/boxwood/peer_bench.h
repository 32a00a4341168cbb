// Boxwood against Embree, column by column: the best of our presets against the best of Embree's qualities and calls.
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "measure/statistics.h"
#include "peer_scenes.h"
#include "render/progress.h"

namespace boxwood::cli {

/// One figure of one scene, as a ratio of speeds in the same repeat: above 1, ours is faster.
struct PeerColumn {
  std::string name;  ///< "closest.diffuse.batch", "any.ao.single", "build.fast"
  std::string ours, peer;
  Estimate ratio;
  std::vector<double> ratios;  ///< one per repeat
  std::uint64_t rays = 0, mismatches = 0;
};

struct PeerSceneBench {
  std::string scene;
  std::uint64_t triangles = 0;
  std::vector<PeerColumn> columns;
  std::vector<std::pair<std::string, double>> bytes_per_triangle;  ///< of each preset, beyond the mesh
};

struct PeerBench {
  unsigned threads = 1;
  std::vector<PeerSceneBench> scenes;
  std::vector<std::pair<std::string, Estimate>> geometric_means;  ///< over the scenes, of each column
};

struct PeerBenchSettings {
  std::vector<PeerScene> scenes;
  std::uint32_t repeats = 9;
  std::uint32_t build_repeats = 3;
  double least_build_seconds = 0.1;              ///< shorter builds are timed several at once, until these are over
  std::uint32_t side = 1024;                     ///< pixels of the camera's image
  std::size_t most_rays = std::size_t{1} << 18;  ///< of a kind, in whole calls from all over the picture
  unsigned threads = 1;                          ///< 0: all. One thread is timed in CPU time, more in wall time.
};

/// Of each column, all calls are timed once; the fastest few then take turns. Rays are traced in parts of 4,096. The
/// mean over scenes is taken in each repeat, so its interval is that of the repeats. Without Embree there are no
/// columns.
PeerBench bench_against_embree(const PeerBenchSettings& settings, ProgressSink& progress);

}  // namespace boxwood::cli
