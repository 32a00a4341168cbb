#include "report/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace boxwood {
namespace {

constexpr int bar_width = 30;
constexpr std::chrono::milliseconds redraw_interval(100);
constexpr std::string_view wipe_line = "\r\x1b[K";

double seconds(std::chrono::steady_clock::duration time) { return std::chrono::duration<double>(time).count(); }

}  // namespace

std::string progress_line(double fraction, std::string_view what, double elapsed) {
  const double done = std::clamp(fraction, 0.0, 1.0);
  const auto full = static_cast<std::size_t>(done * bar_width);
  const std::string bar = std::string(full, '=') + std::string(bar_width - full, ' ');
  std::string text = fmt::format("{}  [{}]  {:3.0f} %", what, bar, done * 100);
  // Too little done says nothing about the rest.
  if (done > 0.01 && done < 1) text += fmt::format("  {:.0f} s left", std::ceil(elapsed * (1 - done) / done));
  return text;
}

ProgressBar::ProgressBar(const std::atomic<bool>& stop)
    : stop_(stop), terminal_(isatty(STDERR_FILENO) == 1), begin_(Clock::now()), last_(begin_ - redraw_interval) {}

ProgressBar::~ProgressBar() {
  if (drawn_) fmt::print(stderr, "{}", wipe_line);
}

bool ProgressBar::report(double fraction, std::string_view what) {
  if (terminal_) {
    const auto time = Clock::now();
    if (time - last_ >= redraw_interval) {
      last_ = time;
      drawn_ = true;
      fmt::print(stderr, "{}{}", wipe_line, progress_line(fraction, what, seconds(time - begin_)));
      std::fflush(stderr);
    }
  }
  return !stop_.load(std::memory_order_relaxed);
}

}  // namespace boxwood
