#pragma once
#include <functional>

namespace boxwood::cli {

/// What the arguments ask for, checked and ready to run; calling it returns the exit code. Help and the version are
/// commands too. Throws UsageError, one sentence, on arguments that cannot be understood.
std::function<int()> parse_command_line(int count, const char* const* arguments);

}  // namespace boxwood::cli
