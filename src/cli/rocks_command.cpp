// `phyllite rocks [NAME]`: the measured rocks that come with the program.
#include <filesystem>

#include "base/quote.hpp"
#include "cli/suggested.hpp"
#include "cli/terminal.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "jobs/rock_base.hpp"
#include "report/rock_cards.hpp"

namespace phy::cli {
namespace {

struct RocksArguments {
  std::string name, out;
};

void list_rocks(int width) {
  std::vector<std::string_view> cards;
  for (const std::string& name : jobs::base_rocks()) cards.push_back(jobs::base_card(name));
  write_out(report::rock_list(cards, width));
  print_wrapped(
      width, 2,
      "\nOne of them: phyllite rocks NAME. Its files: phyllite rocks NAME --out FOLDER. A new rock like it: "
      "phyllite rock new mine --like NAME\n");
}

/// The table, the rock file and the calibrated model.
void write_files(const RocksArguments& args) {
  const std::vector<jobs::BaseFile> files = jobs::base_files(args.name);
  std::vector<std::string> paths;
  for (const jobs::BaseFile& file : files)
    paths.push_back((std::filesystem::path(args.out) / file.name).string());
  // Whoever has changed a copy, to try something, keeps it.
  io::check_outputs(paths);
  io::check_writable(args.out);
  for (std::size_t i = 0; i < files.size(); ++i) io::write_output(paths[i], files[i].text);
  print_out("{}: {} files; what its table determines:\n  phyllite rock check {}\n", args.out, files.size(),
            shell_word(paths.front()));
}

}  // namespace

void add_rocks_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<RocksArguments>();
  CLI::App* verb =
      app.add_subcommand("rocks", "measured rocks that come with the program, and how well each is met");
  verb->add_option("name", args->name, "one of them: its card")->check(suggested(jobs::base_rocks));
  verb->add_option("--out", args->out, "write table, rock file and calibrated model of this rock here")
      ->type_name("FOLDER");
  verb->callback([args, &session] {
    session.exit_code = 0;
    if (args->name.empty() && !args->out.empty())
      throw InputError(Problem{"command line", "--out", args->out, "the name of a rock before it",
                               "phyllite rocks lists them"});
    if (args->name.empty())
      list_rocks(session.terminal_width);
    else if (args->out.empty())
      write_out(report::rock_card(jobs::base_card(args->name), session.terminal_width));
    else
      write_files(*args);
  });
}

}  // namespace phy::cli
