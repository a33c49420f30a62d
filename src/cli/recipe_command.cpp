// `phyllite recipe`: what every key means, a template, the reference page. All of it comes from the schema.
#include <fmt/format.h>

#include "base/check.hpp"
#include "cli/commands.hpp"
#include "io/toml_in.hpp"
#include "records/recipe_schema.hpp"

namespace phy {
namespace {

Recipe with_one_set() {
  Recipe r;
  r.bedding.resize(1);
  return r;
}

void explain(const std::string& key) {
  std::vector<std::string> known;
  bool found = false;
  for (const Field& f : recipe_fields()) {
    known.push_back(f.path());
    known.push_back(f.key);
    if (f.path() != key && f.key != key) continue;
    found = true;
    fmt::print("{}\n  meaning   {}\n  allowed   {}\n  default   {}\n", f.path(), f.meaning, range_text(f),
               print_field(f, with_one_set(), 0));
    if (f.dimension != Dimension::none) fmt::print("  units     {}\n", unit_names(f.dimension));
    if (!f.pfc_name.empty()) fmt::print("  in PFC    {}\n", f.pfc_name);
  }
  if (found) return;
  const std::string near = nearest(key, known);
  throw InputError(
      Problem{"command line", "--explain", key, "a key of the recipe",
              near.empty() ? "see phyllite recipe --reference" : "did you mean \"" + near + "\"?"});
}

void reference() {
  fmt::print(
      "# Keys of a recipe\n\nWritten by `phyllite recipe --reference`. Every quantity carries its unit; a "
      "key that "
      "is left out has its default.\n");
  std::string table = "-";
  for (const Field& f : recipe_fields()) {
    if (f.table != table) {
      table = f.table;
      fmt::print("\n## {}\n\n| key | default | allowed | meaning | PFC |\n|---|---|---|---|---|\n",
                 table.empty()        ? "top level"
                 : table == "bedding" ? "[[bedding]]"
                                      : "[" + table + "]");
    }
    fmt::print("| `{}` | `{}` | {} | {} | {} |\n", f.key, print_field(f, with_one_set(), 0), range_text(f),
               f.meaning, f.pfc_name);
  }
}

}  // namespace

void add_recipe_command(CLI::App& app, Session& session) {
  struct Arguments {
    std::string key, file;
    bool reference = false, print_template = false;
  };
  auto args = std::make_shared<Arguments>();
  CLI::App* verb = app.add_subcommand("recipe", "explain the keys of a recipe, or check and complete one");
  verb->add_option("file", args->file, "recipe to check; prints it completed");
  verb->add_option("--explain", args->key, "meaning, range and default of a key");
  verb->add_flag("--reference", args->reference, "all keys as a Markdown page");
  verb->add_flag("--template", args->print_template, "a complete recipe with comments");
  verb->callback([args, &session] {
    session.exit_code = 0;
    if (!args->key.empty()) return explain(args->key);
    if (args->reference) return reference();
    if (args->print_template) return fmt::print("{}", commented_recipe(with_one_set()));
    if (args->file.empty())
      throw InputError(
          Problem{"command line", "recipe", "", "a file, --explain KEY, --reference or --template", ""});
    fmt::print("{}", write_recipe(read_recipe(args->file)));
  });
}

}  // namespace phy
