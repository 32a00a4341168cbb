// Studies from the command line: a user's own, stopped ones, and what their stores say afterwards.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>

#include "cli/program.h"

namespace boxwood::testing {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

const fs::path sources = BOXWOOD_SOURCE_DIR;

/// A study that takes long enough to be stopped, and not much longer.
const std::string long_study = R"toml(
run = { size = [64, 64], repetitions = 400, probes = ["time", "answers"] }
[[scene]]
name = "knot"
find = ["generate:knot(detail=24)"]
[[recipes]]
label = "{k}"
recipe = "binned > wide({k})"
values = { k = [4, 8] }
[[claim]]
id = "A"
text = "alike"
value = "answers_hash"
each = ["scene"]
same = true
)toml";
constexpr std::size_t long_values = 2 * (400 + 3);

std::size_t values_in(const fs::path& folder) {
  const Outcome outcome = run_boxwood({"results", (folder / "out/store.sqlite").string(), "--csv"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return static_cast<std::size_t>(std::ranges::count(outcome.out, '\n')) - 1;
}

TEST(Study, WorkedExample_IsTheOneInTheDocumentation) {
  const std::string example = read_file(sources / "examples/width.toml");
  ASSERT_FALSE(example.empty());
  EXPECT_NE(read_file(sources / "docs/studies.md").find(example), std::string::npos);
}

TEST(Study, WorkedExample_GivesTablesAndVerdicts) {
  const TemporaryFolder folder;
  const std::vector<std::string> command = {"study", (sources / "examples/width.toml").string(), "--quick", "--json"};
  const Outcome outcome = run_boxwood(command, {.folder = folder.path()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("my-mesh.ply"), std::string::npos) << outcome.err;  // says that a scene stands in
  const json document = json::parse(outcome.out);
  EXPECT_EQ(document.at("study"), "width");
  ASSERT_EQ(document.at("claims").size(), 2u);
  const std::set<std::string> verdicts = {"holds", "does-not-hold", "inconclusive"};
  for (const json& claim : document["claims"]) {
    EXPECT_TRUE(verdicts.contains(claim.at("verdict"))) << claim;
    EXPECT_TRUE(claim.at("text").is_string() && claim.at("measured").is_string() && claim.at("published").is_string());
    EXPECT_EQ(claim.at("cells").size(), 2u);
  }
  EXPECT_EQ(document["claims"][1]["verdict"], "holds") << document["claims"][1];
  EXPECT_TRUE(document.at("scenes")[0].at("stand_in"));
  EXPECT_FALSE(document.at("environment").at("cpu").get<std::string>().empty());

  const fs::path out = folder.path() / "study-width";
  EXPECT_EQ(json::parse(read_file(out / "result.json")), document);
  EXPECT_TRUE(read_file(out / "claims.csv").starts_with("id,verdict,measured,published,text\nwider,"));
  const std::string table = read_file(out / "tables/times.csv");
  EXPECT_TRUE(table.starts_with("k,rays,figure,median,low,high,mean,n,members\n4,primary,trace_ms,")) << table;
  EXPECT_EQ(std::ranges::count(table, '\n'), 1 + 3 * 2);
}

TEST(Study, ByName_IsFoundBesideTheProgram) {
  const Outcome outcome = run_boxwood({"study", "wide-bhv"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("did you mean 'wide-bvh'"), std::string::npos) << outcome.err;
}

TEST(Study, OverOldMeasurements_NeedsResume) {
  const TemporaryFolder folder;
  const std::string file = (sources / "examples/width.toml").string();
  ASSERT_EQ(run_boxwood({"study", file, "--quick", "--out", "out"}, {.folder = folder.path()}).exit_code, 0);
  const std::size_t values = values_in(folder.path());
  const Outcome refused = run_boxwood({"study", file, "--quick", "--out", "out"}, {.folder = folder.path()});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("--resume"), std::string::npos) << refused.err;
  EXPECT_EQ(run_boxwood({"study", file, "--quick", "--out", "out", "--resume"}, {.folder = folder.path()}).exit_code,
            0);
  EXPECT_EQ(values_in(folder.path()), values);
}

TEST(Study, InterruptedOrKilled_GoesOnWhereItWas) {
  const TemporaryFolder folder;
  write_file(folder.path() / "long.toml", long_study);
  std::vector<std::string> command = {"study", "long.toml", "--out", "out"};
  const Outcome killed = run_boxwood(command, {.folder = folder.path(), .interrupt_after_ms = 300, .kill = true});
  EXPECT_EQ(killed.exit_code, -9) << "the study was too short to be killed";
  command.push_back("--resume");
  const Outcome stopped = run_boxwood(command, {.folder = folder.path(), .interrupt_after_ms = 300});
  if (stopped.exit_code != 0) {
    EXPECT_EQ(stopped.exit_code, 130) << stopped.err;
    EXPECT_NE(stopped.err.find("--resume"), std::string::npos) << stopped.err;
  }
  const Outcome outcome = run_boxwood(command, {.folder = folder.path()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("holds"), std::string::npos) << outcome.out;
  EXPECT_EQ(values_in(folder.path()), long_values);
}

TEST(Study, WithAMistake_NamesFileAndLine) {
  const TemporaryFolder folder;
  write_file(folder.path() / "bad.toml", "title = 'x'\n[run]\nrepetition = 3\n");
  const Outcome outcome = run_boxwood({"study", "bad.toml"}, {.folder = folder.path()});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("bad.toml"), std::string::npos) << outcome.err;
  EXPECT_TRUE(fs::exists(folder.path() / "bad.toml"));
  EXPECT_FALSE(fs::exists(folder.path() / "study-bad")) << "nothing is made for a study that cannot run";
}

class Results : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    const Outcome outcome = run_boxwood(
        {"study", (sources / "examples/width.toml").string(), "--quick", "--out", "out"}, {.folder = folder_->path()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::string store() { return (folder_->path() / "out/store.sqlite").string(); }

  static inline std::unique_ptr<TemporaryFolder> folder_;
};

TEST_F(Results, AreListedAndFiltered) {
  const Outcome all = run_boxwood({"results", store()});
  EXPECT_EQ(all.exit_code, 0) << all.err;
  for (const char* part : {"trace_ms", "build_ms", "answers_hash", "wide(8)", "commit"}) {
    EXPECT_NE(all.out.find(part), std::string::npos) << part;
  }
  const json some = run_for_json({"results", store(), "--metric", "trace_ms", "--recipe", "wide(8)", "--rays", "ao"});
  ASSERT_EQ(some.at("series").size(), 1u) << some;
  const json& series = some["series"][0];
  EXPECT_EQ(series.at("metric"), "trace_ms");
  EXPECT_EQ(series.at("unit"), "ms");
  EXPECT_EQ(series.at("samples").size(), 3u);
  EXPECT_EQ(series.at("value").at("n"), 3);
}

TEST_F(Results, HeldAgainstThemselves_ShowNoChange) {
  const json document = run_for_json({"results", store(), "--compare", store()});
  ASSERT_FALSE(document.at("changes").empty());
  for (const json& change : document["changes"]) EXPECT_FALSE(change.at("changed")) << change;
  const Outcome text = run_boxwood({"results", store(), "--compare", store()});
  EXPECT_TRUE(text.out.starts_with("0 of ")) << text.out;
}

TEST_F(Results, OfWhatIsNoStore_AreAnError) {
  write_file(folder_->path() / "text", "not a database, but long enough to look at: sixteen bytes and some more");
  for (const char* file : {"text", "nothing"}) {
    const Outcome outcome = run_boxwood({"results", file}, {.folder = folder_->path()});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find(file), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace boxwood::testing
