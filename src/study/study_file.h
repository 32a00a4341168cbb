#pragma once
#include <filesystem>
#include <string_view>

#include "study/study.h"

namespace boxwood {

/// Reads a study; `quick` lays its [quick] table over its [run] table. Throws UsageError "FILE:LINE: …" on anything
/// that is not understood: unknown keys, metrics, factors, ray kinds, recipes that do not parse.
Study parse_study(std::string_view text, const std::string& file_name, bool quick = false);
Study read_study(const std::filesystem::path& file, bool quick = false);

}  // namespace boxwood
