#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "render/progress.h"

namespace boxwood {

struct InterleaveSettings {
  std::uint32_t repeats = 11;  ///< timed passes over all contestants, at least 1
  std::uint32_t warmup = 1;    ///< passes before them whose times are thrown away
};

/// Runs once, returns the seconds it took. Contestants time themselves, so that preparation stays off the clock.
using Contestant = std::function<double()>;

/// Runs the contestants in turn, A B C A B C …, so that all of them meet the machine in the same moods.
/// result[contestant][repeat] in seconds; samples of one repeat are pairs.
std::vector<std::vector<double>> interleave(std::span<const Contestant> contestants, const InterleaveSettings& settings,
                                            ProgressSink* progress = nullptr);

}  // namespace boxwood
