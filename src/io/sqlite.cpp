#include "io/sqlite.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <filesystem>

#include "base/check.hpp"
#include "base/nan.hpp"
#include "base/option.hpp"
#include "io/file.hpp"
#include "system/files.hpp"

namespace phy::io {
namespace {

namespace fs = std::filesystem;

std::string remedy_for(int code) {
  // The lower byte is the primary code; the rest are refinements of it.
  switch (code & 0xff) {
    case SQLITE_NOTADB:
    case SQLITE_CORRUPT: return "; this is no store or a damaged one: move it away and start again";
    case SQLITE_FULL: return "; free some space, or choose another folder with " + option("out");
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_CANTOPEN:
      return "; check the permissions, or choose a folder of your own with " + option("out");
    case SQLITE_BUSY: return "; another program keeps it locked";
    default: return "";
  }
}

bool is_writable(const std::string& file) {
  // In the folder too: SQLite keeps its WAL and its lock beside the file.
  return system::may_write(file) && system::may_write_in(fs::path(file).parent_path().string());
}

/// The name by which SQLite opens a file for reading. In a folder that cannot be written it has no place for
/// the lock of a WAL file; where there is none ("immutable") it needs no lock.
std::string uri_for_reading(const std::string& file) {
  std::error_code none;
  const std::uintmax_t wal = fs::file_size(file + "-wal", none);
  const std::string path = fs::absolute(file).generic_string();
  std::string uri = path.starts_with('/') ? "file:" : "file:/";  // in front of the letter of a disk
  for (const char c : path)
    uri += c == '?' || c == '#' || c == '%' ? fmt::format("%{:02X}", static_cast<int>(c)) : std::string(1, c);
  return uri + (none || wal == 0 ? "?immutable=1" : "");
}

}  // namespace

Database::Database(const std::string& path, int patience_ms, Access access) : path_(path) {
  // SQLite would wait for a pipe. The others are what it keeps beside a database.
  for (const char* beside : {"", "-wal", "-journal", "-shm"}) refuse_unless_file(path + beside);
  std::error_code none;
  can_write_ = access == Access::writing || !fs::exists(path, none) || is_writable(path);
  if (can_write_) make_folder(fs::path(path).parent_path().string());
  // No mutex inside SQLite: the owner of the connection locks.
  const int flags = SQLITE_OPEN_NOMUTEX | (can_write_ ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE
                                                      : SQLITE_OPEN_READONLY | SQLITE_OPEN_URI);
  if (sqlite3_open_v2((can_write_ ? path : uri_for_reading(path)).c_str(), &handle_, flags, nullptr) !=
      SQLITE_OK) {
    // Even a failed open returns a handle, which holds the message and must be closed.
    const std::string why = handle_ != nullptr ? sqlite3_errmsg(handle_) : "not enough memory";
    const std::string remedy = remedy_for(handle_ != nullptr ? sqlite3_errcode(handle_) : SQLITE_NOMEM);
    sqlite3_close(handle_);
    throw IoError(path_ + ": cannot be opened: " + why + remedy);
  }
  sqlite3_busy_timeout(handle_, patience_ms);
}

Database::~Database() { sqlite3_close_v2(handle_); }

void Database::fail(const std::string& doing) const {
  throw IoError(path_ + ": cannot " + doing + ": " + sqlite3_errmsg(handle_) +
                remedy_for(sqlite3_errcode(handle_)));
}

void Database::execute(const std::string& sql) {
  if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail("be used");
}

void Database::transaction(const std::function<void()>& body) {
  // IMMEDIATE takes the write lock at the start: a later upgrade from reading could fail halfway with "busy".
  execute("BEGIN IMMEDIATE");
  try {
    body();
    execute("COMMIT");
  } catch (...) {
    // SQLite has rolled back by itself after some errors (a full disk).
    if (sqlite3_get_autocommit(handle_) == 0) sqlite3_exec(handle_, "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
}

std::int64_t Database::n_changed() const { return sqlite3_changes64(handle_); }

Statement::Statement(Database& database, std::string_view sql) : database_(database) {
  if (sqlite3_prepare_v2(database.handle_, sql.data(), static_cast<int>(sql.size()), &handle_, nullptr) !=
      SQLITE_OK)
    database.fail("be used");
}

Statement::~Statement() { sqlite3_finalize(handle_); }

Statement& Statement::bind(std::string_view text) {
  // TRANSIENT: SQLite copies the text, which may be a temporary.
  if (sqlite3_bind_text64(handle_, ++n_bound_, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8) !=
      SQLITE_OK)
    database_.fail("be written");
  return *this;
}

Statement& Statement::bind(double value) {
  if (sqlite3_bind_double(handle_, ++n_bound_, value) != SQLITE_OK) database_.fail("be written");
  return *this;
}

Statement& Statement::bind(std::int64_t value) {
  if (sqlite3_bind_int64(handle_, ++n_bound_, value) != SQLITE_OK) database_.fail("be written");
  return *this;
}

Statement& Statement::bind_blob(std::string_view bytes) {
  if (sqlite3_bind_blob64(handle_, ++n_bound_, bytes.data(), bytes.size(), SQLITE_TRANSIENT) != SQLITE_OK)
    database_.fail("be written");
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(handle_);
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) database_.fail("be used");
  return false;
}

void Statement::run() {
  while (step()) {
  }
  sqlite3_reset(handle_);
  n_bound_ = 0;
}

std::string Statement::text(int column) const {
  // The text first: asking for its length converts the value.
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(handle_, column));
  return bytes == nullptr
             ? std::string()
             : std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(handle_, column)));
}

std::string Statement::blob(int column) const {
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(handle_, column));
  return bytes == nullptr
             ? std::string()
             : std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(handle_, column)));
}

double Statement::number(int column) const {
  // NaN was bound as NULL: SQLite has no NaN.
  return sqlite3_column_type(handle_, column) == SQLITE_NULL ? nan : sqlite3_column_double(handle_, column);
}

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(handle_, column); }

}  // namespace phy::io
