// Running a study: everything is measured once, whatever interrupts it.
#include "study/run_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "study/studies.h"
#include "study/study_result.h"
#include "study/view_json.h"

namespace boxwood::testing {
namespace {

const char* const small_study = R"toml(
pictures = ["wide(4)"]
[run]
rays = ["primary", "shadow"]
size = [12, 10]
repetitions = 3
builds = 2
probes = ["build", "size", "tree", "time", "tests", "answers", "image"]
[quick]
repetitions = 1
frames = 2
[[scene]]
name = "ring"
find = ["no-such-file.ply", "generate:torus(detail=8)"]
orbit = { frames = 3 }
[[scene]]
name = "city"
find = ["generate:city(blocks=2)"]
[[recipes]]
label = "{layout}"
recipe = "binned > {layout}"
values = { layout = ["binary", "wide(4)"] }
[[table]]
id = "times"
value = "trace_ms + build_ms"
rows = ["scene"]
columns = ["layout", "rays"]
[[plot]]
id = "plane"
kind = "scatter"
value = "node_tests"
x = "bytes / primitives"
front = ["low", "low"]
series = ["layout"]
panels = ["scene", "rays"]
[[claim]]
id = "A"
text = "both answer alike"
value = "answers_hash"
views = "each"
each = ["scene", "view", "rays"]
same = true
[[claim]]
id = "B"
text = "as many triangles are tested"
value = "primitive_tests"
where = { layout = "wide(4)", rays = "primary" }
baseline = { layout = "binary" }
each = ["scene"]
above = 0.2
)toml";

/// 4 views, 2 ray kinds, 2 recipes: 3 timings, tests, answers, image each; 2 scenes, 2 recipes: 2 builds, size, tree.
constexpr std::size_t all_measurements = 4 * 2 * 2 * (3 + 1 + 1 + 1) + 2 * 2 * (2 + 1 + 1);

TEST(RunStudy, MeasuresEverythingOnce) {
  const TemporaryStore folder;
  Store store = folder.open();
  const Study study = parse_study(small_study, "small.toml");
  std::vector<std::string> notes;
  StudySettings settings;
  settings.note = [&](std::string_view note) { notes.emplace_back(note); };
  const std::int64_t here = run_study(study, store, settings);
  // Pictures are of primary rays only, so shadow rays have no value of that probe.
  const std::size_t found = store.keys("small", here).size();
  EXPECT_EQ(found, all_measurements);
  run_study(study, store, settings);
  EXPECT_EQ(store.keys("small", here).size(), found);
  ASSERT_FALSE(notes.empty());
  EXPECT_NE(notes[0].find("no-such-file.ply"), std::string::npos) << notes[0];

  const StudyResult result = evaluate(study, store, here);
  ASSERT_EQ(result.scenes.size(), 2u);
  EXPECT_TRUE(result.scenes[0].stand_in);
  EXPECT_FALSE(result.scenes[1].stand_in);
  ASSERT_EQ(result.tables[0].cells.size(), 8u);
  for (const Cell& cell : result.tables[0].cells) EXPECT_GT(cell.estimate.low, 0);
  EXPECT_EQ(result.claims[0].verdict, Verdict::holds) << result.claims[0].measured;
  EXPECT_EQ(result.claims[1].verdict, Verdict::holds) << result.claims[1].measured;
  EXPECT_TRUE(result.claims[1].cells[0].cell.exact);
  const PlotResult& plane = result.plots.at(0);
  ASSERT_EQ(plane.cells.size(), 8u);
  ASSERT_EQ(plane.x.size(), 8u);
  std::size_t on_front = 0;
  for (std::size_t i = 0; i < plane.cells.size(); ++i) {
    bool beaten = false;
    for (std::size_t j = 0; j < plane.cells.size(); ++j) {
      const auto panel = [&](std::size_t cell) {
        return std::pair(plane.cells[cell].factors.at("scene"), plane.cells[cell].factors.at("rays"));
      };
      const double dx = plane.x[i].median - plane.x[j].median;
      const double dy = plane.cells[i].estimate.median - plane.cells[j].estimate.median;
      beaten = beaten || (panel(i) == panel(j) && dx >= 0 && dy >= 0 && dx + dy > 0);
    }
    EXPECT_EQ(plane.on_front[i], !beaten) << cell_name(plane.cells[i].factors);
    on_front += plane.on_front[i] ? 1 : 0;
  }
  EXPECT_GE(on_front, 4u);                     // one of each panel at least
  EXPECT_EQ(result.pictures.size(), 2u * 3u);  // of each scene a rendering, a heat map, and primitive tests alone
  for (const StoredPicture& picture : result.pictures) EXPECT_EQ(picture.png.at(1), 'P');

  const std::vector<StudyResult> stored = evaluate_all(store);
  ASSERT_EQ(stored.size(), 1u);
  EXPECT_EQ(stored[0].study.name, "small");
  EXPECT_EQ(stored[0].claims[1].measured, result.claims[1].measured);
}

TEST(RunStudy, Quick_IsKeptApart) {
  const TemporaryStore folder;
  Store store = folder.open();
  const Study quick = parse_study(small_study, "small.toml", true);
  const std::int64_t here = run_study(quick, store, {});
  EXPECT_EQ(store.keys("small", here).size(), 0u);
  EXPECT_EQ(store.keys("small (quick)", here).size(), 3 * 2 * 2 * (1 + 1 + 1 + 1) + 2 * 2 * (2 + 1 + 1));
}

/// Stops after a number of reports.
class StopAfter final : public ProgressSink {
 public:
  explicit StopAfter(int reports) : left_(reports) {}
  bool report(double fraction, std::string_view) override {
    EXPECT_GE(fraction, last_);
    EXPECT_LE(fraction, 1);
    last_ = fraction;
    return left_-- > 0;
  }

 private:
  int left_;
  double last_ = 0;
};

TEST(RunStudy, StoppedAnywhere_GoesOnWhereItWas) {
  const Study study = parse_study(small_study, "small.toml");
  const TemporaryStore folder;
  Store store = folder.open();
  int rounds = 0;
  for (;; ++rounds) {
    ASSERT_LT(rounds, 100);
    StopAfter stop(25 * (rounds + 1));
    try {
      run_study(study, store, {}, &stop);
      break;
    } catch (const Cancelled&) {
    }
  }
  EXPECT_GT(rounds, 1);
  const std::int64_t here = store.environment_number(this_environment());
  EXPECT_EQ(store.keys("small", here).size(), all_measurements);
}

/// Keeps what was reported.
class Reports final : public ProgressSink {
 public:
  bool report(double fraction, std::string_view) override {
    fractions.push_back(fraction);
    return true;
  }
  std::vector<double> fractions;
};

TEST(RunStudy, GoingOn_ReportsTheShareOfWhatIsLeftToDo) {
  const Study study = parse_study(small_study, "small.toml");
  const TemporaryStore folder;
  Store store = folder.open();
  StopAfter stop(all_measurements - 20);
  EXPECT_THROW(run_study(study, store, {}, &stop), Cancelled);
  Reports rest;
  run_study(study, store, {}, &rest);
  EXPECT_LT(rest.fractions.size(), 40u);  // what was measured is passed over in silence
  EXPECT_TRUE(std::ranges::is_sorted(rest.fractions));
  EXPECT_EQ(rest.fractions.front(), 0);
  EXPECT_EQ(rest.fractions.back(), 1);
  Reports nothing;
  run_study(study, store, {}, &nothing);
  EXPECT_LE(nothing.fractions.size(), 2u);  // the scenes are looked at
}

TEST(RunStudy, OnASceneThatIsNowhere_NamesWhatWasTried) {
  const std::string text =
      "[[scene]]\nname = \"x\"\nfind = [\"a.ply\", \"b.ply\"]\n[[recipes]]\nrecipe = \"binned > binary\"";
  const TemporaryStore folder;
  Store store = folder.open();
  try {
    run_study(parse_study(text, "x.toml"), store, {});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("a.ply, b.ply"), std::string::npos) << error.what();
  }
}

TEST(ViewText, TellsCamerasAndSettingsApart) {
  Camera camera;
  camera.eye = {0.1f, 1e-7f, 3e8f};
  Camera other = camera;
  EXPECT_EQ(view_json(camera, "{}"), view_json(other, "{}"));
  other.eye.x = std::nextafter(other.eye.x, 1.0f);
  EXPECT_NE(view_json(camera, "{}"), view_json(other, "{}"));

  RunSpec run;
  run.ao_radius = 5;
  const std::string settings = ray_settings_json(run, {});
  EXPECT_TRUE(has_ray_settings(view_json(camera, settings), settings));
  EXPECT_FALSE(has_ray_settings(view_json(camera, "{}"), settings));
  EXPECT_FALSE(has_ray_settings(view_json(camera, settings), "{}"));
}

}  // namespace
}  // namespace boxwood::testing
