#include "report/comparison_text.h"

#include <fmt/format.h>

#include "report/number_text.h"
#include "report/table.h"

namespace boxwood {
namespace {

constexpr double significance_level = 0.05;

/// A saved structure is called by its file.
const std::string& name_of(const RecipeRow& row) { return row.file.empty() ? row.recipe : row.file; }

std::string structures_table(const Comparison& comparison) {
  Table table({{"recipe", Align::left}, {"build ms"}, {"bytes/triangle"}, {"SAH cost"}});
  for (const RecipeRow& row : comparison.rows) {
    table.add({name_of(row), with_interval(row.build_ms), significant(row.bytes_per_triangle),
               row.peer ? "–" : significant(row.sah_cost)});
  }
  return table.text();
}

/// What a peer does not count stays a dash.
std::string tests_per_ray(const RecipeRow& row, double value) { return row.peer ? "–" : significant(value); }

std::string ratio_text(const RayKindRow& kind, bool first) {
  if (first) return "1";
  return fmt::format("{}{}", kind.ratio_p_value < significance_level ? "" : "≈ ", with_interval(kind.ratio));
}

std::string ray_kind_table(const Comparison& comparison, std::size_t index) {
  const RayKindRow& first = comparison.rows.front().rays[index];
  if (first.rays == 0) return fmt::format("{}: no rays\n", first.kind);
  Table table({{"recipe", Align::left}, {"Mrays/s"}, {"× first"}, {"node tests/ray"}, {"primitive tests/ray"}});
  for (const RecipeRow& row : comparison.rows) {
    const RayKindRow& kind = row.rays[index];
    table.add({name_of(row), with_interval(kind.mrays_per_s), ratio_text(kind, &row == &comparison.rows.front()),
               tests_per_ray(row, kind.node_tests_per_ray), tests_per_ray(row, kind.primitive_tests_per_ray)});
  }
  const double share = 100 * static_cast<double>(first.hits) / static_cast<double>(first.rays);
  return fmt::format("{}: {}, {:.1f} % hit\n\n{}", first.kind, counted(first.rays, "ray"), share, table.text());
}

bool has_insignificant_ratio(const Comparison& comparison) {
  for (std::size_t i = 1; i < comparison.rows.size(); ++i) {
    for (const RayKindRow& kind : comparison.rows[i].rays) {
      if (kind.rays > 0 && kind.ratio_p_value >= significance_level) return true;
    }
  }
  return false;
}

}  // namespace

std::string comparison_text(const Comparison& comparison) {
  std::string out = fmt::format("{}: {}\n\n{}", comparison.scene, counted(comparison.triangles, "triangle"),
                                structures_table(comparison));
  if (comparison.rows.empty()) return out;
  for (std::size_t i = 0; i < comparison.rows.front().rays.size(); ++i) {
    out += fmt::format("\n{}", ray_kind_table(comparison, i));
  }
  const std::uint64_t repeats =
      comparison.rows.front().rays.empty() ? 0 : comparison.rows.front().rays[0].mrays_per_s.n;
  out += fmt::format("\nMedians of {} interleaved passes with {}; “× first” is the speed over the first recipe's.\n",
                     repeats, repeats < 6 ? "their range (fewer than 6 give no 95 % interval)" : "95 % intervals");
  if (has_insignificant_ratio(comparison)) out += "≈: no significant difference (signed-rank test, p ≥ 0.05).\n";
  for (const std::string& disagreement : comparison.disagreements) {
    out += fmt::format("Different answers: {}\n", disagreement);
  }
  return out;
}

}  // namespace boxwood
