#include "store/database.h"

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "boxwood/error.h"

namespace boxwood {

Connection::Connection(const std::filesystem::path& file, int flags, int patience_ms) : file_(file.string()) {
  if (sqlite3_open_v2(file_.c_str(), &handle_, flags, nullptr) != SQLITE_OK) {
    const std::string cause = handle_ ? sqlite3_errmsg(handle_) : "out of memory";
    sqlite3_close(handle_);
    throw Error(fmt::format("the store {} cannot be opened: {}", file_, cause));
  }
  sqlite3_busy_timeout(handle_, patience_ms);
}

void Connection::execute(const char* sql) {
  if (sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail("used");
}

void Connection::execute_patiently(const char* sql, int patience_ms) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(patience_ms);
  for (;;) {
    const int result = sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr);
    if (result == SQLITE_OK) return;
    if (result != SQLITE_BUSY || std::chrono::steady_clock::now() > deadline) fail("used");
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

void Connection::fail(std::string_view doing) const {
  throw Error(fmt::format("the store {} cannot be {}: {}", file_, doing, sqlite3_errmsg(handle_)));
}

Statement::Statement(const Connection& connection, std::string_view sql) : connection_(connection) {
  check(sqlite3_prepare_v2(connection.handle(), sql.data(), static_cast<int>(sql.size()), &handle_, nullptr));
}

void Statement::check(int result) {
  if (result != SQLITE_OK) connection_.fail("read or written");
}

Statement& Statement::bind(std::string_view text) {
  check(sqlite3_bind_text(handle_, ++parameter_, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT));
  return *this;
}

Statement& Statement::bind(std::int64_t number) {
  check(sqlite3_bind_int64(handle_, ++parameter_, number));
  return *this;
}

Statement& Statement::bind(double number) {
  check(sqlite3_bind_double(handle_, ++parameter_, number));
  return *this;
}

Statement& Statement::bind(std::span<const unsigned char> bytes) {
  check(sqlite3_bind_blob64(handle_, ++parameter_, bytes.data(), bytes.size(), SQLITE_TRANSIENT));
  return *this;
}

bool Statement::step() {
  column_ = 0;
  const int result = sqlite3_step(handle_);
  if (result == SQLITE_ROW) return true;
  if (result != SQLITE_DONE) connection_.fail("read or written");
  return false;
}

std::string Statement::text() {
  const auto* begin = reinterpret_cast<const char*>(sqlite3_column_text(handle_, column_));
  const int size = sqlite3_column_bytes(handle_, column_++);
  return begin ? std::string(begin, static_cast<std::size_t>(size)) : std::string();
}

std::vector<unsigned char> Statement::bytes() {
  const auto* begin = static_cast<const unsigned char*>(sqlite3_column_blob(handle_, column_));
  const int size = sqlite3_column_bytes(handle_, column_++);
  return {begin, begin + size};
}

Transaction::~Transaction() {
  // Nobody is left to tell when even this fails; the file is as it was in any case.
  if (open_) sqlite3_exec(connection_.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Transaction::commit() {
  connection_.execute("COMMIT");
  open_ = false;
}

}  // namespace boxwood
