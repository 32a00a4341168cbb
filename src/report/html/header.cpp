// What was studied, on what, and how to do it again.
#include <fmt/format.h>

#include "options/options.h"
#include "report/html/markup.h"
#include "report/html/sections.h"
#include "report/number_text.h"

namespace boxwood::html {
namespace {

std::string fact(std::string_view name, const std::string& value) {
  return value.empty() ? "" : fmt::format("<dt>{}</dt><dd>{}</dd>", name, escaped(value));
}

std::string machine_facts(const Environment& e) {
  return fact("machine", fmt::format("{}, {}, {}", e.cpu, counted(e.threads, "thread"), bytes_text(e.memory_bytes))) +
         fact("system", e.system) + fact("compiler", fmt::format("{}; {}", e.compiler, e.flags)) +
         fact("commit", e.commit) + fact("Embree", e.embree);
}

std::string run_facts(const StudyResult& result) {
  const RunSpec& run = result.study.run;
  std::string out =
      fact("rays", fmt::format("{}; {} × {} pixels", option_text::join(run.rays, ", "), run.width, run.height));
  out += fact("timings", fmt::format("{} of rays, {} of builds, interleaved, on {}", run.repetitions, run.builds,
                                     counted(run.threads, "thread")));
  out += fact("figures", fmt::format("{} with 95 % intervals", run.centre));
  out += fact("measurements", fmt::format("{}; {} far off the others of their kind, none left out",
                                          grouped(result.measurements), counted(result.outliers, "sample")));
  return out;
}

std::string scenes_table(const std::vector<SceneFacts>& scenes) {
  std::string out =
      "<div class=\"wide\"><table><thead><tr><th>scene</th><th class=\"n\">triangles</th><th>from</th>"
      "</tr></thead><tbody>";
  for (const SceneFacts& scene : scenes) {
    out += fmt::format("<tr><th>{}</th><td class=\"n\">{}</td><td>{}{}</td></tr>", escaped(scene.name),
                       grouped(scene.triangles), escaped(scene.source),
                       scene.stand_in ? " <em>(stands in for a file that was not there)</em>" : "");
  }
  return out + "</tbody></table></div>\n";
}

/// The study file travels in the page.
std::string repeat_box(const StudyResult& result) {
  const Study& study = result.study;
  const std::string file = study.name + ".toml";
  const auto bytes = std::span(reinterpret_cast<const unsigned char*>(study.file_text.data()), study.file_text.size());
  return fmt::format(
      "<div class=\"repeat\"><p>To repeat it, <a download=\"{0}\" href=\"{1}\">save {0}</a> and run</p>"
      "<pre>git checkout {2} &amp;&amp; make build\n"
      "build/boxwood study {0}{3} --out study-{4}\n"
      "build/boxwood report study-{4}/store.sqlite -o report.html</pre></div>\n",
      escaped(file), data_uri("text/plain;charset=utf-8", bytes), escaped(result.environment.commit),
      study.quick ? " --quick" : "", escaped(study.name));
}

std::string paragraphs(const std::string& text) {
  return text.empty() ? "" : fmt::format("<p class=\"text\">{}</p>\n", escaped(text));
}

}  // namespace

std::string study_header(const StudyResult& result) {
  const Study& study = result.study;
  std::string out = fmt::format("<header>\n<h1>{}{}</h1>\n", escaped(study.title),
                                study.quick ? " <span class=\"tag\">quick version</span>" : "");
  if (!study.source.empty()) out += fmt::format("<p class=\"source\">After {}</p>\n", escaped(study.source));
  out += paragraphs(study.text);
  out += fmt::format("<div class=\"facts\"><dl>{}</dl><dl>{}</dl></div>\n", run_facts(result),
                     machine_facts(result.environment));
  return out + scenes_table(result.scenes) + repeat_box(result) + "</header>\n";
}

std::string recipes_section(const StudyResult& result, const std::string& prefix) {
  if (result.study.recipes.empty()) return "";
  std::string out = fmt::format(
      "<section id=\"{}-recipes\"><h2>Recipes</h2><details><summary>{}</summary>"
      "<div class=\"wide\"><table class=\"sortable\"><thead><tr><th>label</th><th>recipe</th>"
      "</tr></thead><tbody>",
      prefix, counted(result.study.recipes.size(), "recipe"));
  for (const RecipeSpec& recipe : result.study.recipes) {
    out += fmt::format("<tr><th>{}</th><td><code>{}</code></td></tr>", escaped(recipe.label), escaped(recipe.text));
  }
  return out + "</tbody></table></div></details></section>\n";
}

}  // namespace boxwood::html
