#include "study/spread.h"

#include <algorithm>

namespace boxwood {
namespace {

Cell named(Cell cell, Factors row, const char* what) {
  cell.factors = std::move(row);
  cell.factors[spread_factor] = what;
  return cell;
}

Cell number(std::size_t count, const Factors& row, const char* what) {
  const auto value = static_cast<double>(count);
  Cell cell;
  cell.estimate = {value, value, value, 1};
  cell.values = {value};
  cell.mean = value;
  cell.exact = true;
  return named(std::move(cell), row, what);
}

bool is_of(const Cell& cell, const Factors& row) {
  return std::ranges::all_of(row, [&](const auto& level) { return cell.factors.at(level.first) == level.second; });
}

}  // namespace

std::vector<Cell> spread_cells(const Study& study, const Observations& observations, const FigureSpec& figure,
                               const std::vector<std::string>& rows, const std::vector<std::string>& over) {
  std::vector<std::string> each = rows;
  each.insert(each.end(), over.begin(), over.end());
  const std::vector<Cell> all = cells(study, observations, figure, each);
  const auto centre = [](const Cell* cell) { return cell->estimate.median; };
  std::vector<Cell> out;
  for (const Cell& mean : cells(study, observations, figure, rows)) {
    const Factors& row = mean.factors;
    std::vector<const Cell*> members;
    for (const Cell& cell : all) {
      if (is_of(cell, row)) members.push_back(&cell);
    }
    if (members.empty()) continue;
    const auto [lowest, highest] = std::ranges::minmax_element(members, {}, centre);
    out.push_back(named(**lowest, row, "lowest"));
    out.push_back(named(mean, row, "mean"));
    out.push_back(named(**highest, row, "highest"));
    if (is_ratio(figure)) {
      const auto above = std::ranges::count_if(members, [&](const Cell* cell) { return centre(cell) > 1; });
      out.push_back(number(static_cast<std::size_t>(above), row, "above 1"));
    }
    out.push_back(number(members.size(), row, "all"));
  }
  return out;
}

}  // namespace boxwood
