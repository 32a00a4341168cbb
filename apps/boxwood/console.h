#pragma once
#include <atomic>
#include <string_view>

#include "report/json.h"

namespace boxwood::cli {

/// Set by the first Ctrl-C; long work looks at it through a ProgressBar. A second Ctrl-C ends the program at once.
const std::atomic<bool>& stop_requested();
void watch_for_interrupt();
/// Throws Cancelled once Ctrl-C was pressed. For between the steps of work that has no progress bar.
void check_interrupt();

/// To standard output. Throws Error when that cannot be written, as on a full disk or a closed pipe.
void print(std::string_view text);
void print_json(const Json& document);
/// One sentence to standard error, as "boxwood: …".
void complain(std::string_view sentence);

}  // namespace boxwood::cli
