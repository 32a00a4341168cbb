#include "study/claim.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

#include "measure/significance.h"
#include "options/options.h"

namespace boxwood {
namespace {

using Kind = Expectation::Kind;

constexpr double significance = 0.05;
constexpr double negligible = 0.01;  // relative difference that nobody would notice
constexpr double weak_correlation = 0.5;
constexpr std::size_t fewest_unrelated = 8;  // cells; of fewer nobody can say so

/// p-values of the cells against `reference`, on logarithms where the figure is a ratio.
void test_cells(std::vector<JudgedCell>& cells, double reference) {
  std::vector<double> p_values;
  for (JudgedCell& judged : cells) {
    const Cell& cell = judged.cell;
    std::vector<double> differences;
    for (std::size_t r = 0; r < cell.values.size(); ++r) {
      differences.push_back(cell.baseline.empty() ? cell.values[r] - reference
                                                  : std::log(cell.baseline[r] / cell.values[r] / reference));
    }
    if (cell.exact) {
      p_values.push_back(cell.estimate.median == reference ? 1 : 0);
    } else {
      p_values.push_back(paired_t_p_value(differences));
    }
    if (!cell.baseline.empty() && !cell.exact) judged.welch_p_value = welch_p_value(cell.baseline, cell.values);
  }
  const std::vector<double> corrected = holm(p_values);
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i].p_value = corrected[i];
}

Verdict judge_side(const JudgedCell& judged, double reference, bool above) {
  if (judged.p_value >= significance) {
    // An exact figure that is the reference itself is on neither side.
    return judged.cell.exact ? Verdict::does_not_hold : Verdict::inconclusive;
  }
  const Estimate& e = judged.cell.estimate;
  if (e.low > reference) return above ? Verdict::holds : Verdict::does_not_hold;
  if (e.high < reference) return above ? Verdict::does_not_hold : Verdict::holds;
  return Verdict::inconclusive;
}

Verdict judge_between(const Estimate& e, double low, double high) {
  if (e.low >= low && e.high <= high) return Verdict::holds;
  if (e.high < low || e.low > high) return Verdict::does_not_hold;
  return Verdict::inconclusive;
}

Verdict judge_difference(const JudgedCell& judged, double reference) {
  const Estimate& e = judged.cell.estimate;
  if (judged.p_value < significance && (e.low > reference || e.high < reference)) return Verdict::holds;
  const bool close = e.low >= reference * (1 - negligible) && e.high <= reference * (1 + negligible);
  return close ? Verdict::does_not_hold : Verdict::inconclusive;
}

/// Whether the figure lies above its limit just where the second figure lies above its own.
Verdict judge_sides(const JudgedCell& judged, const Expectation& expect) {
  const Estimate& e = judged.cell.estimate;
  if (e.low <= expect.low && e.high >= expect.low) return Verdict::inconclusive;
  return (e.median > expect.low) == (*judged.versus > expect.high) ? Verdict::holds : Verdict::does_not_hold;
}

void judge_cells(std::vector<JudgedCell>& cells, const Expectation& expect) {
  if (expect.kind == Kind::above || expect.kind == Kind::differs) test_cells(cells, expect.low);
  if (expect.kind == Kind::below) test_cells(cells, expect.high);
  for (JudgedCell& judged : cells) {
    switch (expect.kind) {
      case Kind::above:
        judged.verdict = judge_side(judged, expect.low, true);
        break;
      case Kind::below:
        judged.verdict = judge_side(judged, expect.high, false);
        break;
      case Kind::between:
        judged.verdict = judge_between(judged.cell.estimate, expect.low, expect.high);
        break;
      case Kind::differs:
        judged.verdict = judge_difference(judged, expect.low);
        break;
      case Kind::splits:
        judged.verdict = judge_sides(judged, expect);
        break;
      case Kind::same:
      case Kind::rises:
      case Kind::falls:
      case Kind::unrelated:
        break;  // of all cells together
    }
  }
}

/// Holds when enough cells do, fails when too few still could.
Verdict combine(const std::vector<JudgedCell>& cells, const std::string& need) {
  const auto count = [&](Verdict verdict) {
    return static_cast<double>(std::ranges::count(cells, verdict, &JudgedCell::verdict));
  };
  const auto all = static_cast<double>(cells.size());
  double wanted = all;
  if (need == "any") {
    wanted = 1;
  } else if (need == "most") {
    wanted = std::floor(all / 2) + 1;
  } else if (need != "all" && need != "mean") {
    wanted = std::ceil(std::stod(need) * all - 1e-9);
  }
  if (count(Verdict::holds) >= wanted) return Verdict::holds;
  if (all - count(Verdict::does_not_hold) < wanted) return Verdict::does_not_hold;
  return Verdict::inconclusive;
}

std::string number(double value) {
  if (value != 0 && (std::fabs(value) >= 1e6 || std::fabs(value) < 1e-3)) return fmt::format("{:.4g}", value);
  return fmt::format("{:.4}", value);
}

std::string spread_text(const std::vector<JudgedCell>& cells) {
  double low = cells.front().cell.estimate.median, high = low, sum = 0;
  for (const JudgedCell& judged : cells) {
    low = std::min(low, judged.cell.estimate.median);
    high = std::max(high, judged.cell.estimate.median);
    sum += judged.cell.estimate.median;
  }
  if (cells.size() == 1) {
    const Estimate& e = cells.front().cell.estimate;
    return fmt::format("{} ({}–{})", number(e.median), number(e.low), number(e.high));
  }
  return fmt::format("{} to {}, mean {}", number(low), number(high), number(sum / static_cast<double>(cells.size())));
}

std::string counted_text(const std::vector<JudgedCell>& cells) {
  if (cells.size() == 1) return spread_text(cells);
  const auto count = [&](Verdict verdict) { return std::ranges::count(cells, verdict, &JudgedCell::verdict); };
  std::string out = fmt::format("{} of {} cells", count(Verdict::holds), cells.size());
  if (const auto open = count(Verdict::inconclusive)) out += fmt::format(", {} undecided", open);
  return fmt::format("{}; {}", out, spread_text(cells));
}

/// Ranks from 1, ties sharing the mean of theirs.
std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<double> out;
  for (const double x : values) {
    const auto below = std::ranges::count_if(values, [&](double y) { return y < x; });
    const auto equal = std::ranges::count(values, x);
    out.push_back(static_cast<double>(below) + (static_cast<double>(equal) + 1) / 2);
  }
  return out;
}

struct RankCorrelation {
  double rho = 0, p_value = 1;
};

/// Spearman's, with the t approximation of its distribution.
RankCorrelation rank_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  const std::vector<double> a = ranks(x), b = ranks(y);
  double ab = 0, aa = 0, bb = 0;
  const double middle = (n + 1) / 2;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - middle) * (b[i] - middle);
    aa += (a[i] - middle) * (a[i] - middle);
    bb += (b[i] - middle) * (b[i] - middle);
  }
  if (n < 3 || aa == 0 || bb == 0) return {};
  const double rho = std::clamp(ab / std::sqrt(aa * bb), -1.0, 1.0);
  if (std::fabs(rho) == 1) return {rho, n > 3 ? 0.0 : 1.0};  // three in order happen by chance
  const double t = rho * std::sqrt((n - 2) / (1 - rho * rho));
  const boost::math::students_t_distribution<double> distribution(n - 2);
  return {rho, 2 * boost::math::cdf(boost::math::complement(distribution, std::fabs(t)))};
}

double position(const JudgedCell& judged, const std::string& along) {
  const Cell& cell = judged.cell;
  if (along == "versus") return *judged.versus;
  if (along == "triangles") return cell.triangles;
  if (along == "baseline") return cell.baseline.empty() ? 0 : median(cell.baseline);
  const auto found = cell.factors.find(along);
  try {
    return found == cell.factors.end() ? 0 : std::stod(found->second);
  } catch (const std::logic_error&) {
    throw UsageError(fmt::format("'{}' is not a number, so nothing rises or falls with it", found->second));
  }
}

void judge_trend(JudgedClaim& claim) {
  const Expectation& expect = *claim.spec.expect;
  std::vector<double> x, y;
  for (const JudgedCell& judged : claim.cells) {
    x.push_back(position(judged, expect.along));
    y.push_back(judged.cell.estimate.median);
  }
  const RankCorrelation found = rank_correlation(x, y);
  claim.measured = fmt::format("rank correlation with {} {:.2f} (p = {:.2g}) over {} cells; {}", expect.along,
                               found.rho, found.p_value, claim.cells.size(), spread_text(claim.cells));
  claim.verdict = Verdict::inconclusive;
  if (expect.kind == Kind::unrelated) {
    if (found.p_value < significance) claim.verdict = Verdict::does_not_hold;
    if (found.p_value >= significance && std::fabs(found.rho) < weak_correlation && x.size() >= fewest_unrelated)
      claim.verdict = Verdict::holds;
    return;
  }
  if (found.p_value >= significance) return;
  claim.verdict = (found.rho > 0) == (expect.kind == Kind::rises) ? Verdict::holds : Verdict::does_not_hold;
}

/// Every series of a cell must have one and the same value.
void judge_sameness(const Study& study, const Observations& observations, JudgedClaim& claim) {
  std::vector<std::string> every = claim.spec.each;
  for (const char* factor : {"scene", "recipe"}) {
    if (std::ranges::find(every, factor) == every.end()) every.push_back(factor);
  }
  const std::vector<Cell> series = cells(study, observations, claim.spec.figure, every);
  std::size_t same = 0;
  std::string example;
  for (JudgedCell& judged : claim.cells) {
    const Cell* first = nullptr;
    judged.verdict = Verdict::holds;
    for (const Cell& one : series) {
      const bool inside = std::ranges::all_of(
          judged.cell.factors, [&](const auto& entry) { return one.factors.at(entry.first) == entry.second; });
      if (!inside) continue;
      if (!first) first = &one;
      if (one.values == first->values) continue;
      judged.verdict = Verdict::does_not_hold;
      if (example.empty())
        example = fmt::format("; {} is not as {}", cell_name(one.factors), cell_name(first->factors));
    }
    same += judged.verdict == Verdict::holds;
  }
  claim.verdict = combine(claim.cells, claim.spec.need);
  claim.measured =
      fmt::format("the same in {} of {} cells, {} figures{}", same, claim.cells.size(), series.size(), example);
}

/// Gives each cell its second figure, or divides by it; cells without one are left out.
void set_beside(const Study& study, const Observations& observations, JudgedClaim& claim) {
  const Kind kind = claim.spec.expect->kind;
  const bool divide = kind != Kind::splits && claim.spec.expect->along.empty();
  std::vector<Cell> of;
  for (const JudgedCell& judged : claim.cells) of.push_back(judged.cell);
  const std::vector<std::optional<Cell>> beside = cells_beside(study, observations, *claim.spec.versus, of);
  claim.cells.clear();
  for (std::size_t i = 0; i < of.size(); ++i) {
    if (!beside[i]) continue;
    JudgedCell judged;
    judged.cell = divide ? quotient(study, of[i], *beside[i]) : std::move(of[i]);
    judged.versus = beside[i]->estimate.median;
    claim.cells.push_back(std::move(judged));
  }
}

}  // namespace

std::string_view verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "holds";
    case Verdict::does_not_hold:
      return "does-not-hold";
    case Verdict::inconclusive:
      return "inconclusive";
    case Verdict::not_run:
      break;
  }
  return "not-run";
}

JudgedClaim judge(const Study& study, const Observations& observations, const ClaimSpec& spec) {
  JudgedClaim claim;
  claim.spec = spec;
  if (!spec.expect) {
    claim.measured = spec.note;
    return claim;
  }
  const std::vector<std::string> each = spec.need == "mean" ? std::vector<std::string>() : spec.each;
  for (Cell& cell : cells(study, observations, spec.figure, each)) claim.cells.emplace_back().cell = std::move(cell);
  if (spec.versus) set_beside(study, observations, claim);
  if (claim.cells.empty()) {
    claim.measured = "nothing of this was measured";
    return claim;
  }
  if (spec.expect->kind == Kind::same) {
    judge_sameness(study, observations, claim);
    return claim;
  }
  if (!spec.expect->along.empty()) {
    judge_trend(claim);
    return claim;
  }
  judge_cells(claim.cells, *spec.expect);
  claim.verdict = combine(claim.cells, spec.need);
  claim.measured = counted_text(claim.cells);
  return claim;
}

}  // namespace boxwood
