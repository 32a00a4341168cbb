// The page around the sections.
#include <fmt/format.h>

#include "report/html/html_report.h"
#include "report/html/markup.h"
#include "report/html/sections.h"

namespace boxwood {

namespace embedded {
extern const char* const page_style;
extern const char* const page_script;
}  // namespace embedded

namespace html {
namespace {

std::string study_html(const StudyResult& result, const std::string& prefix) {
  return fmt::format("<article id=\"{}\">\n{}{}{}{}{}{}</article>\n", prefix, study_header(result),
                     claims_section(result, prefix), plots_section(result, prefix), tables_section(result, prefix),
                     pictures_section(result, prefix), recipes_section(result, prefix));
}

/// Links to the studies, or to the sections of the only one.
std::string navigation(std::span<const StudyResult> results) {
  std::string out = "<nav>";
  if (results.size() == 1) {
    for (const char* name : {"claims", "plots", "tables", "pictures", "recipes"}) {
      out += fmt::format("<a href=\"#s0-{0}\">{0}</a>", name);
    }
  } else {
    for (std::size_t i = 0; i < results.size(); ++i) {
      out += fmt::format("<a href=\"#s{}\">{}</a>", i, escaped(results[i].study.name));
    }
  }
  return out + "</nav>\n";
}

}  // namespace
}  // namespace html

std::string html_report(std::span<const StudyResult> results) {
  std::string body = html::navigation(results);
  for (std::size_t i = 0; i < results.size(); ++i) body += html::study_html(results[i], fmt::format("s{}", i));
  const std::string title = results.size() == 1 ? results.front().study.title : "Boxwood studies";
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
      "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n{}"
      "<footer>Made by boxwood report. Everything is in this file.</footer>\n<script>\n{}</script>\n</body>\n</html>\n",
      html::escaped(title), embedded::page_style, body, embedded::page_script);
}

}  // namespace boxwood
