// What is reported where a folder holds something that was made by another recipe.
#pragma once
#include <string>
#include <vector>

#include "base/check.hpp"
#include "study/experiment.hpp"

namespace phy::jobs {

/// A problem for each key that differs, `one` being what lies at `where`; of more than six the first five and
/// how many there are. `as_in`: where the other value stands, "as in rock.toml".
std::vector<Problem> problems_of(const std::string& where,
                                 const std::vector<study::RecipeDifference>& differences,
                                 const std::string& as_in, const std::string& remedy);

}  // namespace phy::jobs
