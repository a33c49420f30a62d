// The methods section of a paper, written from the completed recipe of a run.
#pragma once
#include <string>
#include <vector>

#include "records/specimen_record.hpp"

namespace phy::report {

/// Paragraphs on model, specimens, loading and definitions, with the literature; ready to cite.
std::vector<std::string> methods_text(const RunRecord& run);

}  // namespace phy::report
