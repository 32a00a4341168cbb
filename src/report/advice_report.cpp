#include "report/advice_report.h"

#include <fmt/format.h>

#include "report/number_text.h"
#include "report/table.h"

namespace boxwood {
namespace {

Estimate speed_of(const AdviceRow& row) {
  const std::uint64_t n = row.measured.rays.empty() ? 0 : row.measured.rays.front().mrays_per_s.n;
  return {row.mrays_per_s, row.low, row.high, n};
}

std::string rounds_text(const Advice& advice) {
  Table table({{"round"}, {"triangles"}, {"rays"}, {"tried"}, {"refused"}, {"not reached"}, {"kept"}, {"time"}});
  std::size_t number = 0;
  for (const AdviceRound& round : advice.rounds) {
    table.add({std::to_string(++number), grouped(round.triangles), grouped(round.rays), grouped(round.tried),
               grouped(round.refused), grouped(round.not_reached), grouped(round.kept), duration_text(round.seconds)});
  }
  std::string out = table.text();
  if (advice.thin_correlation) {
    out += fmt::format(
        "\nThe thinned scene orders recipes as the whole one with a rank correlation of {:.2f}, so it was {}.\n",
        *advice.thin_correlation, advice.thin_used ? "tried first" : "not used");
  }
  return out;
}

std::string front_text(const Advice& advice) {
  Table table({{"", Align::left}, {"recipe", Align::left}, {"Mrays/s"}, {"build ms"}, {"memory"}});
  for (std::size_t i = 0; i < advice.rows.size(); ++i) {
    const AdviceRow& row = advice.rows[i];
    const char* mark = i == advice.recommended ? "→" : row.on_front ? "·" : "";
    table.add({mark, row.measured.recipe, with_interval(speed_of(row)), with_interval(row.measured.build_ms),
               bytes_text(row.measured.bytes)});
  }
  return fmt::format(
      "{}→ recommended, · on the Pareto front: nothing measured beats it in speed, build time and memory "
      "at once.\n",
      table.text());
}

std::string reason_text(const Advice& advice) {
  Table table({{"why", Align::left}, {"recommended"}, {"default"}});
  const auto add = [&](const char* name, double AdviceReason::*member) {
    if (advice.why.*member == 0 && advice.reference_why.*member == 0) return;
    table.add({name, significant(advice.why.*member), significant(advice.reference_why.*member)});
  };
  add("node tests per ray", &AdviceReason::node_tests_per_ray);
  add("triangle tests per ray", &AdviceReason::primitive_tests_per_ray);
  add("surface area cost", &AdviceReason::sah);
  add("end-point overlap", &AdviceReason::epo);
  return fmt::format("{}{:.0f} % of the rays that ask whether anything is in the way are blocked.\n", table.text(),
                     100 * advice.blocked_share);
}

std::string snippet(const Advice& advice, const std::string& scene) {
  return fmt::format(
      "  boxwood::Scene scene = boxwood::load(\"{}\");\n"
      "  boxwood::Structure structure = boxwood::build(scene, \"{}\");\n",
      scene, advice.rows[advice.recommended].measured.recipe);
}

Json reason_json(const AdviceReason& reason) {
  return {{"node_tests_per_ray", reason.node_tests_per_ray},
          {"primitive_tests_per_ray", reason.primitive_tests_per_ray},
          {"sah_cost", reason.sah},
          {"epo", reason.epo}};
}

}  // namespace

std::string advice_text(const Advice& advice, const std::string& scene) {
  std::string out = fmt::format("{}: {}, {}\n\n{}\n{}\n{}", advice.scene, counted(advice.triangles, "triangle"),
                                counted(advice.candidates, "candidate"), rounds_text(advice), front_text(advice),
                                reason_text(advice));
  for (const std::string& note : advice.notes) out += fmt::format("Different answers: {}\n", note);
  out += fmt::format("\nUse it:\n\n{}", snippet(advice, scene));
  if (advice.interrupted) out += "\nInterrupted: this is the best of what was tried until then.\n";
  return out;
}

Json to_json(const Advice& advice) {
  Json rounds = Json::array(), rows = Json::array();
  for (const AdviceRound& round : advice.rounds) {
    rounds.push_back({{"triangles", round.triangles},
                      {"rays", round.rays},
                      {"tried", round.tried},
                      {"refused", round.refused},
                      {"not_reached", round.not_reached},
                      {"kept", round.kept},
                      {"seconds", round.seconds}});
  }
  for (const AdviceRow& row : advice.rows) {
    rows.push_back({{"recipe", row.measured.recipe},
                    {"mrays_per_s", to_json(speed_of(row))},
                    {"build_ms", to_json(row.measured.build_ms)},
                    {"bytes", row.measured.bytes},
                    {"on_front", row.on_front}});
  }
  return {{"scene", advice.scene},
          {"triangles", advice.triangles},
          {"candidates", advice.candidates},
          {"rounds", std::move(rounds)},
          {"thin_correlation", advice.thin_correlation ? Json(*advice.thin_correlation) : Json()},
          {"thin_used", advice.thin_used},
          {"recommended", advice.rows[advice.recommended].measured.recipe},
          {"rows", std::move(rows)},
          {"why", reason_json(advice.why)},
          {"default_why", reason_json(advice.reference_why)},
          {"blocked_share", advice.blocked_share},
          {"notes", advice.notes},
          {"interrupted", advice.interrupted}};
}

}  // namespace boxwood
