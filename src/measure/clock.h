#pragma once

namespace boxwood {

/// What a second is. The calling thread's CPU time leaves out what other processes take from a shared machine, but also
/// other threads of one's own: use it for single-threaded work only.
enum class Clock { thread_cpu, wall };

/// Seconds since some fixed moment.
double now(Clock clock);

}  // namespace boxwood
