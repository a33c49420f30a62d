// `phyllite`: parses the command line, runs one verb, and is the only place that turns exceptions into exit
// codes.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <new>
#include <system_error>

#include "base/check.hpp"
#include "cli/commands.hpp"
#include "cli/terminal.hpp"
#include "records/recipe_schema.hpp"

namespace {

/// A word where a verb is missing, of phyllite itself or of a verb with verbs of its own.
phy::InputError unknown_verb(const CLI::App& app, const std::string& word) {
  if (word.starts_with("-"))
    return phy::InputError(phy::Problem{"command line", "option", word, "an option that --help lists", ""});
  const CLI::App* of = &app;
  while (!of->get_subcommands().empty()) of = of->get_subcommands().front();
  std::vector<std::string> verbs;
  std::string list;
  for (const CLI::App* verb : of->get_subcommands([](const CLI::App*) { return true; })) {
    verbs.push_back(verb->get_name());
    list += (list.empty() ? "" : ", ") + verbs.back();
  }
  const std::string near = phy::nearest(word, verbs);
  return phy::InputError(phy::Problem{"command line", "verb", word, "one of " + list,
                                      near.empty() ? "" : "did you mean " + near + "?"});
}

int run(int argc, char** argv) {
  phy::Session session;
  session.terminal_width = phy::terminal_size(STDOUT_FILENO).columns;
  CLI::App app{"Phyllite: a laboratory for layered rock. Bonded-particle models in two dimensions."};
  app.set_version_flag("--version", std::string("phyllite ") + PHY_VERSION);
  app.add_option("--threads", session.threads, "worker threads; 0 = all cores")->check(CLI::Range(0, 1024));
  app.require_subcommand(1);
  app.fallthrough();
  phy::add_run_command(app, session);
  phy::add_specimen_command(app, session);
  phy::add_verify_command(app, session);
  phy::add_recipe_command(app, session);
  phy::add_contact_command(app, session);
  phy::add_study_command(app, session);
  phy::add_elastic_command(app, session);
  phy::add_rock_command(app, session);
  phy::add_show_command(app, session);
  phy::add_calibrate_command(app, session);
  phy::add_report_command(app, session);
  phy::add_figure_command(app, session);
  phy::add_film_command(app, session);
  phy::add_envelope_command(app, session);
  try {
    app.parse(argc, argv);
  } catch (const CLI::RequiredError& e) {
    if (const auto lost = app.remaining(true); !lost.empty()) throw unknown_verb(app, lost.front());
    return app.exit(e) == 0 ? 0 : 2;
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw std::system_error(errno, std::generic_category());
  return session.exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const phy::InputError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 2;
  } catch (const phy::IoError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 3;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "not enough memory; use fewer grains, or fewer lanes (--lanes)\n");
    return 4;
  } catch (const std::system_error& e) {  // a full disk behind a redirected output
    fmt::print(stderr, "{}: {}\n", std::ferror(stdout) != 0 ? "standard output cannot be written" : "system",
               e.what());
    return 3;
  } catch (const std::exception& e) {
    fmt::print(stderr, "internal error, please report it: {}\n", e.what());
    return 4;
  }
}
