// The keys of a file as a table of a page.
#pragma once
#include <string>
#include <vector>

#include "records/file_key.hpp"

namespace phy::jobs {

/// Markdown: a row per key, the objects in their order.
std::string key_table(const std::vector<FileObject>& objects);

}  // namespace phy::jobs
