// Recipes for tests on a calibrated rock, by choosing values of keys.
#pragma once
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "base/check.hpp"
#include "records/field.hpp"
#include "records/recipe.hpp"

namespace phy::gui {

using Json = nlohmann::ordered_json;

/// What a control for a key is made of.
Json field_json(const Field& field);

/// The keys that a test may choose, and the laboratory tests: what a form is made of, from the one list.
Json keys_json();
Json kinds_json();

/// Of a test that keeps a stress on the specimen: that it has none. A recipe may say 0; chosen in a form, it
/// is a field that has been forgotten.
std::optional<Problem> missing_stress(const Recipe& recipe);

/// The recipe of a file with other values: path of a key to what would stand behind it in a recipe. Answers
/// the finished text, and what is wrong with which key: a wrong value leaves no text, a missing stress does.
/// Throws what io::read_recipe throws.
Json recipe_answer(const std::string& base, const std::map<std::string, std::string>& changes);

}  // namespace phy::gui
