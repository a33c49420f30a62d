// What a manual page says beyond the verb's own tree of options.
#pragma once
#include <string>
#include <vector>

namespace phy::cli {

struct ManExample {
  std::string why, command;
};

struct ManText {
  std::string verb;         ///< "" = `phyllite` itself
  std::string description;  ///< paragraphs, parted by empty lines; `phyllite run` in backticks becomes bold
  std::vector<std::pair<std::string, std::string>> files;
  std::vector<ManExample> examples;  ///< run where a copy of the folder `examples` is
};

/// THE list: one entry for every verb, and one for the program. Throws InternalError where a verb has none.
const ManText& man_text(const std::string& verb);

struct ManEntry {
  std::string term, meaning;
};
/// Exit codes of every verb (docs/architecture.md).
const std::vector<ManEntry>& exit_codes();
/// Variables of the environment that the program reads.
const std::vector<ManEntry>& environment_variables();

}  // namespace phy::cli
