// What a user should look at twice in a table: values that hardly any rock has, usually a unit or a column
// mistaken for another, and conversions that the table can carry out in part only. Nothing here is refused.
#pragma once
#include <string>
#include <vector>

#include "records/rock.hpp"

namespace phy {

/// One sentence per kind of doubt.
std::vector<std::string> warnings_about(const Rock& rock);

}  // namespace phy
