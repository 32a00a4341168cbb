#include "console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "exit_code.h"

namespace boxwood::cli {
namespace {

std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

extern "C" void on_interrupt(int) {
  if (stop.exchange(true)) _exit(exit_interrupted);
  constexpr std::string_view message = "\nboxwood: stopping; press Ctrl-C again to stop at once\n";
  // A lost message is no reason to do anything else.
  [[maybe_unused]] const auto written = write(STDERR_FILENO, message.data(), message.size());
}

}  // namespace

const std::atomic<bool>& stop_requested() { return stop; }

void watch_for_interrupt() {
  struct sigaction action = {};
  action.sa_handler = on_interrupt;
  sigaction(SIGINT, &action, nullptr);
  // Writing into a closed pipe is an error to report, not a reason to die silently.
  std::signal(SIGPIPE, SIG_IGN);
}

void check_interrupt() {
  if (stop) throw Cancelled();
}

void print(std::string_view text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw Error(fmt::format("standard output could not be written: {}", std::strerror(errno)));
  }
}

void print_json(const Json& document) {
  // File names need not be UTF-8, JSON must be.
  print(fmt::format("{}\n", document.dump(2, ' ', false, Json::error_handler_t::replace)));
}

void complain(std::string_view sentence) { fmt::print(stderr, "boxwood: {}\n", sentence); }

}  // namespace boxwood::cli
