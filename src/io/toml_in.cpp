#include "io/toml_in.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <tuple>

#include "base/quote.hpp"
#include "base/spelling.hpp"
#include "io/csv.hpp"
#include "io/document.hpp"
#include "io/file.hpp"
#include "io/file_kinds.hpp"
#include "records/recipe_schema.hpp"
#include "records/test_description.hpp"

namespace phy::io {
namespace {

/// Studies and rocks name a recipe, no recipe does. With no other key of theirs it may be either.
void refuse_named_recipe(const TomlValue& root, const std::string& where) {
  refuse_other_kind(root, where, recipe_schema().name);
  const TomlValue* recipe = root.find("recipe");
  if (recipe != nullptr)
    throw InputError(
        Problem{at_line(where, recipe->line), "recipe", as_written(*recipe), "",
                "a recipe names no other. A study and a rock do: `phyllite study`, `phyllite rock check`"});
}

void assign(const Field& f, const Document& file, const std::string& path, Recipe& recipe, std::size_t set) {
  // Only what was given and could be read; all else stays at its default.
  if (file.find(path) == nullptr || !file.is_known(path)) return;
  if (f.set_text)
    f.set_text(recipe, file.text(path, ""));
  else if (f.list)
    f.list(recipe) = file.list(path);
  else
    f.set(recipe, set, file.number(path, 0.0));
}

std::string write(const Recipe& recipe, bool comments) {
  std::string text;
  const auto line = [&](const Field& f, std::size_t index) {
    // A key that says nothing here is left out, so that texts and fingerprints of recipes do not change when
    // a test gets a key, or bedding one more property (docs/decisions/0010).
    if (!comments && !is_written(f, recipe, index)) return;
    if (comments) {
      text += "# " + f.meaning + "; " + range_text(f);
      if (!f.pfc_name.empty()) text += "; PFC: " + f.pfc_name;
      text += "\n";
    }
    text += f.key + " = " + print_field(f, recipe, index) + "\n";
  };
  std::string table;
  for (const Field& f : recipe_fields()) {
    if (f.table == "bedding") continue;
    if (f.table != table) text += "\n[" + f.table + "]\n", table = f.table;
    line(f, 0);
  }
  // Bedding last: [[bedding]] opens a table for everything below it.
  for (std::size_t i = 0; i < recipe.bedding.size(); ++i) {
    text += "\n[[bedding]]\n";
    for (const Field& f : recipe_fields())
      if (f.table == "bedding") line(f, i);
  }
  return text;
}

/// Discs of a file that no packing can hold, each with its line.
std::vector<Problem> misplaced_discs(const DiscFile& file, const Recipe& recipe) {
  std::vector<Problem> problems;
  const SpecimenSize& size = recipe.specimen;
  const double side = std::min(size.width, size.height), smallest = 1e-4 * side;  // as genesis::adopt_packing
  for (std::size_t i = 0; i < file.discs.size(); ++i) {
    const Disc& d = file.discs[i];
    const auto report = [&](const std::string& value, const std::string& expected) {
      problems.push_back({recipe.packing.file + ":" + std::to_string(file.lines[i]), "disc", value, expected,
                          "check the units, and the origin: the lower left corner of the specimen"});
    };
    if (!(d.r >= smallest && d.r < 0.5 * side))
      report(print_quantity(d.r, Dimension::length),
             "a radius from 1/10000 to less than 1/2 of the smaller side");
    if (!(d.x > 0.0 && d.x < size.width && d.y > 0.0 && d.y < size.height))
      report(
          "(" + print_quantity(d.x, Dimension::length) + ", " + print_quantity(d.y, Dimension::length) + ")",
          "a centre inside the specimen, 0 < x < width, 0 < y < height");
  }
  if (file.discs.size() > static_cast<std::size_t>(max_recipe_grains))
    problems.push_back({recipe.packing.file, "", std::to_string(file.discs.size()) + " discs",
                        "at most " + std::to_string(max_recipe_grains), ""});
  return problems;
}

/// Contradictions between a recipe and the disc file that it imports.
std::vector<Problem> disc_problems(const Recipe& recipe, const std::string& where) {
  const DiscFile file = parse_discs(read_file(recipe.packing.file), recipe.packing.file);
  std::vector<Problem> problems;
  const auto length = [](double v) { return print_quantity(v, Dimension::length); };
  const auto differs = [](double box, double size) {
    // Relative: the size in the file may have been rounded when it was written.
    return box > 0.0 && std::fabs(box - size) > 1e-6 * box;
  };
  for (const auto& [key, box, size] : {std::tuple{"width", file.width, recipe.specimen.width},
                                       std::tuple{"height", file.height, recipe.specimen.height}})
    if (differs(box, size))
      problems.push_back({where, std::string("specimen.") + key, length(size),
                          "the box of " + recipe.packing.file + ", " + length(box),
                          std::string("write ") + key + " = \"" + length(box) + "\" under [specimen]"});
  for (Problem& p : misplaced_discs(file, recipe)) problems.push_back(std::move(p));
  const std::int64_t n = recipe.packing.n_grains, usual = Recipe{}.packing.n_grains;
  // A completed recipe holds the default beside the file.
  if (n != usual && n > 0 && n != static_cast<std::int64_t>(file.discs.size()))
    problems.push_back({where, "packing.n_grains", std::to_string(n),
                        "no number of grains beside packing.file",
                        "the file has " + std::to_string(file.discs.size()) + " discs: leave it out"});
  double largest = 0.0;
  for (const Disc& d : file.discs) largest = std::max(largest, 2.0 * d.r);
  // With the discs of the file: the radii of the recipe, which the usual check takes, mean nothing beside it.
  if (recipe.matrix.bond_gap > largest)
    problems.push_back({where, "matrix.bond_gap", length(recipe.matrix.bond_gap),
                        "at most the largest grain diameter, " + length(largest),
                        "wider bonds would reach past a neighbour"});
  for (std::size_t i = 0; i < recipe.bedding.size(); ++i)
    if (recipe.bedding[i].has_planes() && recipe.bedding[i].spacing < largest)
      problems.push_back({where, "bedding[" + std::to_string(i) + "].spacing",
                          length(recipe.bedding[i].spacing),
                          "at least the largest grain diameter, " + length(largest),
                          "use a wider spacing or smaller grains"});
  return problems;
}

}  // namespace

const Schema& recipe_schema() {
  static const Schema schema{"recipe", "recipe", recipe_fields(), {{"bedding", 16}}, ""};
  return schema;
}

namespace {

/// `problems`: what is known to be wrong with it.
Recipe recipe_of_tree(TomlValue root, const std::string& where, std::vector<Problem> problems) {
  refuse_named_recipe(root, where);
  const bool empty = root.keys.empty();
  Document file(std::move(root), where, recipe_schema(), std::move(problems));
  Recipe recipe;
  if (empty)
    file.notes.push_back("nothing is stated: this is the paper's intact specimen, of " +
                         std::to_string(recipe.packing.n_grains) +
                         " discs; `phyllite recipe --template` begins a recipe");
  // A set of defaults for each [[bedding]] table.
  recipe.bedding.resize(file.tables("bedding").size());
  for (const Field& f : recipe_fields())
    if (f.table != "bedding")
      assign(f, file, f.path(), recipe, 0);
    else
      for (std::size_t i = 0; i < recipe.bedding.size(); ++i)
        assign(f, file, "bedding[" + std::to_string(i) + "]." + f.key, recipe, i);
  // The defaults give a number of grains; a file that gives a porosity means it instead.
  if (file.find("packing.porosity") != nullptr && file.find("packing.n_grains") == nullptr)
    recipe.packing.n_grains = 0;
  // Checks between keys are left out where a key was misread.
  for (Problem& p : cross_checks(
           recipe, [&](const std::string& path) { return file.place(path); },
           [&](const std::string& path) { return file.is_known(path); }))
    file.problems.push_back(std::move(p));
  file.check();
  recipe.notes = std::move(file.notes);
  return recipe;
}

/// The recipe with the file that it imports, if any, found from the folder of `path` and looked into.
Recipe with_discs(Recipe recipe, const std::string& path) {
  if (recipe.packing.file.empty()) return recipe;
  const auto folder = std::filesystem::absolute(path).parent_path();
  // Stored as an absolute path: a recipe is kept in folders and stores, from which the relative one would not
  // lead back.
  recipe.packing.file = (folder / recipe.packing.file).lexically_normal().string();
  if (!is_plain(recipe.packing.file))  // the name of a folder above it
    throw InputError(Problem{path, "packing.file", recipe.packing.file,
                             "a place whose name is UTF-8 without control characters", "rename the folder"});
  std::vector<Problem> problems = disc_problems(recipe, path);
  if (!problems.empty()) throw InputError(std::move(problems));
  return recipe;
}

}  // namespace

Recipe parse_recipe(std::string_view text, const std::string& where) {
  std::vector<Problem> problems;
  TomlValue root = parse_toml(text, where, problems);
  return recipe_of_tree(std::move(root), where, std::move(problems));
}

Recipe read_recipe(const std::string& path) {
  return with_discs(parse_recipe(read_user_file(path, recipe_schema().name), path), path);
}

Recipe recipe_of(TomlValue keys, const std::string& where) {
  return with_discs(recipe_of_tree(std::move(keys), where, {}), where);
}

std::string recipe_key_hint(const std::string& word) {
  std::vector<std::string> known;
  std::string with_table;
  for (const Field& f : recipe_fields()) {
    known.push_back(f.path());
    if (f.key == word && !f.table.empty())
      with_table += (with_table.empty() ? "\"" : " or \"") + f.path() + "\"";
  }
  if (!with_table.empty()) return "name its table too: " + with_table;
  const std::string near = nearest(word, known);
  return near.empty() ? "`phyllite recipe --reference` lists all keys" : "did you mean \"" + near + "\"?";
}

std::string write_recipe(const Recipe& recipe) { return write(recipe, false); }

std::string commented_recipe(const Recipe& recipe) { return write(recipe, true); }

}  // namespace phy::io
