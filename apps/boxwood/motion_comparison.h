#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "boxwood/moving.h"
#include "boxwood/ray_set.h"
#include "measure/statistics.h"
#include "motion_frames.h"
#include "render/progress.h"

namespace boxwood::cli {

struct MotionSettings {
  std::string recipe = "default";
  double rays_per_frame = 1e6;
  double build_price = MotionPolicy{}.build_price;
  unsigned threads = 1;  ///< 1 is timed in CPU time, more in wall time
  std::uint32_t repeats = 3;
  RaySetSettings rays;
  std::vector<std::string> kinds;
};

/// One way of following a scene that moves.
struct MotionRow {
  std::string way;     ///< refit, parts, policy, rebuild, fast
  std::string recipe;  ///< canonical
  Estimate update_ms, mrays_per_s;
  double mean_update_ms = 0, mean_ns_per_ray = 0;
  double mean_sah_ratio = 0, last_sah_ratio = 0;  ///< cost over that of the same recipe built anew for the frame
  double rebuilt_share = 0;                       ///< of all triangles, mean over frames
  double frame_ms = 0;                            ///< update and rays_per_frame rays, mean
  /// Rays per frame from which on this way beats refitting; infinite when it never does, 0 when it always does.
  double pays_from_rays = 0;
  std::vector<double> frame_update_ms, frame_mrays_per_s, frame_sah_cost;
  std::uint64_t mismatches = 0;  ///< rays answered otherwise than by the first row
};

struct MotionComparison {
  std::vector<MotionRow> rows;
  std::uint64_t rays = 0;  ///< traced per frame and repeat
  std::string reason;      ///< why some mesh was built anew that should have been refitted
};

/// Follows the frames in every way, in turns.
MotionComparison compare_motion(const MotionFrames& frames, const MotionSettings& settings, ProgressSink* progress);

}  // namespace boxwood::cli
