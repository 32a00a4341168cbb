#pragma once
#include <string_view>

#include "boxwood/error.h"

namespace boxwood {

/// Thrown by long work after its ProgressSink asked it to stop.
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled on request") {}
};

/// Who watches long work. The library never calls it from two threads at a time, but it may call from any thread.
class ProgressSink {
 public:
  virtual ~ProgressSink() = default;
  /// `fraction` done in [0, 1], never falling; `what` is being done, such as "tracing". Return false to stop the work,
  /// which then throws Cancelled.
  virtual bool report(double fraction, std::string_view what) = 0;
};

/// Tells `sink`, if there is one. Throws Cancelled when it asks to stop.
inline void report_progress(ProgressSink* sink, double fraction, std::string_view what) {
  if (sink && !sink->report(fraction, what)) throw Cancelled();
}

}  // namespace boxwood
