// `boxwood report`: what a store of measurements says, as one HTML page.
#include <fmt/format.h>

#include <memory>

#include "boxwood/error.h"
#include "command.h"
#include "console.h"
#include "exit_code.h"
#include "files/output_file.h"
#include "report/html/html_report.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

struct ReportOptions {
  std::string store, output = "report.html";
  bool force = false;
};

int run_report(const ReportOptions& options) {
  check_can_write(options.output, options.force);
  const std::vector<StudyResult> results = evaluate_all(Store(options.store, Store::Mode::read));
  if (results.empty()) {
    throw Error(fmt::format("{} has no measurements of a study; 'boxwood study' makes some", options.store));
  }
  OutputFile out(options.output);
  out.write(html_report(results));
  out.commit();
  print(fmt::format("The report is {}.\n", options.output));
  return exit_done;
}

}  // namespace

void add_report(CommandSet& commands) {
  const auto options = std::make_shared<ReportOptions>();
  Command command = commands.add("report", "Write what studies found out as one HTML page that needs nothing else",
                                 [options] { return run_report(*options); });
  command.argument("STORE", options->store, "A file that 'boxwood study' wrote, such as study-wide-bvh/store.sqlite");
  command.text("-o,--output", options->output, "FILE", "The page");
  command.flag("--force", options->force, "Replace the file if there is one");
}

}  // namespace boxwood::cli
