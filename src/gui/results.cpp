#include "gui/results.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>

#include "gui/project.hpp"
#include "io/load.hpp"
#include "jobs/report.hpp"
#include "report/figure_json.hpp"
#include "report/page.hpp"
#include "report/rock_results.hpp"
#include "rock/file.hpp"

namespace phy::gui {
namespace {

/// Of a rock whose files have problems the check speaks: here its laboratory is missing.
std::vector<Target> laboratory_of(const std::string& rock) {
  try {
    return targets_of(rock::read_rock(rock + ".toml"));
  } catch (const std::exception&) {
    return {};
  }
}

std::string folder_of(const std::string& rock, const std::string& test) {
  return (std::filesystem::path(tests_of(rock)) / test).string();
}

}  // namespace

Json results_answer(const std::string& rock, const std::string& calibration) {
  std::vector<report::NamedRun> tests;
  for (const std::string& name : test_names(rock)) try {
      if (exists(folder_of(rock, name))) tests.push_back({name, io::read_run(folder_of(rock, name))});
    } catch (const std::exception&) {
      // One that has not ended, or is damaged: its own view says so.
    }
  std::optional<Calibration> calibrated;
  if (jobs::holds_calibration(calibration)) calibrated = jobs::read_calibration(calibration);
  const report::RockResults made = report::rock_results(calibrated, laboratory_of(rock), tests);
  return {{"over_theta", report::figure_json(made.over_theta)},
          {"curves", report::figure_json(made.curves)},
          {"over_sigma_3", report::figure_json(made.over_sigma_3)}};
}

Json broken_answer(const std::string& rock, const std::string& test) {
  return report::specimens_json(io::read_run(folder_of(rock, test)));
}

}  // namespace phy::gui
