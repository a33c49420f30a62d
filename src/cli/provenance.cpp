#include "cli/provenance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/version.hpp"
#include "cli/terminal.hpp"

namespace phy::cli {
namespace {

/// `programs`: how many results each has made. Nothing where all are of this one.
void tell_others(std::map<std::string, std::size_t> programs, int terminal_width) {
  // Only what differs is worth a line.
  programs.erase(phy::program);
  for (const auto& [program, n] : programs)
    print_wrapped(terminal_width, 2,
                  "{} result(s) were made by {}, this is {}: their numbers may differ from this version's; "
                  "run them into another folder to compare\n",
                  n, program, phy::program);
}

}  // namespace

int tell_provenance(const RunRecord& run, int terminal_width) {
  std::map<std::string, std::size_t> programs;
  for (const SpecimenRecord& t : run.tests) ++programs[t.program];
  tell_others(std::move(programs), terminal_width);
  for (const MissingTest& m : run.missing)
    print_wrapped(terminal_width, 2, "{}: missing: {}\n", m.name, m.reason);
  // A test that was interrupted is missing, too, but no file is damaged: only that is code 3.
  const bool unreadable =
      std::any_of(run.missing.begin(), run.missing.end(), [](const MissingTest& m) { return m.unreadable; });
  return unreadable ? 3 : 0;
}

void tell_versions(const std::vector<std::optional<study::StoredResult>>& rows, int terminal_width) {
  std::map<std::string, std::size_t> programs;
  for (const auto& row : rows)
    if (row) ++programs[row->program];
  tell_others(std::move(programs), terminal_width);
}

}  // namespace phy::cli
