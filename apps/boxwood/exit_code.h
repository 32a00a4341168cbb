#pragma once

namespace boxwood::cli {

inline constexpr int exit_done = 0;
inline constexpr int exit_failed = 1;         ///< the run failed, or found a wrong answer
inline constexpr int exit_usage = 2;          ///< the request itself is wrong
inline constexpr int exit_interrupted = 130;  ///< 128 + SIGINT, as shells do

}  // namespace boxwood::cli
