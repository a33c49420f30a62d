// Findings, and what a table determines, as files and the page read them: words of data beside one text.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "records/finding.hpp"
#include "records/lab_tests.hpp"

namespace phy::report {

using Json = nlohmann::ordered_json;

/// {kind, cells, numbers, names, advice, text}. A number that stands once for each cell is a list.
Json finding_json(const Finding& finding);
Json findings_json(const std::vector<Finding>& findings);

/// {basis, tests, text}; null without a basis.
Json support_json(const Support& support);
/// {remedy, tests, text}; null without one.
Json next_json(const NextStep& next);

}  // namespace phy::report
