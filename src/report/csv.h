#pragma once
#include <string>
#include <vector>

namespace boxwood {

/// One line of comma-separated values (RFC 4180), "\n" at its end.
std::string csv_line(const std::vector<std::string>& cells);

/// A number that reads back exactly; nothing for NaN and infinities.
std::string csv_number(double value);

}  // namespace boxwood
