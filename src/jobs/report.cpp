#include "jobs/report.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/check.hpp"
#include "io/json.hpp"
#include "io/load.hpp"
#include "io/load_variation.hpp"
#include "io/output.hpp"
#include "io/table.hpp"
#include "jobs/calibration_folder.hpp"
#include "jobs/run_folder.hpp"

namespace phy::jobs {
namespace {

namespace fs = std::filesystem;

bool has(const std::string& folder, const char* file) {
  std::error_code none;
  return fs::exists(fs::path(folder) / file, none);
}
std::string text_of(const std::string& folder, const char* file) {
  return has(folder, file) ? io::read_written((fs::path(folder) / file).string()) : "";
}

/// The table that a calibration went by.
std::vector<Target> laboratory_of(const nlohmann::json& calibration) {
  std::vector<Target> targets;
  for (const nlohmann::json& row : calibration.at("fitted")) {
    Target t;
    for (int i = 0; i < n_properties; ++i)
      if (row.at("property") == to_string(static_cast<Property>(i))) t.property = static_cast<Property>(i);
    t.theta = row.at("theta [deg]"), t.mean = row.at("laboratory").at("mean");
    t.sd = row.at("laboratory").at("sd"), t.n = io::whole_number<int>(row.at("laboratory").at("n"));
    t.diameter = row.value("diameter [m]", 0.0), t.confining = row.value("confining [Pa]", 0.0);
    targets.push_back(t);
  }
  return targets;
}

report::PageExtras of_calibration(const std::string& folder) {
  report::PageExtras extras;
  extras.calibration = text_of(folder, "calibration.json");
  try {
    const auto j = io::parse_json<nlohmann::json>(extras.calibration);
    if (j.at("format") != 1) throw std::out_of_range("another version of the format");
    extras.name = j.at("rock");
    extras.laboratory = laboratory_of(j);
  } catch (const std::exception& e) {
    throw InputError(
        Problem{folder + "/calibration.json", "", "", "a calibration of format 1", io::in_words(e)});
  }
  extras.recipe = text_of(folder, "calibrated.toml");
  return extras;
}

report::PageExtras of_study(const std::string& folder) {
  report::PageExtras extras;
  extras.variation = io::read_variation(folder);
  extras.name = extras.variation->name;
  extras.recipe = text_of(folder, "recipe.toml");
  if (has(folder, "effects.csv")) {
    const io::Table table = io::parse_table(text_of(folder, "effects.csv"), folder + "/effects.csv");
    if (!table.problems.empty()) throw InputError(table.problems);
    extras.effects.push_back(table.header);
    for (const io::TableRow& row : table.rows) extras.effects.push_back(row.cells);
  }
  return extras;
}

}  // namespace

FolderReport read_report(const std::string& folder) {
  if (has(folder, "calibration.json")) {
    const std::string specimens = specimens_in(folder);
    return {holds_results(specimens) ? io::read_run(specimens) : RunRecord(), of_calibration(folder)};
  }
  if (io::holds_variation(folder)) return {{}, of_study(folder)};
  return {io::read_run(folder), {}};
}

void write_report(const std::string& folder) {
  const FolderReport r = read_report(folder);
  io::write_output((fs::path(folder) / "report.html").string(), report::report_page(r.run, r.extras));
}

}  // namespace phy::jobs
