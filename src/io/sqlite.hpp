// A thin wrapper of SQLite: connections and statements that close themselves, failures thrown as IoError
// with the name of the file. Not shared between threads; the owner locks.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace phy::io {

/// `reading`: a file that cannot be written, or in a folder that cannot, is opened all the same, for reading.
enum class Access { writing, reading };

class Database {
 public:
  /// Opens or makes the file. Waits up to `patience_ms` for other processes before any call gives up.
  explicit Database(const std::string& path, int patience_ms = 60000, Access access = Access::writing);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// Statements without results, separated by semicolons.
  void execute(const std::string& sql);
  /// Runs `body` between BEGIN IMMEDIATE and COMMIT: all of it or, when it throws, nothing.
  void transaction(const std::function<void()>& body);
  /// Rows changed by the last INSERT, UPDATE or DELETE.
  std::int64_t n_changed() const;
  const std::string& path() const { return path_; }
  /// False where the file was opened for reading only.
  bool can_write() const { return can_write_; }
  [[noreturn]] void fail(const std::string& doing) const;

 private:
  friend class Statement;
  std::string path_;
  bool can_write_ = true;
  sqlite3* handle_ = nullptr;
};

/// One prepared statement. Parameters are bound in order; NaN travels as NULL, both ways.
class Statement {
 public:
  Statement(Database& database, std::string_view sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(std::string_view text);
  Statement& bind(const char* text) { return bind(std::string_view(text)); }
  Statement& bind(double value);
  Statement& bind(std::int64_t value);
  Statement& bind_blob(std::string_view bytes);
  /// The next row; false when there is none. Afterwards columns may be read.
  bool step();
  /// Runs to the end and makes the statement ready to be bound again.
  void run();

  std::string text(int column) const;
  std::string blob(int column) const;
  double number(int column) const;
  std::int64_t integer(int column) const;

 private:
  Database& database_;
  sqlite3_stmt* handle_ = nullptr;
  int n_bound_ = 0;
};

}  // namespace phy::io
