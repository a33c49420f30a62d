// What the keys of a file mean: `--explain KEY` and `--reference`, from the one list of each kind of file.
#pragma once
#include <string>
#include <vector>

#include "io/document.hpp"

namespace phy::jobs {

/// Meaning, allowed values, default, units and PFC name of a key: "theta", "bedding.theta",
/// "bedding[0].theta" as in messages, or PFC's name of it. A key of several tables is explained once for
/// each. Throws InputError if unknown.
std::string explain(const std::vector<const io::Schema*>& schemas, const std::string& key);
/// All keys of a file as a part of docs/reference.md.
std::string reference_markdown(const io::Schema& schema);

}  // namespace phy::jobs
