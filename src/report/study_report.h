#pragma once
#include <filesystem>
#include <string>

#include "report/json.h"
#include "study/study_result.h"

namespace boxwood {

/// {"study", "title", "claims": [{"id", "text", "verdict", "measured", "published", …}], "tables", "plots", "scenes",
/// "recipes", "environment", …}; docs/studies.md lists all fields.
Json to_json(const StudyResult& result);
Json to_json(const Environment& environment);

/// Tables, claims and verdicts, for a terminal.
std::string study_text(const StudyResult& result);

/// What a picture is called in the folder of images: letters and digits of what it shows.
std::string picture_file_name(const StoredPicture& picture);

/// result.json, claims.csv, tables/ID.csv, plots/ID.csv, images/… and the study file itself. Files are replaced, each
/// only once the new one is complete.
void write_study(const std::filesystem::path& folder, const StudyResult& result);

}  // namespace boxwood
