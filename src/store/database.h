#pragma once
#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace boxwood {

/// A SQLite connection. Throws Error naming the file.
class Connection {
 public:
  /// Waits for up to `patience_ms` while other processes write.
  Connection(const std::filesystem::path& file, int flags, int patience_ms);
  ~Connection() { sqlite3_close(handle_); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void execute(const char* sql);
  /// For what SQLite refuses at once, without its own waiting, while another process is about it.
  void execute_patiently(const char* sql, int patience_ms);
  sqlite3* handle() const { return handle_; }
  [[noreturn]] void fail(std::string_view doing) const;

 private:
  std::string file_;
  sqlite3* handle_ = nullptr;
};

/// One prepared statement, used once. Parameters are bound in order.
class Statement {
 public:
  Statement(const Connection& connection, std::string_view sql);
  ~Statement() { sqlite3_finalize(handle_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(std::string_view text);
  Statement& bind(std::int64_t number);
  Statement& bind(std::uint64_t number) { return bind(static_cast<std::int64_t>(number)); }
  Statement& bind(std::uint32_t number) { return bind(std::int64_t{number}); }
  Statement& bind(double number);
  Statement& bind(std::span<const unsigned char> bytes);

  /// Whether there is a row; columns are then read in order.
  bool step();
  std::string text();
  std::int64_t integer() { return sqlite3_column_int64(handle_, column_++); }
  double real() { return sqlite3_column_double(handle_, column_++); }
  std::vector<unsigned char> bytes();

 private:
  void check(int result);

  const Connection& connection_;
  sqlite3_stmt* handle_ = nullptr;
  int parameter_ = 0, column_ = 0;
};

/// Rolled back unless committed. Takes the write lock at once, so that it cannot lose to another process halfway.
class Transaction {
 public:
  explicit Transaction(Connection& connection) : connection_(connection) { connection_.execute("BEGIN IMMEDIATE"); }
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Connection& connection_;
  bool open_ = true;
};

}  // namespace boxwood
