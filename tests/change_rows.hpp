// For tests: rows of a store changed as another version of this program would have stored them, with their
// checksums.
#pragma once
#include <string>
#include <vector>

#include "io/sqlite.hpp"
#include "study/store.hpp"

namespace phy {

/// `sql` changes the tables, `change` the same of every row.
template <class Change>
void change_rows(const std::string& path, const std::string& sql, const Change& change) {
  std::vector<study::StoredResult> rows = study::Store(path, study::Sharing::reading).rows();
  io::Database database(path);
  database.execute(sql);
  for (study::StoredResult& r : rows) {
    change(r);
    database.execute("UPDATE specimen SET checksum = '" + checksum_of(r) + "' WHERE key = '" + r.key + "'");
  }
}

}  // namespace phy
