#pragma once
#include <string>

#include "study/study_result.h"

// The parts of the page. Each is a <section>, or nothing when there is nothing to show. `prefix` tells the anchors of
// the studies on a page apart.
namespace boxwood::html {

std::string study_header(const StudyResult& result);
std::string claims_section(const StudyResult& result, const std::string& prefix);
std::string plots_section(const StudyResult& result, const std::string& prefix);
std::string tables_section(const StudyResult& result, const std::string& prefix);
std::string pictures_section(const StudyResult& result, const std::string& prefix);
std::string recipes_section(const StudyResult& result, const std::string& prefix);

/// What the numbers of a table or a plot are, escaped: "trace_ms, speed-up over k = 2, where walk = study".
std::string figure_note(const FigureSpec& figure);

}  // namespace boxwood::html
