// docs/result-tables.md: measures of quality, columns of histories, keys of a result and figures, from the
// lists that the program works by.
#pragma once
#include <string>

namespace phy::jobs {

/// The page, in Markdown.
std::string result_reference();

}  // namespace phy::jobs
