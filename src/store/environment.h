#pragma once
#include <cstdint>
#include <string>

namespace boxwood {

/// The machine and the program that measured; all that is needed to judge whether two figures may be compared.
struct Environment {
  std::string cpu;            ///< "AMD EPYC 7B13"
  std::uint32_t threads = 0;  ///< that the machine runs at once
  std::uint64_t memory_bytes = 0;
  std::string system;    ///< "Linux 6.1.0 x86_64"
  std::string compiler;  ///< "GCC 12.2.0"
  std::string flags;     ///< what the program was compiled with
  std::string commit;    ///< of the sources, "-dirty" when they were changed; "unknown" outside a repository
  std::string embree;    ///< version of the peer, "" without

  friend bool operator==(const Environment&, const Environment&) = default;
};

/// This machine, this program.
Environment this_environment();

}  // namespace boxwood
