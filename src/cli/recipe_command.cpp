#include "cli/recipe_command.hpp"

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/spelling.hpp"
#include "cli/commands.hpp"
#include "cli/terminal.hpp"
#include "io/toml_in.hpp"
#include "records/recipe_schema.hpp"

namespace phy::cli {
namespace {

Recipe with_one_set() {
  Recipe r;
  r.bedding.resize(1);
  return r;
}

std::string explanation(const Field& f) {
  std::string text = fmt::format("{}\n  meaning   {}\n  allowed   {}\n  default   {}\n", f.path(), f.meaning,
                                 range_text(f), print_field(f, with_one_set(), 0));
  if (f.dimension != Dimension::none) text += fmt::format("  units     {}\n", unit_names(f.dimension));
  if (!f.pfc_name.empty()) text += fmt::format("  in PFC    {}\n", f.pfc_name);
  return text;
}

}  // namespace

std::string explain(const std::string& key) {
  std::string word = key;
  if (const std::size_t open = word.find('['), close = word.find(']'); open < close && close != word.npos)
    word.erase(open, close - open + 1);
  for (const bool in_pfc : {false, true}) {
    std::string text;
    for (const Field& f : recipe_fields())
      if (in_pfc ? has_pfc_name(f, word) : f.path() == word || f.key == word) text += explanation(f);
    if (!text.empty()) return text;
  }
  std::vector<std::string> known, longer;
  for (const Field& f : recipe_fields()) {
    known.push_back(word.find('.') == word.npos ? f.key : f.path());
    if (known.back().starts_with(word)) longer.push_back(known.back());
  }
  const std::string near = longer.empty() ? nearest(word, known) : longer.front();
  throw InputError(Problem{
      "command line", "--explain", key, "a key of the recipe",
      near.empty() ? "`phyllite recipe --reference` lists all keys" : "did you mean \"" + near + "\"?"});
}

std::string reference_markdown() {
  std::string text =
      "# Keys of a recipe\n\nWritten by `phyllite recipe --reference`. A quantity carries its unit, in "
      "quotes; a key "
      "that is left out has its default.\n";
  std::string table = "-";
  for (const Field& f : recipe_fields()) {
    if (f.table != table) {
      table = f.table;
      text += fmt::format("\n## {}\n\n| key | default | allowed | meaning | PFC |\n|---|---|---|---|---|\n",
                          table.empty()        ? "top level"
                          : table == "bedding" ? "[[bedding]]"
                                               : "[" + table + "]");
    }
    text += fmt::format("| `{}` | `{}` | {} | {} | {} |\n", f.key, print_field(f, with_one_set(), 0),
                        range_text(f), f.meaning, f.pfc_name);
  }
  return text;
}

std::string template_recipe() { return io::commented_recipe(with_one_set()); }

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
    std::string text;
    if (!args->key.empty())
      text = explain(args->key);
    else if (args->reference)
      text = reference_markdown();
    else if (args->print_template)
      text = template_recipe();
    else if (!args->file.empty())
      text = io::write_recipe(io::read_recipe(args->file));
    else
      throw InputError(Problem{"command line", "recipe", "",
                               "a file, --explain KEY, --reference or --template",
                               "for example `phyllite recipe --explain theta`"});
    write_out(text);
  });
}

}  // namespace phy::cli
