#pragma once
#include <string>
#include <vector>

#include "boxwood/scene.h"
#include "measure/clock.h"
#include "measure/interleave.h"

namespace boxwood::cli {

/// CPU time for one thread, which a busy machine does not disturb; wall time for more.
inline Clock clock_for(unsigned threads) { return threads == 1 ? Clock::thread_cpu : Clock::wall; }

struct NamedContestant {
  std::string name;
  Contestant run;
};

/// Embree's own structures of the scene's first mesh, named like recipes; qualities are low, medium and high. Timed is
/// what a renderer pays whose triangles are in Embree's buffers, rtcCommitScene. While they live Embree has the process
/// use no more than `threads` (0: all). Nothing when Embree is not compiled in. Refers to the scene.
std::vector<NamedContestant> embree_commits(const Scene& scene, const std::vector<std::string>& qualities,
                                            unsigned threads);

/// Embree's general builder rtcBuildBVH on the scene's first mesh, medium quality, binary nodes: what it offers to
/// those who bring their own kernels. Nothing when Embree is not compiled in. Refers to the scene.
std::vector<NamedContestant> embree_builders(const Scene& scene, unsigned threads);

}  // namespace boxwood::cli
