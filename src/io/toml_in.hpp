// Recipes as TOML files. All problems of a file are reported at once.
#pragma once
#include <string>
#include <string_view>

#include "io/document.hpp"
#include "records/recipe.hpp"

namespace phy::io {

const Schema& recipe_schema();

/// Reads, checks and completes a recipe. packing.file is found from the recipe's folder, becomes absolute,
/// and its box and grains are held against the recipe. Throws IoError (unreadable) or InputError with every
/// problem found.
Recipe read_recipe(const std::string& path);
/// The same from text; `where` names the source in messages.
Recipe parse_recipe(std::string_view text, const std::string& where);
/// As read_recipe, from keys that stand in no file; packing.file counts from the working directory.
Recipe recipe_of(TomlValue keys, const std::string& where);
/// What to do about a word that is no key of the recipe: the table it lacks, the nearest key, or where all
/// are listed.
std::string recipe_key_hint(const std::string& word);
/// The completed recipe: every key with its value, in units that read back to the same bits.
std::string write_recipe(const Recipe& recipe);
/// As write_recipe, with meaning and range of every key as a comment.
std::string commented_recipe(const Recipe& recipe);

}  // namespace phy::io
