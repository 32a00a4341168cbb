#include "store/environment.h"

#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "store/build_facts.h"

namespace boxwood {
namespace {

std::string cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::uint64_t memory_bytes() {
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  return pages > 0 && page > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page) : 0;
}

std::string system_name() {
  utsname name;
  if (uname(&name) != 0) return "unknown";
  return fmt::format("{} {} {}", name.sysname, name.release, name.machine);
}

}  // namespace

Environment this_environment() {
  Environment environment;
  environment.cpu = cpu_name();
  environment.threads = std::thread::hardware_concurrency();
  environment.memory_bytes = memory_bytes();
  environment.system = system_name();
  environment.compiler = build_facts::compiler;
  environment.flags = build_facts::flags;
  environment.commit = build_facts::commit;
  environment.embree = build_facts::embree;
  return environment;
}

}  // namespace boxwood
