// Measurements survive: the death of the process, other processes, another machine's figures.
#include "store/store.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <fstream>

#include "boxwood/error.h"

namespace boxwood::testing {
namespace {

namespace fs = std::filesystem;

class StoreTest : public ::testing::Test {
 protected:
  StoreTest() {
    std::string name = (fs::temp_directory_path() / "boxwood-store-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    file_ = folder_ / "store.sqlite";
  }
  ~StoreTest() override { fs::remove_all(folder_); }

  fs::path folder_, file_;
};

Subject subject(std::uint32_t repetition, const std::string& recipe = "median > binary") {
  Subject s;
  s.study = "test";
  s.scene = "cube";
  s.scene_source = "generate:cube";
  s.scene_hash = 0xfedcba9876543210u;
  s.triangles = 12;
  s.view = "auto";
  s.camera = "{}";
  s.width = s.height = 64;
  s.rays = "primary";
  s.recipe = recipe;
  s.probe = "time";
  s.seed = 1;
  s.repetition = repetition;
  return s;
}

Environment machine(const std::string& cpu) {
  Environment e = this_environment();
  e.cpu = cpu;
  return e;
}

std::vector<StoredValue> values(double x) { return {{"trace_ms", "ms", x}, {"rays", "rays", 4096}}; }

TEST_F(StoreTest, WhatIsAdded_IsReadBackWhole) {
  Store store(file_, Store::Mode::create_or_add);
  const std::int64_t here = store.environment_number(this_environment());
  const Subject what = subject(3);
  ASSERT_TRUE(store.add(what, values(0.1), here));
  const std::vector<Measurement> all = Store(file_, Store::Mode::read).measurements();
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].subject.key(), what.key());
  EXPECT_EQ(all[0].subject.scene_hash, what.scene_hash);
  EXPECT_EQ(all[0].subject.scene_source, what.scene_source);
  EXPECT_EQ(all[0].environment, here);
  EXPECT_EQ(all[0].time.size(), std::string("2026-02-28T12:34:56Z").size());
  ASSERT_EQ(all[0].values.size(), 2u);
  EXPECT_EQ(all[0].values[1].metric, "trace_ms");
  EXPECT_EQ(all[0].values[1].unit, "ms");
  EXPECT_EQ(all[0].values[1].value, 0.1);
  EXPECT_EQ(store.environment(here), this_environment());
}

TEST_F(StoreTest, TheSameSubject_IsKeptOncePerEnvironment) {
  Store store(file_, Store::Mode::create_or_add);
  const std::int64_t here = store.environment_number(machine("A")), there = store.environment_number(machine("B"));
  EXPECT_NE(here, there);
  EXPECT_EQ(here, store.environment_number(machine("A")));
  EXPECT_TRUE(store.add(subject(0), values(1), here));
  EXPECT_FALSE(store.add(subject(0), values(2), here));
  EXPECT_TRUE(store.add(subject(0), values(3), there));
  EXPECT_TRUE(store.add(subject(1), values(4), here));
  EXPECT_EQ(store.measurements({.environment = here}).size(), 2u);
  EXPECT_EQ(store.measurements({.environment = here})[0].values.back().value, 1);
  EXPECT_EQ(store.keys("test", here), (std::set<std::string>{subject(0).key(), subject(1).key()}));
}

TEST(SubjectKey, DiffersWheneverAPartDoes) {
  std::vector<Subject> all(14, subject(0));
  all[1].study = "x";
  all[2].scene = "x";
  all[3].scene_hash = 1;
  all[4].view = "x";
  all[5].camera = "x";
  all[6].width = 1;
  all[7].height = 1;
  all[8].rays = "x";
  all[9].recipe = "x";
  all[10].probe = "x";
  all[11].seed = 9;
  all[12].repetition = 9;
  all[13].threads = 9;
  std::set<std::string> keys;
  for (const Subject& s : all) keys.insert(s.key());
  EXPECT_EQ(keys.size(), all.size());
}

TEST_F(StoreTest, Filters_PickWhatTheySay) {
  Store store(file_, Store::Mode::create_or_add);
  const std::int64_t here = store.environment_number(this_environment());
  store.add(subject(0, "median > binary"), values(1), here);
  store.add(subject(0, "binned > wide(8)"), values(2), here);
  EXPECT_EQ(store.measurements({.recipe = "wide"}).size(), 1u);
  EXPECT_EQ(store.measurements({.scene = "sphere"}).size(), 0u);
  const std::vector<Measurement> times = store.measurements({.metric = "trace_ms"});
  ASSERT_EQ(times.size(), 2u);
  EXPECT_EQ(times[0].values.size(), 1u);
}

TEST_F(StoreTest, StudiesAndPictures_AreReplacedByName) {
  Store store(file_, Store::Mode::create_or_add);
  store.keep_study({"a", "old"});
  store.keep_study({"a", "new"});
  store.keep_picture({"a", "cube", "auto", "", "rendering", {1, 2}});
  store.keep_picture({"a", "cube", "auto", "", "rendering", {0, 3}});
  ASSERT_EQ(store.studies().size(), 1u);
  EXPECT_EQ(store.studies()[0].text, "new");
  ASSERT_EQ(store.pictures("a").size(), 1u);
  EXPECT_EQ(store.pictures("a")[0].png, (std::vector<unsigned char>{0, 3}));
}

TEST_F(StoreTest, SeveralProcessesAtOnce_LoseNothing) {
  constexpr std::uint32_t each = 40;
  std::vector<pid_t> children;
  for (int p = 0; p < 3; ++p) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      int failed = 0;
      try {
        Store store(file_, Store::Mode::create_or_add);
        const std::int64_t here = store.environment_number(machine("A"));
        for (std::uint32_t i = 0; i < each; ++i) store.add(subject(i, "recipe " + std::to_string(p)), values(i), here);
      } catch (const Error&) {
        failed = 1;
      }
      _exit(failed);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(Store(file_, Store::Mode::read).measurements().size(), 3 * each);
}

/// Adds repetitions until killed, and writes a byte into `pipe` after each that add() said was safe.
[[noreturn]] void add_for_ever(const fs::path& file, int pipe) {
  Store store(file, Store::Mode::create_or_add);
  const std::int64_t here = store.environment_number(machine("A"));
  for (std::uint32_t i = 0;; ++i) {
    store.add(subject(i), values(i), here);
    if (write(pipe, "x", 1) != 1) _exit(1);
  }
}

TEST_F(StoreTest, KilledInTheMiddle_LosesAtMostTheMeasurementInFlight) {
  for (int round = 0; round < 3; ++round) {
    fs::remove(file_);
    std::array<int, 2> pipe_ends{};
    ASSERT_EQ(pipe(pipe_ends.data()), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) add_for_ever(file_, pipe_ends[1]);
    close(pipe_ends[1]);
    std::uint32_t confirmed = 0;
    std::array<char, 1> byte{};
    while (confirmed < 50u + 17u * round && read(pipe_ends[0], byte.data(), 1) == 1) ++confirmed;
    kill(child, SIGKILL);
    while (read(pipe_ends[0], byte.data(), 1) == 1) ++confirmed;
    close(pipe_ends[0]);
    waitpid(child, nullptr, 0);

    const std::vector<Measurement> kept = Store(file_, Store::Mode::create_or_add).measurements();
    EXPECT_GE(kept.size(), confirmed);
    EXPECT_LE(kept.size(), confirmed + 1);
    for (std::uint32_t i = 0; i < kept.size(); ++i) {
      EXPECT_EQ(kept[i].subject.repetition, i);
      EXPECT_EQ(kept[i].values.size(), 2u) << "half a measurement was kept";
    }
  }
}

TEST_F(StoreTest, WhatIsNoStore_IsRefusedByName) {
  EXPECT_THROW(Store(folder_ / "none.sqlite", Store::Mode::read), Error);
  std::ofstream(file_) << "this is a text that is long enough not to be taken for an empty database file by anyone";
  for (const Store::Mode mode : {Store::Mode::read, Store::Mode::create_or_add}) {
    try {
      Store store(file_, mode);
      ADD_FAILURE() << "was opened";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("store.sqlite"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace boxwood::testing
