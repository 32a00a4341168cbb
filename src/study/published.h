#pragma once
#include <string>
#include <vector>

#include "study/toml.h"

namespace boxwood {

/// A table as an original printed it, from text: lines of cells with '|' between them, the heads first, every line as
/// long. Throws UsageError that points to the file.
std::vector<std::vector<std::string>> read_published(const TomlValue& value);

}  // namespace boxwood
