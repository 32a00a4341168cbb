#pragma once
#include <string>
#include <vector>

#include "store/store.h"
#include "study/claim.h"
#include "study/figure.h"
#include "study/study.h"

namespace boxwood {

struct TableResult {
  TableSpec spec;
  std::vector<Cell> cells;
};

struct PlotResult {
  PlotSpec spec;
  std::vector<Cell> cells;
  // Of plots whose x is a figure, in the order of the cells:
  std::vector<Estimate> x;
  std::vector<bool> on_front;  ///< no other point of the panel is better in x or in y without being worse in the other
};

/// Everything a report says.
struct StudyResult {
  Study study;
  Environment environment;
  std::vector<SceneFacts> scenes;
  std::vector<TableResult> tables;
  std::vector<PlotResult> plots;
  std::vector<JudgedClaim> claims;
  std::vector<StoredPicture> pictures;
  std::uint64_t measurements = 0;  ///< of this study in this environment
  std::uint64_t outliers = 0;      ///< timings far from the others of their kind; none is left out
};

/// Every study in the store, in the environment that measured it last. Studies without measurements are left out.
std::vector<StudyResult> evaluate_all(const Store& store);

/// Evaluates a study over a store. Quick for what a study holds: seconds at most.
StudyResult evaluate(const Study& study, const Store& store, std::int64_t environment);

}  // namespace boxwood
