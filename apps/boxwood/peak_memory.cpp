#include "peak_memory.h"

#include <malloc.h>

#include <fstream>
#include <string>

#include "boxwood/memory.h"

namespace boxwood::cli {
namespace {

/// A line such as "VmHWM:   3132 kB" of /proc/self/status, in bytes.
std::optional<std::size_t> status_bytes(const std::string& field) {
  std::ifstream status("/proc/self/status");
  for (std::string name; status >> name;) {
    std::size_t kilobytes = 0;
    if (name == field + ":" && status >> kilobytes) return kilobytes * 1024;
    status.ignore(1 << 20, '\n');
  }
  return std::nullopt;
}

/// Makes the peak so far what is resident now; see proc(5).
bool reset_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

}  // namespace

std::optional<PeakMemory> peak_memory_of(const std::function<void()>& work) {
  // Memory that was freed but kept would hide as much of what `work` takes.
  release_kept_memory();
  malloc_trim(0);
  const bool told = reset_peak();
  const auto before = status_bytes("VmRSS");
  work();
  const auto peak = status_bytes("VmHWM");
  if (!told || !before || !peak) return std::nullopt;
  return PeakMemory{*peak - std::min(*peak, *before), *peak};
}

}  // namespace boxwood::cli
