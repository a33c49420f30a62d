// docs/tables.md: the layouts, columns and units of laboratory tables, from the lists that the readers use.
#pragma once
#include <string>

namespace phy::jobs {

/// The page, in Markdown.
std::string tables_reference();

}  // namespace phy::jobs
