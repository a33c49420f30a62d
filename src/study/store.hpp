// The store of a study: one SQLite file (WAL mode), one row per finished specimen, keyed by the fingerprint
// of its completed recipe (study/experiment.hpp). The same specimen therefore never runs twice, whatever
// study, shard, process or calibration asks for it.
//
// Who runs what is settled by claims. A claim names its owner and lasts for `lease_seconds`; the owner renews
// it while it works. A killed process loses only the specimens in flight: its claims are free at once where
// the next process can see that the owner is dead (same machine, also after it was started anew), else when
// the lease runs out. A row is written in one transaction together with the end of its claim, so that a half
// row cannot exist. Several processes of one machine may share a store; over a network file system SQLite's
// locks cannot be trusted, and such a store is refused: use shards and `merge` there.
//
// The tables (docs/formats.md) are plain SQL for anybody's tools. Histories and cracks are the CSV text of a
// result folder, zlib-compressed. As anybody can write with them, every record has a checksum over all of it,
// taken from the record as SQLite gives it back, and is held against it whenever it is read: a number that
// was changed by hand or by a failing disk is told and not used.
#pragma once
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "io/sqlite.hpp"
#include "records/result.hpp"

namespace phy::study {

/// Version of the tables, kept as the file's user_version. A store of another one is refused.
constexpr int store_format = 3;
constexpr double lease_seconds = 120.0;

/// One finished specimen.
struct StoredResult {
  std::string key;     ///< fingerprint of `recipe`
  std::string recipe;  ///< completed recipe of this one specimen, as TOML
  TestResult result;   ///< without snapshots; history and cracks only from Store::find
  std::int64_t n_cracks = 0;
  std::string series;                   ///< fingerprint of history and cracks as they are stored
  std::string host, program, finished;  ///< where, by which version, when (UTC)
};

/// Over everything of a record; of history and cracks over their fingerprint. Stored with it.
std::string checksum_of(const StoredResult& record);

enum class Claim {
  mine,      ///< this store object runs it now: put or release it
  done,      ///< there is a row
  elsewhere  ///< another process runs it
};

struct MergeReport {
  std::size_t n_added = 0, n_known = 0;
  std::vector<std::string> different;  ///< keys whose results differ between the two stores; ours is kept
};

/// Fingerprint over keys, outcomes, numbers and result hashes of the rows that are there; not over hosts,
/// times or the order of the rows.
std::string hash_of(const std::vector<std::optional<StoredResult>>& rows);

/// Who else may open the store meanwhile. `alone` holds it for one process, which is safe on network file
/// systems too: for shards. `reading` is shared, and also opens what this process cannot write.
enum class Sharing { shared, alone, reading };

/// Safe to use from several threads.
class Store {
 public:
  /// Opens or makes the store. Throws IoError: unreadable, no store, another format, network file system.
  /// What reads rows throws IoError too: records that are not as they were stored.
  explicit Store(const std::string& path, Sharing sharing = Sharing::shared);
  ~Store();

  Claim claim(const std::string& key);
  /// Prolongs all claims of this object. Call more often than lease_seconds.
  void renew();
  /// Gives unfinished claims back: one, or all of this object.
  void release(const std::string& key);
  void release_all();
  /// A finished test becomes one that nobody has run.
  void remove(const std::string& key);
  /// Stores a finished specimen (not an interrupted one) and ends the claim. A row that is there stays.
  /// `host`: where it ran; "": here.
  void put(const std::string& key, const std::string& recipe, const TestResult& result,
           const std::string& host = "");

  /// The row with history and cracks.
  std::optional<StoredResult> find(const std::string& key) const;
  /// All rows in the order of their keys, without histories and cracks.
  std::vector<StoredResult> rows() const;
  /// Those of the given keys that are finished, in the given order, without histories and cracks.
  std::vector<std::optional<StoredResult>> rows(const std::vector<std::string>& keys) const;
  std::size_t size() const;
  /// Specimens that living processes are at.
  std::size_t n_claimed() const;
  /// Of all rows, sorted.
  std::vector<std::string> keys() const;
  /// Takes over the rows of another store that are missing here.
  MergeReport merge(const std::string& other_path);

 private:
  void make_tables(Sharing sharing);
  bool has_tables() const;
  /// Nothing if the record is damaged: it is then among `damaged`.
  std::optional<StoredResult> read_row(const io::Statement& s, std::vector<StoredResult>& damaged) const;
  void seal(const std::string& key);
  MergeReport merge_attached();
  mutable std::mutex mutex_;
  mutable io::Database database_;
  std::string owner_;
};

}  // namespace phy::study
