#include "study/store.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <map>
#include <sstream>
#include <thread>

#include "base/check.hpp"
#include "base/hash.hpp"
#include "base/largest_file.hpp"
#include "base/quote.hpp"
#include "base/units.hpp"
#include "base/version.hpp"
#include "io/csv.hpp"
#include "io/deflate.hpp"
#include "system/files.hpp"
#include "system/process.hpp"

namespace phy::study {
std::string checksum_of(const StoredResult& r) {
  std::string all;
  // With its length in front no text can pass for two.
  const auto add = [&](std::string_view text) {
    all.append(std::to_string(text.size())).append(":").append(text);
  };
  const TestResult& t = r.result;
  for (const std::string_view text :
       {r.key, r.recipe, t.name, std::string(to_string(t.outcome.status)), t.outcome.reason, t.outcome.advice,
        t.hash, r.host, r.program, r.finished, r.series})
    add(text);
  for (const double value : {t.theta, t.dt, t.seconds}) add(print_number(value));
  for (const std::int64_t value : {std::int64_t{t.intact}, t.n_steps, t.n_contacts, r.n_cracks})
    add(std::to_string(value));
  for (const Number& n : t.numbers)
    add(n.name), add(print_number(n.value)), add(n.unit), add(n.definition), add(n.note);
  return fingerprint_of(all);
}

namespace {

constexpr int patience_ms = 60000;

// Keyed by fingerprint. Numbers are rows of their own, so that any can be selected by SQL; `place` keeps
// their order.
constexpr const char* store_tables = R"(
CREATE TABLE IF NOT EXISTS specimen (
  key TEXT PRIMARY KEY, recipe TEXT NOT NULL, name TEXT NOT NULL, intact INTEGER NOT NULL, theta REAL,
  status TEXT NOT NULL, reason TEXT NOT NULL, advice TEXT NOT NULL, result_hash TEXT NOT NULL,
  dt REAL, n_steps INTEGER, n_contacts INTEGER, n_cracks INTEGER, seconds REAL,
  host TEXT, program TEXT, finished TEXT, history BLOB, cracks BLOB,
  series TEXT NOT NULL DEFAULT '', checksum TEXT NOT NULL DEFAULT '') STRICT;
CREATE TABLE IF NOT EXISTS number (
  key TEXT NOT NULL, name TEXT NOT NULL, place INTEGER NOT NULL, value REAL, unit TEXT NOT NULL,
  definition TEXT NOT NULL, note TEXT NOT NULL, PRIMARY KEY (key, name)) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS claim (key TEXT PRIMARY KEY, owner TEXT NOT NULL, until REAL NOT NULL) STRICT;
)";
constexpr const char* specimen_columns =
    "key, recipe, name, intact, theta, status, reason, advice, result_hash, dt, n_steps, n_contacts, "
    "n_cracks, seconds, host, program, finished, series, checksum";

const std::string select_whole =
    std::string("SELECT ") + specimen_columns + ", history, cracks FROM specimen WHERE key = ?";

/// Leases compare times of several processes, so this is the calendar clock and not a steady one.
double now() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

std::string utc_now() {
  const std::tm parts = system::utc(std::time(nullptr));
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

/// "machine|boot|processes|pid|start|number of the object".
std::string new_owner() {
  static std::atomic<int> n_objects{0};
  const system::World here = system::this_world();
  const int pid = system::process_number();
  return fmt::format("{}|{}|{}|{}|{}|{}", here.machine, here.boot, here.processes, pid,
                     system::start_of(std::to_string(pid)), ++n_objects);
}

/// True if the owner is known to be dead; false if it lives or cannot be seen from here.
bool is_dead(const std::string& owner) {
  std::istringstream parts(owner);
  system::World its;
  std::string pid, start;
  for (std::string* part : {&its.machine, &its.boot, &its.processes, &pid, &start})
    std::getline(parts, *part, '|');
  const system::World here = system::this_world();
  // Of another machine or container nothing is known: such a claim ends with its lease only. A number that
  // has been given to a new process shows by its start.
  if (its.machine != here.machine) return false;
  return its.boot != here.boot || (its.processes == here.processes && system::start_of(pid) != start);
}

/// A history or a list of cracks.
std::string unpacked(const std::string& blob, const std::string& path) {
  std::optional<std::string> text = io::inflated(blob, largest_file);  // a few bytes can be gigabytes
  if (!text)
    throw IoError(path +
                  ": a history is damaged, or larger than a gigabyte; delete its row and run it again");
  return std::move(*text);
}

/// SQLite relies on locks of the file system, which network file systems implement loosely or not at all.
void refuse_network(const std::string& path) {
  // If the file system cannot be asked, the attempt to open the database decides.
  if (system::on_network(std::filesystem::path(path).parent_path().string()))
    throw IoError(path +
                  ": lies on a network file system, where locks cannot be trusted; put it on a local "
                  "disk, run shards (--shard i/n) and join them with `phyllite study merge`");
}

Status status_from(const std::string& text, const std::string& key, const std::string& path) {
  if (const std::optional<Status> status = status_of(text)) return *status;
  throw IoError(path + ": record " + key + ": unknown outcome \"" + text +
                "\": written by another version of this program, or changed");
}

StoredResult read_specimen(const io::Statement& s, const std::string& path) {
  StoredResult r;
  TestResult& t = r.result;
  r.key = s.text(0), r.recipe = s.text(1), t.name = s.text(2), t.intact = s.integer(3) != 0;
  t.theta = t.intact ? 0.0 : s.number(4);
  t.outcome = {status_from(s.text(5), r.key, path), s.text(6), s.text(7)};
  t.hash = s.text(8), t.dt = s.number(9), t.n_steps = s.integer(10), t.n_contacts = s.integer(11);
  r.n_cracks = s.integer(12), t.seconds = s.number(13);
  r.host = s.text(14), r.program = s.text(15), r.finished = s.text(16), r.series = s.text(17);
  return r;
}

/// The checksum that was stored with it.
std::string checksum_in(const io::Statement& s) { return s.text(18); }

void read_numbers(io::Database& database, StoredResult& r) {
  io::Statement s(database,
                  "SELECT name, value, unit, definition, note FROM number WHERE key = ? ORDER BY place");
  s.bind(r.key);
  while (s.step()) r.result.numbers.push_back({s.text(0), s.number(1), s.text(2), s.text(3), s.text(4)});
}

std::string series_of(const std::string& history, const std::string& cracks) {
  return fingerprint_of(fmt::format("{}:{}{}", history.size(), history, cracks));
}

constexpr std::size_t max_listed = 20;

/// Of `damaged` records. They can be run again; which of their fields is wrong cannot be known.
[[noreturn]] void refuse_damaged(const std::string& path, const std::vector<StoredResult>& damaged) {
  std::string list, keys;
  for (std::size_t i = 0; i < std::min(damaged.size(), max_listed); ++i) {
    list += fmt::format("\n  {} ({})", damaged[i].key, damaged[i].result.name);
    keys += fmt::format("{}'{}'", keys.empty() ? "" : ",", damaged[i].key);
  }
  if (damaged.size() > max_listed) list += fmt::format("\n  and {} more", damaged.size() - max_listed);
  throw IoError(fmt::format(
      "{}: {} record(s) are not as this program stored them: changed by hand, or damaged. Restore the "
      "file from a copy, or remove them and run the study again: "
      "sqlite3 {} \"DELETE FROM specimen WHERE key IN ({})\"{}",
      path, damaged.size(), shell_word(path), keys, list));
}

/// False if there was such a row already.
bool write_specimen(io::Database& database, const std::string& key, const std::string& recipe,
                    const TestResult& t, const std::string& host) {
  // OR IGNORE: two processes may have run the same test after a lease ended; the first result stays. Tests
  // are deterministic, so the second would be the same.
  io::Statement s(database, std::string("INSERT OR IGNORE INTO specimen (") + specimen_columns +
                                ", history, cracks) VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,'','',?,?)");
  s.bind(key).bind(recipe).bind(t.name).bind(std::int64_t{t.intact}).bind(t.theta);
  s.bind(to_string(t.outcome.status)).bind(t.outcome.reason).bind(t.outcome.advice).bind(t.hash);
  s.bind(t.dt).bind(t.n_steps).bind(t.n_contacts).bind(static_cast<std::int64_t>(t.cracks.size()));
  s.bind(t.seconds).bind(host.empty() ? system::host_name() : host).bind(phy::program).bind(utc_now());
  s.bind_blob(io::deflated(io::history_csv(t.history)))
      .bind_blob(io::deflated(io::cracks_csv(t.cracks, t.history.kind)));
  s.run();
  // The row was there: its numbers are, too.
  if (database.n_changed() == 0) return false;
  // Of a row that somebody has deleted, numbers may be left.
  io::Statement(database, "DELETE FROM number WHERE key = ?").bind(key).run();
  io::Statement number(database, "INSERT INTO number VALUES (?,?,?,?,?,?,?)");
  std::int64_t place = 0;
  for (const Number& n : t.numbers) {
    number.bind(key).bind(n.name).bind(place++).bind(n.value).bind(n.unit).bind(n.definition).bind(n.note);
    number.run();
  }
  return true;
}

}  // namespace

std::string hash_of(const std::vector<std::optional<StoredResult>>& rows) {
  // Sorted by key, so that neither the order of a design nor of arrival changes the fingerprint.
  std::map<std::string, const TestResult*> sorted;
  for (const auto& row : rows)
    if (row) sorted[row->key] = &row->result;
  Hash h;
  for (const auto& [key, result] : sorted) {
    // Neither times nor hosts: the same study on another machine has the same fingerprint.
    h.add(key), h.add(std::string(to_string(result->outcome.status))), h.add(result->hash);
    for (const Number& n : result->numbers) h.add(n.name), h.add(n.value);
  }
  return h.text();
}

Store::Store(const std::string& path, Sharing sharing)
    : database_(path, patience_ms, sharing == Sharing::reading ? io::Access::reading : io::Access::writing),
      owner_(new_owner()) {
  if (sharing != Sharing::alone) refuse_network(path);
  if (database_.can_write())
    make_tables(sharing);
  else if (!has_tables())
    throw IoError(path + ": is an empty store, and cannot be written");
}

Store::~Store() {
  if (!database_.can_write()) return;
  try {
    release_all();
  } catch (const std::exception&) {  // the lease ends by itself
  }
}

/// Takes the checksums of a record as SQLite gives it back: it may keep another NaN, or another zero.
void Store::seal(const std::string& key) {
  io::Statement row(database_, select_whole);
  row.bind(key).step();
  StoredResult r = read_specimen(row, database_.path());
  r.series = series_of(row.blob(19), row.blob(20));
  read_numbers(database_, r);
  io::Statement update(database_, "UPDATE specimen SET series = ?, checksum = ? WHERE key = ?");
  update.bind(r.series).bind(checksum_of(r)).bind(key).run();
}

/// True if there are tables already. Throws IoError where they are none of this format.
bool Store::has_tables() const {
  io::Statement version(database_, "PRAGMA user_version"),
      tables_in(database_, "SELECT count(*) FROM sqlite_master");
  version.step(), tables_in.step();
  if (tables_in.integer(0) == 0) return false;
  const std::int64_t found = version.integer(0);
  // A database with tables but without our version belongs to another program.
  if (found == 0) throw IoError(database_.path() + ": is no store of phyllite");
  if (found != store_format)
    throw IoError(fmt::format(
        "{}: has format {}, not {}: written by {} version of phyllite; run it again into another folder",
        database_.path(), found, store_format, found < store_format ? "an earlier" : "a later"));
  return true;
}

void Store::make_tables(Sharing sharing) {
  // Before the first access: SQLite then keeps the lock for good and needs no shared memory, which network
  // file systems lack.
  if (sharing == Sharing::alone) database_.execute("PRAGMA locking_mode = EXCLUSIVE");
  // One transaction: of two processes that create the store at once, one finds it made.
  database_.transaction([&] {
    if (!has_tables())
      database_.execute(std::string(store_tables) + "PRAGMA user_version = " + std::to_string(store_format));
  });
  // Last: a database that is not ours has been refused before anything changes in it. Changing to WAL needs
  // exclusive access for a moment, and SQLite does not wait for that by itself: up to 5 s here.
  for (int i = 0;; ++i) {
    try {
      database_.execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL");
      break;
    } catch (const IoError& e) {
      if (i == 100 || std::string(e.what()).find("locked") == std::string::npos) throw;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
}

Claim Store::claim(const std::string& key) {
  const std::lock_guard lock(mutex_);
  Claim answer = Claim::mine;
  // Test and set in one transaction, or two processes could claim the same test.
  database_.transaction([&] {
    io::Statement row(database_, "SELECT 1 FROM specimen WHERE key = ?");
    if (row.bind(key).step()) return void(answer = Claim::done);
    io::Statement other(database_, "SELECT owner, until FROM claim WHERE key = ?");
    if (other.bind(key).step()) {
      const std::string owner = other.text(0);
      // An expired claim, or one of a dead process, is replaced.
      const bool free = owner != owner_ && (other.number(1) < now() || is_dead(owner));
      if (!free) return void(answer = Claim::elsewhere);
    }
    io::Statement take(database_, "INSERT OR REPLACE INTO claim VALUES (?, ?, ?)");
    take.bind(key).bind(owner_).bind(now() + lease_seconds).run();
  });
  return answer;
}

void Store::renew() {
  const std::lock_guard lock(mutex_);
  io::Statement(database_, "UPDATE claim SET until = ? WHERE owner = ?")
      .bind(now() + lease_seconds)
      .bind(owner_)
      .run();
}

void Store::release(const std::string& key) {
  const std::lock_guard lock(mutex_);
  io::Statement(database_, "DELETE FROM claim WHERE key = ? AND owner = ?").bind(key).bind(owner_).run();
}

void Store::remove(const std::string& key) {
  const std::lock_guard lock(mutex_);
  database_.transaction([&] {
    for (const char* table : {"number", "specimen"})
      io::Statement(database_, fmt::format("DELETE FROM {} WHERE key = ?", table)).bind(key).run();
  });
}

void Store::release_all() {
  const std::lock_guard lock(mutex_);
  io::Statement(database_, "DELETE FROM claim WHERE owner = ?").bind(owner_).run();
}

void Store::put(const std::string& key, const std::string& recipe, const TestResult& result,
                const std::string& host) {
  PHY_CHECK(result.outcome.status != Status::interrupted, "an interrupted test is no result");
  const std::lock_guard lock(mutex_);
  // Result and end of claim in one transaction: no other process sees the test as free in between.
  database_.transaction([&] {
    if (write_specimen(database_, key, recipe, result, host)) seal(key);
    io::Statement(database_, "DELETE FROM claim WHERE key = ? AND owner = ?").bind(key).bind(owner_).run();
  });
}

std::optional<StoredResult> Store::find(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  io::Statement s(database_, select_whole);
  if (!s.bind(key).step()) return {};
  std::vector<StoredResult> damaged;
  std::optional<StoredResult> r = read_row(s, damaged);
  const std::string history = s.blob(19), cracks = s.blob(20);
  if (r && r->series != series_of(history, cracks)) damaged.push_back(*r);
  if (!damaged.empty()) refuse_damaged(database_.path(), damaged);
  r->result.history = io::parse_history(unpacked(history, database_.path()), database_.path());
  r->result.cracks = io::parse_cracks(unpacked(cracks, database_.path()), database_.path());
  return r;
}

std::optional<StoredResult> Store::read_row(const io::Statement& s,
                                            std::vector<StoredResult>& damaged) const {
  StoredResult r = read_specimen(s, database_.path());
  read_numbers(database_, r);
  if (checksum_in(s) == checksum_of(r)) return r;
  damaged.push_back(std::move(r));
  return {};
}

std::vector<StoredResult> Store::rows() const {
  const std::lock_guard lock(mutex_);
  std::vector<StoredResult> all, damaged;
  io::Statement s(database_, std::string("SELECT ") + specimen_columns + " FROM specimen ORDER BY key");
  while (s.step())
    if (std::optional<StoredResult> r = read_row(s, damaged)) all.push_back(std::move(*r));
  if (!damaged.empty()) refuse_damaged(database_.path(), damaged);
  return all;
}

std::vector<std::optional<StoredResult>> Store::rows(const std::vector<std::string>& keys) const {
  const std::lock_guard lock(mutex_);
  std::vector<std::optional<StoredResult>> found(keys.size());
  std::vector<StoredResult> damaged;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    io::Statement s(database_, std::string("SELECT ") + specimen_columns + " FROM specimen WHERE key = ?");
    if (s.bind(keys[i]).step()) found[i] = read_row(s, damaged);
  }
  if (!damaged.empty()) refuse_damaged(database_.path(), damaged);
  return found;
}

std::size_t Store::size() const {
  const std::lock_guard lock(mutex_);
  io::Statement s(database_, "SELECT count(*) FROM specimen");
  s.step();
  return static_cast<std::size_t>(s.integer(0));
}

std::size_t Store::n_claimed() const {
  const std::lock_guard lock(mutex_);
  io::Statement s(database_, "SELECT owner FROM claim WHERE until >= ?");
  // Expired claims do not match, those of dead processes are taken out one by one.
  s.bind(now());
  std::size_t n = 0;
  while (s.step()) n += is_dead(s.text(0)) ? 0 : 1;
  return n;
}

std::vector<std::string> Store::keys() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> keys;
  io::Statement s(database_, "SELECT key FROM specimen ORDER BY key");
  while (s.step()) keys.push_back(s.text(0));
  return keys;
}

MergeReport Store::merge(const std::string& other_path) {
  if (!std::filesystem::exists(other_path)) throw IoError(other_path + ": cannot be read: no such file");
  std::error_code none;
  if (std::filesystem::equivalent(other_path, database_.path(), none))
    throw InputError(
        Problem{other_path, "", "", "another store than the one that it is merged into", "name the parts"});
  Store(other_path).rows();  // is it a store, of this format, and are its records whole?
  // SQLite can join tables of two files, which moves rows without decoding them.
  const std::lock_guard lock(mutex_);
  io::Statement(database_, "ATTACH DATABASE ? AS other").bind(other_path).run();
  try {
    MergeReport report = merge_attached();
    database_.execute("DETACH DATABASE other");
    return report;
  } catch (...) {  // or no other store could be merged by this object
    database_.execute("DETACH DATABASE other");
    throw;
  }
}

MergeReport Store::merge_attached() {
  MergeReport report;
  database_.transaction([&] {
    io::Statement clash(database_,
                        "SELECT a.key FROM specimen a JOIN other.specimen b ON a.key = b.key "
                        "WHERE a.result_hash <> b.result_hash OR a.status <> b.status OR EXISTS (SELECT 1 "
                        "FROM number x JOIN other.number y ON x.key = y.key AND x.name = y.name "
                        "WHERE x.key = a.key AND x.value IS NOT y.value) ORDER BY a.key");
    while (clash.step()) report.different.push_back(clash.text(0));
    // A specimen that was removed by hand may have left its numbers behind.
    database_.execute("DELETE FROM number WHERE key NOT IN (SELECT key FROM specimen)");
    // Numbers first: the second statement makes the keys known, and would hide what the first has to copy.
    database_.execute(
        "INSERT INTO number SELECT * FROM other.number WHERE key NOT IN (SELECT key FROM specimen) "
        "AND key IN (SELECT key FROM other.specimen)");
    database_.execute(
        "INSERT INTO specimen SELECT * FROM other.specimen WHERE key NOT IN (SELECT key FROM specimen)");
    report.n_added = static_cast<std::size_t>(database_.n_changed());
    io::Statement count(database_, "SELECT count(*) FROM other.specimen");
    count.step();
    report.n_known = static_cast<std::size_t>(count.integer(0)) - report.n_added;
  });
  return report;
}

}  // namespace phy::study
