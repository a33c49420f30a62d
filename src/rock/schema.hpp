// Keys of a rock file: the one list, by which it is read, explained and documented.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "io/document.hpp"

namespace phy::rock {

const io::Schema& rock_schema();

/// What a rock file says for the first page of a report.
struct ReportHead {
  std::vector<std::pair<std::string, std::string>>
      lines;          ///< keys of [report] that are there, in the list's order
  std::string table;  ///< `data`
};
/// Throws IoError or InputError where the file cannot be read.
ReportHead report_head(const std::string& path);

}  // namespace phy::rock
