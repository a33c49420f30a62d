// What the data of a rock can and cannot determine, before anything runs.
#pragma once
#include <string>

#include "records/rock.hpp"

namespace phy::jobs {

/// The table as it was understood, what it says by itself, what it would determine, the verdict foretold.
/// `path`: the file of the rock, as named to its user.
std::string rock_check(const Rock& read, const std::string& path, int width);

}  // namespace phy::jobs
