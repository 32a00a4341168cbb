#pragma once
#include <cstdint>
#include <string>

#include "measure/statistics.h"

namespace boxwood {

/// "1,234,567"
std::string grouped(std::uint64_t value);

/// At least `digits` significant digits in plain notation, never fewer than the whole part has: "12.3", "1,234",
/// "0.00123"; below a millionth "1.23e-07". A dash for NaN and infinities.
std::string significant(double value, int digits = 3);

/// "12.3 (11.9–12.8)": the median and its interval, all to the decimals that the median needs.
std::string with_interval(const Estimate& estimate, int digits = 3);

/// "512 B", "1.5 kB", "2.31 GB"; powers of 1000.
std::string bytes_text(std::uint64_t bytes);

/// "850 ms", "12.3 s", "3 min 05 s".
std::string duration_text(double seconds);

/// "1 triangle", "2 triangles": for nouns that take an s.
std::string counted(std::uint64_t count, const std::string& noun);

}  // namespace boxwood
