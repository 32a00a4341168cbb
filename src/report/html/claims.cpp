// Claims: what was said, what was measured, and whether it holds.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "report/cell_grid.h"
#include "report/html/markup.h"
#include "report/html/sections.h"
#include "report/number_text.h"

namespace boxwood::html {
namespace {

struct VerdictLook {
  Verdict verdict;
  const char *sign, *words;
};
constexpr std::array looks = {
    VerdictLook{Verdict::holds, "✓", "holds"}, VerdictLook{Verdict::does_not_hold, "✗", "does not hold"},
    VerdictLook{Verdict::inconclusive, "?", "inconclusive"}, VerdictLook{Verdict::not_run, "–", "not run"}};

std::string badge(Verdict verdict) {
  const auto look = std::ranges::find(looks, verdict, &VerdictLook::verdict);
  return fmt::format("<span class=\"badge {}\">{} {}</span>", verdict_name(verdict), look->sign, look->words);
}

/// How many of each; the script makes them filters.
std::string tally(const std::vector<JudgedClaim>& claims) {
  std::string out = "<p class=\"tally\">";
  for (const VerdictLook& look : looks) {
    const auto count = std::ranges::count(claims, look.verdict, &JudgedClaim::verdict);
    if (count == 0) continue;
    out += fmt::format("<button type=\"button\" class=\"badge {0}\" data-verdict=\"{0}\">{1} {2} {3}</button>",
                       verdict_name(look.verdict), look.sign, count, look.words);
  }
  return out + "</p>\n";
}

std::string p_text(double p) { return p < 0.0001 ? "&lt; 0.0001" : fmt::format("{:.4f}", p); }

std::string cells_table(const JudgedClaim& claim) {
  if (claim.cells.empty()) return "";
  std::string out =
      fmt::format("<details><summary>{}: {}</summary><div class=\"wide\"><table class=\"sortable\"><thead><tr>",
                  counted(claim.cells.size(), "cell"), figure_note(claim.spec.figure));
  for (const std::string& factor : claim.spec.each) out += fmt::format("<th>{}</th>", escaped(factor));
  out += "<th class=\"n\">figure</th><th class=\"n\">p</th><th>verdict</th></tr></thead><tbody>";
  for (const JudgedCell& judged : claim.cells) {
    out += "<tr>";
    for (const std::string& factor : claim.spec.each) {
      const auto level = judged.cell.factors.find(factor);
      out += fmt::format("<th>{}</th>", level == judged.cell.factors.end() ? "all" : escaped(level->second));
    }
    out += fmt::format("<td class=\"n\" data-v=\"{}\">{}</td><td class=\"n\" data-v=\"{}\">{}</td><td>{}</td></tr>",
                       judged.cell.estimate.median, escaped(cell_text(judged.cell)), judged.p_value,
                       judged.cell.exact ? "exact" : p_text(judged.p_value), badge(judged.verdict));
  }
  return out + "</tbody></table></div></details>";
}

std::string claim_html(const JudgedClaim& claim, const std::string& prefix) {
  const ClaimSpec& spec = claim.spec;
  std::string out = fmt::format(
      "<div class=\"claim {0}\" data-verdict=\"{0}\" id=\"{1}-claim-{2}\"><div class=\"head\"><b>{2}</b> {3}</div>"
      "<h3>{4}</h3><dl><dt>measured</dt><dd>{5}</dd>",
      verdict_name(claim.verdict), prefix, escaped(spec.id), badge(claim.verdict), escaped(spec.text),
      escaped(claim.measured));
  if (!spec.published.empty()) out += fmt::format("<dt>published</dt><dd>{}</dd>", escaped(spec.published));
  if (!spec.note.empty()) out += fmt::format("<dt>note</dt><dd>{}</dd>", escaped(spec.note));
  return out + "</dl>" + cells_table(claim) + "</div>\n";
}

}  // namespace

std::string claims_section(const StudyResult& result, const std::string& prefix) {
  if (result.claims.empty()) return "";
  std::string out = fmt::format("<section id=\"{}-claims\"><h2>Claims</h2>\n{}", prefix, tally(result.claims));
  for (const JudgedClaim& claim : result.claims) out += claim_html(claim, prefix);
  return out + "</section>\n";
}

}  // namespace boxwood::html
