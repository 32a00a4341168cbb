#include "report/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace boxwood {
namespace {

constexpr int bar_width = 30;
constexpr std::chrono::milliseconds redraw_interval(100);
constexpr std::string_view wipe_line = "\r\x1b[K";

double seconds(std::chrono::steady_clock::duration time) { return std::chrono::duration<double>(time).count(); }

/// "42 s", "12 min", "2 h 05 min"; rounded up.
std::string time_left_text(double seconds) {
  if (seconds < 100) return fmt::format("{:.0f} s", std::ceil(seconds));
  const auto minutes = static_cast<std::int64_t>(std::ceil(seconds / 60));
  return minutes < 100 ? fmt::format("{} min", minutes) : fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
}

}  // namespace

std::string progress_line(double fraction, std::string_view what, double elapsed) {
  const double done = std::clamp(fraction, 0.0, 1.0);
  const auto full = static_cast<std::size_t>(done * bar_width);
  const std::string bar = std::string(full, '=') + std::string(bar_width - full, ' ');
  std::string text = fmt::format("{}  [{}]  {:3.0f} %", what, bar, done * 100);
  // Too little done says nothing about the rest.
  if (done > 0.01 && done < 1) text += fmt::format("  {} left", time_left_text(elapsed * (1 - done) / done));
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
