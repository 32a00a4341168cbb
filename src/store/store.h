#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "store/environment.h"

namespace boxwood {

/// What was measured: everything needed to do it again. Equal subjects are the same measurement.
struct Subject {
  std::string study;         ///< name of the study, or "" for none
  std::string scene;         ///< the study's name for it
  std::string scene_source;  ///< file name or generator that it came from
  std::uint64_t scene_hash = 0;
  std::uint64_t triangles = 0;  ///< placed
  std::string view;             ///< name of the camera; "" when the measurement is of a structure alone
  std::string camera;           ///< JSON: eye, direction, up, fov; "" likewise
  std::uint32_t width = 0, height = 0;
  std::string rays;    ///< ray kind; "" likewise
  std::string recipe;  ///< canonical text
  std::string probe;
  std::uint64_t seed = 0;
  std::uint32_t repetition = 0;
  std::uint32_t threads = 1;

  /// One line of text that differs exactly when subjects do.
  std::string key() const;
};

struct StoredValue {
  std::string metric, unit;
  double value = 0;
};

struct Measurement {
  Subject subject;
  std::vector<StoredValue> values;
  std::string time;              ///< UTC, "2026-02-28T12:34:56Z"; set by the store
  std::int64_t environment = 0;  ///< number of the environment; set by the store
};

/// What to read; empty fields match everything.
struct StoreFilter {
  std::string study = {}, scene = {}, rays = {}, metric = {}, probe = {};
  std::string recipe = {};  ///< part of the text
  std::optional<std::int64_t> environment = {};
};

/// A study that left its measurements in a store.
struct StoredStudy {
  std::string name, text;  ///< text: the study file as it was
};

/// A picture that belongs to a study, kept with its figures.
struct StoredPicture {
  std::string study, scene, view, recipe;
  std::string kind;  ///< "rendering", "heatmap", "primitive tests"
  std::vector<unsigned char> png;
};

/// Measurements in one SQLite file. Each is a transaction of its own: once add() returns it survives the death of the
/// process. Several processes may add at once; they wait for each other for up to a minute. All members throw Error
/// naming the file and the cause.
class Store {
 public:
  enum class Mode { create_or_add, read };

  Store(const std::filesystem::path& file, Mode mode);
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  /// The number of `environment`, added when it is new.
  std::int64_t environment_number(const Environment& environment);
  Environment environment(std::int64_t number) const;
  std::vector<std::int64_t> environments() const;

  /// Adds a measurement, its values and the time. Does nothing when the same subject was measured in the same
  /// environment before, by this or another process; says whether it was added.
  bool add(const Subject& subject, std::span<const StoredValue> values, std::int64_t environment);
  /// Keys of all subjects measured in `environment`.
  std::set<std::string> keys(const std::string& study, std::int64_t environment) const;
  /// In the order in which they were added. With `metric` set, measurements carry only that value.
  std::vector<Measurement> measurements(const StoreFilter& filter = {}) const;

  void keep_study(const StoredStudy& study);
  std::vector<StoredStudy> studies() const;
  void keep_picture(const StoredPicture& picture);
  std::vector<StoredPicture> pictures(const std::string& study) const;

 private:
  struct Database;
  std::unique_ptr<Database> database_;
};

}  // namespace boxwood
