#include "store/store.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>

#include "boxwood/error.h"
#include "store/database.h"

namespace boxwood {
namespace {

constexpr int patience_ms = 60'000;
constexpr std::int64_t format_version = 1;

/// A measurement's key is unique within its environment; values go with it.
constexpr const char* schema = R"(
CREATE TABLE IF NOT EXISTS environment (
  id INTEGER PRIMARY KEY, cpu TEXT, threads INTEGER, memory_bytes INTEGER, system TEXT, compiler TEXT, flags TEXT,
  "commit" TEXT, embree TEXT,
  UNIQUE (cpu, threads, memory_bytes, system, compiler, flags, "commit", embree));
CREATE TABLE IF NOT EXISTS measurement (
  id INTEGER PRIMARY KEY, environment INTEGER NOT NULL REFERENCES environment, key TEXT NOT NULL, time TEXT,
  study TEXT, scene TEXT, scene_source TEXT, scene_hash TEXT, triangles INTEGER, view TEXT, camera TEXT, width INTEGER,
  height INTEGER, rays TEXT, recipe TEXT, probe TEXT, seed INTEGER, repetition INTEGER, threads INTEGER,
  UNIQUE (environment, key));
CREATE TABLE IF NOT EXISTS value (
  measurement INTEGER NOT NULL REFERENCES measurement, metric TEXT NOT NULL, unit TEXT, value REAL,
  PRIMARY KEY (measurement, metric)) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS study (name TEXT PRIMARY KEY, text TEXT);
CREATE TABLE IF NOT EXISTS picture (
  study TEXT, scene TEXT, view TEXT, recipe TEXT, kind TEXT, png BLOB,
  PRIMARY KEY (study, scene, view, recipe, kind)) WITHOUT ROWID;
)";

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

Measurement read_measurement(Statement& row) {
  Measurement m;
  m.environment = row.integer();
  m.time = row.text();
  m.subject.study = row.text();
  m.subject.scene = row.text();
  m.subject.scene_source = row.text();
  m.subject.scene_hash = std::strtoull(row.text().c_str(), nullptr, 16);
  m.subject.triangles = static_cast<std::uint64_t>(row.integer());
  m.subject.view = row.text();
  m.subject.camera = row.text();
  m.subject.width = static_cast<std::uint32_t>(row.integer());
  m.subject.height = static_cast<std::uint32_t>(row.integer());
  m.subject.rays = row.text();
  m.subject.recipe = row.text();
  m.subject.probe = row.text();
  m.subject.seed = static_cast<std::uint64_t>(row.integer());
  m.subject.repetition = static_cast<std::uint32_t>(row.integer());
  m.subject.threads = static_cast<std::uint32_t>(row.integer());
  return m;
}

std::int64_t version_of(Connection& connection) {
  Statement version(connection, "PRAGMA user_version");
  version.step();
  return version.integer();
}

/// Makes the tables of a new store. Several processes may be at it at once: one makes them, the others wait and see.
void prepare(Connection& connection) {
  // A committed transaction of a WAL survives the death of the process; NORMAL risks only those of the last moments
  // before a power cut, and is some hundred times faster.
  connection.execute_patiently("PRAGMA journal_mode = WAL", patience_ms);
  connection.execute("PRAGMA synchronous = NORMAL; PRAGMA foreign_keys = ON");
  if (version_of(connection) != 0) return;
  Transaction transaction(connection);
  if (version_of(connection) == 0) {
    connection.execute(schema);
    connection.execute(fmt::format("PRAGMA user_version = {}", format_version).c_str());
  }
  transaction.commit();
}

}  // namespace

std::string Subject::key() const {
  // The unit separator cannot be in any of the parts.
  return fmt::format("{1}{0}{2}{0}{3:016x}{0}{4}{0}{5}{0}{6}x{7}{0}{8}{0}{9}{0}{10}{0}{11}{0}{12}{0}{13}", '\x1f',
                     study, scene, scene_hash, view, camera, width, height, rays, recipe, probe, seed, repetition,
                     threads);
}

struct Store::Database {
  Connection connection;
};

Store::Store(const std::filesystem::path& file, Mode mode) {
  const bool reading = mode == Mode::read;
  if (reading && !std::filesystem::exists(file)) {
    throw Error(fmt::format("there is no store {}; 'boxwood study' makes one", file.string()));
  }
  const int flags = reading ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  database_.reset(new Database{Connection(file, flags, patience_ms)});
  Connection& connection = database_->connection;
  if (!reading) prepare(connection);
  const std::int64_t found = version_of(connection);
  if (found > format_version || found == 0) {
    throw Error(fmt::format("{} is not a store that this version of boxwood can read", file.string()));
  }
}

Store::~Store() = default;

std::int64_t Store::environment_number(const Environment& e) {
  Connection& connection = database_->connection;
  Transaction transaction(connection);
  Statement(
      connection,
      "INSERT OR IGNORE INTO environment (cpu, threads, memory_bytes, system, compiler, flags, \"commit\", embree) "
      "VALUES (?, ?, ?, ?, ?, ?, ?, ?)")
      .bind(e.cpu)
      .bind(e.threads)
      .bind(e.memory_bytes)
      .bind(e.system)
      .bind(e.compiler)
      .bind(e.flags)
      .bind(e.commit)
      .bind(e.embree)
      .step();
  Statement number(connection,
                   "SELECT id FROM environment WHERE cpu = ? AND threads = ? AND memory_bytes = ? AND system = ? AND "
                   "compiler = ? AND flags = ? AND \"commit\" = ? AND embree = ?");
  number.bind(e.cpu)
      .bind(e.threads)
      .bind(e.memory_bytes)
      .bind(e.system)
      .bind(e.compiler)
      .bind(e.flags)
      .bind(e.commit)
      .bind(e.embree)
      .step();
  const std::int64_t id = number.integer();
  transaction.commit();
  return id;
}

Environment Store::environment(std::int64_t number) const {
  Statement row(database_->connection,
                "SELECT cpu, threads, memory_bytes, system, compiler, flags, \"commit\", embree FROM environment "
                "WHERE id = ?");
  if (!row.bind(number).step()) throw Error(fmt::format("the store has no environment {}", number));
  Environment e;
  e.cpu = row.text();
  e.threads = static_cast<std::uint32_t>(row.integer());
  e.memory_bytes = static_cast<std::uint64_t>(row.integer());
  e.system = row.text();
  e.compiler = row.text();
  e.flags = row.text();
  e.commit = row.text();
  e.embree = row.text();
  return e;
}

std::vector<std::int64_t> Store::environments() const {
  Statement row(database_->connection, "SELECT id FROM environment ORDER BY id");
  std::vector<std::int64_t> numbers;
  while (row.step()) numbers.push_back(row.integer());
  return numbers;
}

bool Store::add(const Subject& s, std::span<const StoredValue> values, std::int64_t environment) {
  Connection& connection = database_->connection;
  Transaction transaction(connection);
  Statement(
      connection,
      "INSERT OR IGNORE INTO measurement (environment, key, time, study, scene, scene_source, scene_hash, triangles, "
      "view, camera, width, height, rays, recipe, probe, seed, repetition, threads) "
      "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
      .bind(environment)
      .bind(s.key())
      .bind(utc_now())
      .bind(s.study)
      .bind(s.scene)
      .bind(s.scene_source)
      .bind(fmt::format("{:016x}", s.scene_hash))
      .bind(s.triangles)
      .bind(s.view)
      .bind(s.camera)
      .bind(s.width)
      .bind(s.height)
      .bind(s.rays)
      .bind(s.recipe)
      .bind(s.probe)
      .bind(s.seed)
      .bind(s.repetition)
      .bind(s.threads)
      .step();
  if (sqlite3_changes(connection.handle()) == 0) return false;
  const std::int64_t id = sqlite3_last_insert_rowid(connection.handle());
  for (const StoredValue& value : values) {
    Statement(connection, "INSERT INTO value (measurement, metric, unit, value) VALUES (?, ?, ?, ?)")
        .bind(id)
        .bind(value.metric)
        .bind(value.unit)
        .bind(value.value)
        .step();
  }
  transaction.commit();
  return true;
}

std::set<std::string> Store::keys(const std::string& study, std::int64_t environment) const {
  Statement row(database_->connection, "SELECT key FROM measurement WHERE study = ? AND environment = ?");
  row.bind(study).bind(environment);
  std::set<std::string> out;
  while (row.step()) out.insert(row.text());
  return out;
}

std::vector<Measurement> Store::measurements(const StoreFilter& filter) const {
  // Empty parameters match everything.
  Statement row(database_->connection,
                "SELECT m.id, v.metric, v.unit, v.value, environment, time, study, scene, scene_source, scene_hash, "
                "triangles, view, camera, width, height, rays, recipe, probe, seed, repetition, threads "
                "FROM measurement m JOIN value v ON v.measurement = m.id "
                "WHERE ?1 IN ('', study) AND ?2 IN ('', scene) AND ?3 IN ('', rays) AND ?4 IN ('', metric) AND "
                "?5 IN ('', probe) AND (?6 = '' OR instr(recipe, ?6) > 0) AND (?7 = 0 OR environment = ?7) "
                "ORDER BY m.id, v.metric");
  row.bind(filter.study)
      .bind(filter.scene)
      .bind(filter.rays)
      .bind(filter.metric)
      .bind(filter.probe)
      .bind(filter.recipe)
      .bind(filter.environment.value_or(0));
  std::vector<Measurement> out;
  for (std::int64_t last = -1; row.step();) {
    const std::int64_t id = row.integer();
    StoredValue value{row.text(), row.text(), row.real()};
    if (id != last) out.push_back(read_measurement(row));
    last = id;
    out.back().values.push_back(std::move(value));
  }
  return out;
}

void Store::keep_study(const StoredStudy& study) {
  Statement(database_->connection, "INSERT OR REPLACE INTO study (name, text) VALUES (?, ?)")
      .bind(study.name)
      .bind(study.text)
      .step();
}

std::vector<StoredStudy> Store::studies() const {
  Statement row(database_->connection, "SELECT name, text FROM study ORDER BY name");
  std::vector<StoredStudy> out;
  while (row.step()) {
    std::string name = row.text();
    out.push_back({std::move(name), row.text()});
  }
  return out;
}

void Store::keep_picture(const StoredPicture& picture) {
  Statement(database_->connection,
            "INSERT OR REPLACE INTO picture (study, scene, view, recipe, kind, png) VALUES (?, ?, ?, ?, ?, ?)")
      .bind(picture.study)
      .bind(picture.scene)
      .bind(picture.view)
      .bind(picture.recipe)
      .bind(picture.kind)
      .bind(std::span<const unsigned char>(picture.png))
      .step();
}

std::vector<StoredPicture> Store::pictures(const std::string& study) const {
  Statement row(
      database_->connection,
      "SELECT scene, view, recipe, kind, png FROM picture WHERE study = ? ORDER BY scene, view, kind, recipe");
  row.bind(study);
  std::vector<StoredPicture> out;
  while (row.step()) {
    StoredPicture picture{study, {}, {}, {}, {}, {}};
    picture.scene = row.text();
    picture.view = row.text();
    picture.recipe = row.text();
    picture.kind = row.text();
    picture.png = row.bytes();
    out.push_back(std::move(picture));
  }
  return out;
}

}  // namespace boxwood
