// `phyllite rock new NAME`, `phyllite rock check ROCK` and `phyllite rock twin RECIPE NAME`: the laboratory's
// side of a calibration.
#include <fmt/format.h>

#include <filesystem>

#include "base/largest_file.hpp"
#include "base/quote.hpp"
#include "calibrate/twin.hpp"
#include "cli/machine.hpp"
#include "cli/suggested.hpp"
#include "cli/terminal.hpp"
#include "io/file.hpp"
#include "io/toml_in.hpp"
#include "jobs/check_summary.hpp"
#include "jobs/keys.hpp"
#include "jobs/rock_base.hpp"
#include "jobs/tables_reference.hpp"
#include "rock/file.hpp"
#include "rock/schema.hpp"
#include "rock/template.hpp"

namespace phy::cli {
namespace {

/// Throws InputError unless the files NAME + ending can be made, and a TOML string can hold the name.
void check_free(const char* verb, const std::string& name, const std::vector<std::string>& endings) {
  const std::string stem = std::filesystem::path(name).filename().string();
  // The name goes into NAME.toml as a text, where a quote would end it.
  if (stem.empty() || !is_plain(stem) || stem.find_first_of("\"\\") != stem.npos)
    throw InputError(Problem{"command line", verb, '\'' + name + '\'',
                             "a name in UTF-8, without quotes and backslashes", "for example grey-shale"});
  for (const std::string& ending : endings)
    if (std::filesystem::exists(name + ending))
      throw InputError(
          Problem{"command line", verb, name + ending, "a name that is free", "nothing was written"});
}

/// Who gives the file that will be written, or a table, means the name of the rock.
std::string without_ending(const std::string& name) {
  for (const char* ending : {".toml", ".csv", ".tsv", ".xlsx", ".xls"})
    if (name.ends_with(ending)) return name.substr(0, name.size() - std::string_view(ending).size());
  return name;
}

/// `given`: as typed, maybe with an ending. A table that is there is no table to be written.
void check_no_table(const std::string& given) {
  const std::string name = without_ending(given);
  // `rock new shale.xlsx` means a table that is there, most probably: tell how to use it instead of writing
  // another.
  const std::string table = given != name && !given.ends_with(".toml") ? given : name + ".csv";
  if (std::filesystem::exists(table))
    throw InputError(
        Problem{"command line", "rock new", table, "",
                fmt::format("the file is there already. If it is your table: phyllite rock new {} "
                            "--data {}",
                            shell_word(name), shell_word(table))});
}

/// `data`: a table that is there; without it one is written, too. `like`: a measured rock, or nothing.
int rock_new(const std::string& given, const std::string& data, const std::string& like) {
  const rock::Start start = like.empty() ? rock::Start() : jobs::start_like(like);
  const std::string name = without_ending(given);
  check_free("rock new", name, {".toml"});
  const std::filesystem::path toml(name + ".toml"), csv(name + ".csv");
  const std::string stem = toml.stem().string();
  if (!data.empty()) {
    if (std::filesystem::path(data).extension() == ".toml")
      throw InputError(Problem{"command line", "--data", data, "a table of tests: CSV, text, .xlsx or AGS 4",
                               "a .toml file holds keys; nothing was written"});
    io::read_file(data, largest_table);  // a file, and none that is too large
    const std::filesystem::path from = std::filesystem::absolute(toml).parent_path();
    const std::string table =
        // Relative to the rock file, as it will be read, so that both can be moved together.
        std::filesystem::proximate(std::filesystem::absolute(data), from).generic_string();
    io::write_file(toml.string(), rock::rock_template(stem, table, start));
    print_out("{} names the table; how it is read and what it determines:\n  phyllite rock check {}\n",
              toml.string(), shell_word(toml.string()));
    return 0;
  }
  check_no_table(given);
  io::write_file(csv.string(), rock::rock_table_template());
  try {
    io::write_file(toml.string(), rock::rock_template(stem, stem + ".csv", start));
  } catch (const IoError&) {
    std::filesystem::remove(csv);  // both or none: the next try wants free names
    throw;
  }
  print_out("{} and {}: fill in the table, then\n  phyllite rock check {}\n", toml.string(), csv.string(),
            shell_word(toml.string()));
  return 0;
}

int rock_check(const std::string& path, bool all, const Session& session) {
  write_out(jobs::rock_check(rock::read_rock(path), path, session.terminal_width, n_threads(session), all));
  // The short form answers most questions; the long one has pages.
  if (!all) write_out("Details: phyllite rock check " + shell_word(path) + " --all\n");
  return 0;
}

int rock_twin(const std::string& recipe_file, const std::string& name, ModulusReading E_is,
              const Session& session) {
  check_free("rock twin", name, {".csv"});
  Recipe truth = io::read_recipe(recipe_file);
  print_notes(truth.notes, session.terminal_width);
  calibrate::TwinOptions options;
  if (truth.bedding.empty())
    // Isotropic rock has the same response at every angle: one is enough, and costs a seventh.
    options.angles = {0.0};
  else if (!truth.test.angles.empty())
    options.angles = truth.test.angles;
  calibrate::SimulatorOptions machine;
  machine.threads = n_threads(session);
  machine.stop = stop_on_interrupt();
  const auto simulator = calibrate::make_simulator(machine);
  std::vector<Comparison> response;
  try {
    response = calibrate::twin_response(truth, options.angles, options.seeds, *simulator, E_is);
    // A mean of some packings would be a table of another truth.
  } catch (const calibrate::Stopped&) {
    print_out("stopped, nothing was written\n");
    return 1;
  }
  // The table says how it was made: a synthetic one must not pass for a laboratory's.
  const std::string about = fmt::format(
      "# Made by `phyllite rock twin {}`: mean response of {} packings (seeds {} ... {}), {} specimens per\n"
      "# angle, each quantity of each specimen times 1 + {:g} x a standard normal number; E_is = \"{}\".\n",
      comment_text(recipe_file), options.seeds.size(), options.seeds.front(), options.seeds.back(),
      options.n_specimens, options.noise, to_string(E_is));
  io::write_file(name + ".csv", about + calibrate::readings_csv(calibrate::twin_readings(response, options),
                                                                !truth.bedding.empty()));
  print_out("{:>6} {:>10} {:>8} {:>10}\n", "theta", "E [GPa]", "nu", "UCS [MPa]");
  // The response lists all E first, then all nu, then all UCS, each in the order of the angles.
  const std::size_t n = options.angles.size();
  for (std::size_t i = 0; i < n; ++i)
    print_out("{:>6g} {:>10.3f} {:>8.4f} {:>10.2f}\n", options.angles[i], response[i].mean * 1e-9,
              response[n + i].mean, response[2 * n + i].mean * 1e-6);
  print_out("the noise-free response; with noise in {}.csv\n", name);
  return 0;
}

void add_new(CLI::App& rock, Session& session) {
  auto name = std::make_shared<std::string>("rock"), data = std::make_shared<std::string>(),
       like = std::make_shared<std::string>();
  CLI::App* verb = rock.add_subcommand("new", "write NAME.toml and NAME.csv to be filled in");
  verb->add_option("name", *name, "name of the rock")->capture_default_str();
  verb->add_option(
          "--data", *data,
          "a table that is there (CSV, .xlsx, AGS 4): NAME.toml names it, and no NAME.csv is written")
      ->type_name("FILE");
  verb->add_option("--like", *like,
                   "a measured rock (phyllite rocks): begin with its grain size, spacing and model")
      ->type_name("ROCK")
      ->check(suggested(jobs::base_rocks));
  verb->callback([name, data, like, &session] { session.exit_code = rock_new(*name, *data, *like); });
}

void add_check(CLI::App& rock, Session& session) {
  auto path = std::make_shared<std::string>();
  auto all = std::make_shared<bool>(false);
  CLI::App* verb = rock.add_subcommand(
      "check", "how a table is read, what it leaves open, and how a calibration will probably end");
  verb->add_option("rock", *path, "rock file (TOML)")->required()->type_name("FILE");
  verb->add_flag("--all", *all, "every detail: values, closed forms, parameters, limits, maps");
  verb->callback([path, all, &session] { session.exit_code = rock_check(*path, *all, session); });
}

void add_twin(CLI::App& rock, Session& session) {
  auto recipe = std::make_shared<std::string>(), name = std::make_shared<std::string>();
  auto E_is = std::make_shared<std::string>(to_string(ModulusReading::tangent_50));
  const std::vector<std::string> readings = find_field(rock::rock_schema().fields, "E_is")->choices;
  CLI::App* verb = rock.add_subcommand(
      "twin", "write NAME.csv: a synthetic table made by the model itself, with 5 % noise");
  verb->add_option("recipe", *recipe, "recipe of the true model (TOML)")->required()->type_name("FILE");
  verb->add_option("name", *name, "name of the table")->required();
  verb->add_option("--E-is", *E_is, "what the table calls E, as in a rock file")
      ->check(CLI::IsMember(readings))
      ->capture_default_str();
  verb->callback([=, &session] {
    const auto which = std::find(readings.begin(), readings.end(), *E_is) - readings.begin();
    session.exit_code =
        rock_twin(*recipe, without_ending(*name), static_cast<ModulusReading>(which), session);
  });
}

}  // namespace

void add_rock_command(CLI::App& app, Session& session) {
  CLI::App* rock =
      app.add_subcommand("rock", "laboratory tables: write a template, check one, or make a synthetic one");
  // None is allowed: --explain and --reference belong to the group itself.
  rock->require_subcommand(0, 1);
  auto key = std::make_shared<std::string>();
  auto reference = std::make_shared<bool>(false), tables = std::make_shared<bool>(false);
  rock->add_option("--explain", *key, "meaning, range and default of a key of a rock file")
      ->type_name("KEY")
      ->check(suggested([] { return keys_of({&rock::rock_schema()}); }));
  rock->add_flag("--reference", *reference, "print all keys of a rock file");
  rock->add_flag("--tables", *tables, "print the layouts, columns and units that are read from a table");
  rock->callback([=, &session] {
    if (!rock->get_subcommands().empty()) return;
    if (key->empty() && !*reference && !*tables)
      throw InputError(
          Problem{"command line", "verb", "", "one of new, check, twin", "see `phyllite rock --help`"});
    write_out(*tables      ? jobs::tables_reference()
              : *reference ? "\n" + jobs::reference_markdown(rock::rock_schema())
                           : jobs::explain({&rock::rock_schema()}, *key));
    session.exit_code = 0;
  });
  add_new(*rock, session), add_check(*rock, session), add_twin(*rock, session);
}

}  // namespace phy::cli
