// `phyllite rock new NAME` and `phyllite rock check ROCK`: the laboratory's side of a calibration.
#include <fmt/format.h>

#include <filesystem>

#include "calibrate/foresee.hpp"
#include "cli/commands.hpp"
#include "io/file.hpp"
#include "io/rock_in.hpp"
#include "report/calibration_tables.hpp"

namespace phy {
namespace {

int rock_new(const std::string& name) {
  const std::filesystem::path toml(name + ".toml"), csv(name + ".csv");
  for (const auto& path : {toml, csv})
    if (std::filesystem::exists(path))
      throw InputError(
          Problem{"command line", "rock new", path.string(), "a name that is free", "nothing was written"});
  write_file(csv.string(), rock_table_template());
  write_file(toml.string(), rock_template(toml.stem().string()));
  fmt::print("{} and {}: fill in the table, then\n  phyllite rock check {}\n", toml.string(), csv.string(),
             toml.string());
  return 0;
}

int rock_check(const std::string& path) {
  const Rock rock = read_rock(path);
  fmt::print("rock      {} ({})\n", rock.name, path);
  for (const std::string& note : rock.notes) fmt::print("          {}\n", note);
  fmt::print("\n{}\n{}", target_table(targets_of(rock)), foresight_table(foresee(rock)));
  for (const std::string& line : advice(rock)) fmt::print("- {}\n", line);
  return 0;
}

}  // namespace

void add_rock_command(CLI::App& app, Session& session) {
  CLI::App* rock = app.add_subcommand("rock", "laboratory tables: write a template, or check one");
  rock->require_subcommand(1);
  auto name = std::make_shared<std::string>("rock");
  CLI::App* fresh = rock->add_subcommand("new", "write NAME.toml and NAME.csv to be filled in");
  fresh->add_option("name", *name, "name of the rock")->capture_default_str();
  fresh->callback([name, &session] { session.exit_code = rock_new(*name); });
  auto path = std::make_shared<std::string>();
  CLI::App* check = rock->add_subcommand("check", "what a rock's data can and cannot determine");
  check->add_option("rock", *path, "rock file (TOML)")->required();
  check->callback([path, &session] { session.exit_code = rock_check(*path); });
}

}  // namespace phy
