// `phyllite`: parses the command line, runs one verb, and is the only place that turns exceptions into exit
// codes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <new>
#include <system_error>

#include "base/check.hpp"
#include "base/embedded.hpp"
#include "base/quote.hpp"
#include "base/spelling.hpp"
#include "base/version.hpp"
#include "cli/commands.hpp"
#include "cli/terminal.hpp"
#include "genesis/settle.hpp"
#include "jobs/failure.hpp"
#include "records/recipe_schema.hpp"
#include "system/process.hpp"
#include "system/terminal.hpp"

namespace {

using Names = std::vector<std::string>;

std::string hint(const std::string& word, const Names& names, const std::string& otherwise) {
  if (word == "lab" && std::ranges::find(names, "gui") != names.end())
    return "the page in the browser is `phyllite gui`";  // its name until 0.1
  const std::string near = phy::nearest(word, names);
  return near.empty() ? otherwise : "did you mean " + near + "?";
}

Names verbs_of(const CLI::App& app) {
  Names verbs;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    verbs.push_back(verb->get_name());
  return verbs;
}

Names options_of(const CLI::App& app) {
  Names options;
  for (const CLI::Option* option : app.get_options())
    // Short names are no words that can be misspelt.
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  if (app.get_parent() != nullptr)
    for (std::string& name : options_of(*app.get_parent())) options.push_back(std::move(name));
  return options;
}

/// What is wrong with the command line: words that have no place, or what the parser says.
phy::InputError wrong_command_line(const CLI::App& app, const CLI::ParseError& e) {
  const CLI::App* of = &app;
  std::string name = app.get_name();
  // The verb that was typed last is the one whose help is of use.
  while (!of->get_subcommands().empty()) {
    of = of->get_subcommands().front();
    name += " " + of->get_name();
  }
  const std::string help = fmt::format("see `{} --help`", name);
  const Names verbs = verbs_of(*of), lost = app.remaining(true);
  const std::string one_of = fmt::format("one of {}", fmt::join(verbs, ", "));
  std::vector<phy::Problem> problems;
  for (const std::string& word : lost)
    if (word.starts_with("-"))
      // All unknown options in one message: one more try is enough.
      problems.push_back(
          {"command line", "option", word, "an option of " + name, hint(word, options_of(*of), help)});
  // Unknown options first: what follows one is mostly its value, and no word of its own.
  if (!problems.empty()) return phy::InputError(problems);
  if (!verbs.empty() && (!lost.empty() || of->get_require_subcommand_min() > 0)) {
    const std::string word = lost.empty() ? "" : lost.front();
    return phy::InputError(phy::Problem{"command line", "verb", word, one_of, hint(word, verbs, help)});
  }
  if (!lost.empty())
    return phy::InputError(phy::Problem{"command line", "", fmt::format("{}", fmt::join(lost, " ")),
                                        "nothing more after " + name, "put a name with spaces in quotes"});
  // What the parser refuses for a reason of its own, such as a value out of range, it words itself.
  return phy::InputError(phy::Problem{fmt::format("command line: {}; {}", e.what(), help), "", "", "", ""});
}

/// An empty name of a file or folder would be the folder that the shell is in.
void refuse_empty_names(CLI::App& app) {
  for (CLI::Option* option : app.get_options())
    if (const std::string type = option->get_type_name(); type == "FILE" || type == "FOLDER")
      // A script with an unset variable passes "", and results would be spread over the current folder.
      option->check([type](const std::string& name) {
        return name.empty() ? fmt::format("the name of a {} is empty", type == "FILE" ? "file" : "folder")
                            : std::string();
      });
  for (CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) refuse_empty_names(*verb);
}

/// In the order of --help. `man` and `completion`, which describe all others, come last.
constexpr auto verbs = [] {
  using namespace phy::cli;
  return std::array{add_run_command,     add_specimen_command,  add_verify_command,  add_recipe_command,
                    add_contact_command, add_study_command,     add_elastic_command, add_rock_command,
                    add_rocks_command,   add_show_command,      add_replay_command,  add_calibrate_command,
                    add_report_command,  add_figure_command,    add_film_command,    add_export_command,
                    add_compare_command, add_envelope_command,  add_design_command,  add_gui_command,
                    add_man_command,     add_completion_command};
}();

int run(std::vector<std::string> words) {
  phy::cli::Session session;
  // Of standard output alone: piped into a file, tables stay as wide as they are.
  session.terminal_width = phy::system::terminal_size(phy::system::standard_output).columns;
  CLI::App app{"Phyllite: a laboratory for layered rock. Bonded-particle models in two dimensions.",
               "phyllite"};
  app.set_version_flag("--version", std::string(phy::program));
  app.add_flag_callback(
      "--licences",
      [] {
        const std::string_view text = phy::embedded("packaging/copyright");
        // The parser prints it and ends as for --version: with 0, before any verb is asked for.
        throw CLI::CallForVersion(std::string(text.substr(0, text.rfind('\n'))),
                                  0);  // it ends the line itself
      },
      "print the licences of the program and of its parts");
  app.add_option("--threads", session.threads, "worker threads; 0 = all cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  // Without a verb there is nothing to do, and an exit code of 0 would let a script go on.
  app.require_subcommand(1);
  // --threads may stand behind the verb, too.
  app.fallthrough();
  for (const auto add : verbs) add(app, session);
  // When all verbs are there, as it walks the whole tree.
  refuse_empty_names(app);
  try {
    std::ranges::reverse(words);  // as the parser takes them
    app.parse(std::move(words));
  } catch (const CLI::ParseError& e) {
    // The parser's own messages name one fault and no remedy; help and version end with 0.
    if (e.get_exit_code() != 0) throw wrong_command_line(app, e);
    app.exit(e);  // --help, --version
    std::cout.flush();
  }
  // A pipe that was closed or a full disk: what was to be kept is in files already.
  if (const int error = phy::cli::lost_output(); error != 0) {
    phy::cli::write_err(fmt::format("standard output cannot be written: {}\n", std::strerror(error)));
    return 3;
  }
  return session.exit_code;
}

/// Says what went wrong, without asking for memory; the exit code.
int say(int exit_code, const char* begin, const char* what) {
  for (const char* part : {begin, what, "\n"}) phy::cli::write_err(part);
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  // First of all: a file opened while descriptor 1 is closed would receive what is printed.
  phy::system::guard_standard_streams();
  try {
    return run(phy::system::arguments(argc, argv));
  } catch (const phy::InputError& e) {
    return say(2, "", phy::terminal_text(e.what()).c_str());
  } catch (const phy::IoError& e) {
    return say(3, "", phy::terminal_text(e.what()).c_str());
  } catch (const phy::genesis::Interrupted& e) {
    return say(1, "", e.what());
    // After a failed allocation no message can be put together: a fixed text, written as it is.
  } catch (const std::bad_alloc&) {
    return say(4, "", "not enough memory; use fewer grains, or fewer lanes (--lanes)");
    // Before system_error, its base, which would call a missing permission a fault of the system.
  } catch (const std::filesystem::filesystem_error& e) {
    return say(3, "", phy::terminal_text(phy::jobs::in_words(e)).c_str());
  } catch (const std::system_error& e) {
    // Threads, mostly: the system has no more of them.
    return say(3, "system: ", e.what());
  } catch (const std::exception& e) {
    // Whatever else arrives here was thrown by a check of our own, and is a bug.
    return say(4, phy::jobs::internal, e.what());
  }
}
