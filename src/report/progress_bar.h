#pragma once
#include <atomic>
#include <chrono>
#include <string>
#include <string_view>

#include "render/progress.h"

namespace boxwood {

/// Draws "tracing  [=====     ]  52 %  3.1 s left" on one line of standard error while it is a terminal, nothing
/// otherwise. One bar for one piece of work. Asks the work to stop once `stop` is set. The line is wiped when the bar
/// goes.
class ProgressBar final : public ProgressSink {
 public:
  explicit ProgressBar(const std::atomic<bool>& stop);
  ~ProgressBar() override;
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  bool report(double fraction, std::string_view what) override;

 private:
  using Clock = std::chrono::steady_clock;

  const std::atomic<bool>& stop_;
  bool terminal_, drawn_ = false;
  Clock::time_point begin_, last_;
};

/// The bar's text: `elapsed` seconds were spent on `fraction` of the work, so the rest is foreseen in proportion.
std::string progress_line(double fraction, std::string_view what, double elapsed);

}  // namespace boxwood
