// `phyllite recipe`: what every key means, a template, the reference page. All of it comes from the schema.
#include "base/check.hpp"
#include "cli/commands.hpp"
#include "cli/suggested.hpp"
#include "cli/terminal.hpp"
#include "io/toml_in.hpp"
#include "jobs/keys.hpp"
#include "report/pfc_commands.hpp"

namespace phy::cli {

namespace {

/// The paper's specimen with one set of bedding, with comments.
std::string template_recipe() {
  Recipe r;
  // A default recipe has no bedding, and its keys would be missing from the template.
  r.bedding.resize(1);
  return io::commented_recipe(r);
}

}  // namespace

void add_recipe_command(CLI::App& app, Session& session) {
  struct Arguments {
    std::string key, file;
    bool reference = false, print_template = false, pfc = false;
  };
  auto args = std::make_shared<Arguments>();
  CLI::App* verb = app.add_subcommand("recipe", "explain the keys of a recipe, or check and complete one");
  CLI::Option* file =
      verb->add_option("file", args->file, "recipe to check; prints it completed")->type_name("FILE");
  verb->add_option("--explain", args->key, "meaning, range and default of a key")
      ->type_name("KEY")
      ->check(suggested([] { return keys_of({&io::recipe_schema()}); }));
  verb->add_flag("--reference", args->reference, "all keys as a Markdown page");
  verb->add_flag("--pfc", args->pfc, "the file as commands for PFC2D 6 and later")->needs(file);
  verb->add_flag("--template", args->print_template, "a complete recipe with comments");
  verb->callback([args, &session] {
    session.exit_code = 0;
    std::string text;
    if (!args->key.empty())
      text = jobs::explain({&io::recipe_schema()}, args->key);
    else if (args->reference)
      text = jobs::reference_markdown(io::recipe_schema());
    else if (args->print_template)
      text = template_recipe();
    else if (!args->file.empty())
      // Read and written again, so that the output shows every default in force.
      text = args->pfc ? report::pfc_commands(io::read_recipe(args->file))
                       : io::write_recipe(io::read_recipe(args->file));
    else
      throw InputError(Problem{"command line", "recipe", "",
                               "a file, --explain KEY, --reference or --template",
                               "for example `phyllite recipe --explain theta`"});
    write_out(text);
  });
}

}  // namespace phy::cli
