#pragma once
#include <span>
#include <string>

#include "study/study_result.h"

namespace boxwood {

/// One HTML page with everything that the results say: how to repeat them, claims and verdicts, tables, plots and
/// pictures. It needs no other file and no network, and forbids itself both.
std::string html_report(std::span<const StudyResult> results);

}  // namespace boxwood
