#include "measure/clock.h"

#include <time.h>

namespace boxwood {

double now(Clock clock) {
  timespec time;
  clock_gettime(clock == Clock::thread_cpu ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace boxwood
