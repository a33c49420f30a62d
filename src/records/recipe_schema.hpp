// THE list of recipe keys. The reader, the writer, `phyllite recipe --explain`, the template and
// docs/reference.md all come from it: a key that is not here does not exist.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "base/check.hpp"
#include "records/field.hpp"
#include "records/recipe.hpp"

namespace phy {

/// 32 bit contact numbers and memory; hours of computing.
constexpr std::int64_t max_recipe_grains = 1000000;

const Fields& recipe_fields();

/// Does a recipe that is written hold this key? Not if it is of another test, left out as by default, or
/// about planes that the set has not.
bool is_written(const Field& field, const Recipe& recipe, std::size_t index);
/// A value as it is written in a file.
std::string print_field(const Field& field, const Recipe& recipe, std::size_t index);
/// The keys that are not as by default, a line each: what fingerprints are taken of, so that a key that comes
/// to the list later changes none.
std::string keys_not_by_default(const Recipe& recipe);
/// Problems between keys (thickness against spacing, ...). `where(path)` tells file and line of a key; a
/// check is left out if one of its keys has a value that nobody means (`is_known(path)` is false).
std::vector<Problem> cross_checks(
    const Recipe& recipe, const std::function<std::string(const std::string&)>& where,
    const std::function<bool(const std::string&)>& is_known = [](const std::string&) { return true; });

}  // namespace phy
