// docs/result-tables.md: columns of histories, measures of quality and keys of a result, from the lists that
// the program works by.
#pragma once
#include <string>

namespace phy::jobs {

/// The page, in Markdown.
std::string result_reference();

}  // namespace phy::jobs
