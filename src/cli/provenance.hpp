// What verbs tell of the results that they read: which are missing or cannot be read, and which another
// version of the program made. Numbers of two versions need not agree, so they are never beside each other
// unsaid.
#pragma once
#include "records/specimen_record.hpp"
#include "study/store.hpp"

namespace phy::cli {

/// Prints what a run lacks, and versions other than this one. The exit code: 3 where something cannot be
/// read, else 0.
int tell_provenance(const RunRecord& run, int terminal_width);
/// The versions of rows of a store.
void tell_versions(const std::vector<std::optional<study::StoredResult>>& rows, int terminal_width);

}  // namespace phy::cli
