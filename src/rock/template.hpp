// What `phyllite rock new` writes: a rock without values, to be filled in.
#pragma once
#include <string>

namespace phy::rock {

/// A commented rock file that names `file` as its table, and such a table.
std::string rock_template(const std::string& name, const std::string& file);
std::string rock_table_template();

}  // namespace phy::rock
