#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "study/figure.h"

namespace boxwood {

enum class Verdict { holds, does_not_hold, inconclusive, not_run };

/// "holds", "does-not-hold", "inconclusive", "not-run"
std::string_view verdict_name(Verdict verdict);

struct JudgedCell {
  Cell cell;
  Verdict verdict = Verdict::inconclusive;
  /// Of the paired t-test that the figure is what the expectation is measured against, after Holm's correction over the
  /// cells of the claim; of two independent series (Welch) uncorrected. 1 where no test applies.
  double p_value = 1, welch_p_value = 1;
  std::optional<double> versus;  ///< the second figure, where the claim has one
};

struct JudgedClaim {
  ClaimSpec spec;
  Verdict verdict = Verdict::not_run;
  std::string measured;  ///< a sentence with the numbers
  std::vector<JudgedCell> cells;
};

/// Looks the claim's figures up and says what follows from them. A cell holds when its whole interval is on the right
/// side and, for timings, the corrected test at 5 % says that it is not chance; it does not hold when the same is true
/// of the other side; otherwise it is inconclusive.
JudgedClaim judge(const Study& study, const Observations& observations, const ClaimSpec& claim);

}  // namespace boxwood
