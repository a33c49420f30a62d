#include "jobs/report.hpp"

#include <fmt/chrono.h>

#include <ctime>
#include <filesystem>

#include "base/check.hpp"
#include "io/load.hpp"
#include "io/load_variation.hpp"
#include "io/output.hpp"
#include "io/table.hpp"
#include "jobs/calibration_folder.hpp"
#include "jobs/run_folder.hpp"
#include "report/calibration_files.hpp"
#include "rock/schema.hpp"

namespace phy::jobs {
namespace {

namespace fs = std::filesystem;

constexpr const char* calibration_file = "calibration.json";

/// With its name last, whether or not "/" follows it.
fs::path whole(const std::string& folder) {
  return (fs::absolute(folder) / ".").lexically_normal().parent_path();
}

/// "2026-11-28", where the program runs.
std::string today() { return fmt::format("{:%F}", fmt::localtime(std::time(nullptr))); }

bool has(const std::string& folder, const char* file) {
  // A folder that cannot be looked into holds nothing to show; reading it says why.
  std::error_code none;
  return fs::exists(fs::path(folder) / file, none);
}
std::string text_of(const std::string& folder, const char* file) {
  // A page is also made of folders in which some file was deleted: that part is left out.
  return has(folder, file) ? io::read_written((fs::path(folder) / file).string()) : "";
}

/// The rock file of a calibration: as it was named, else beside the folder, where it may have moved along;
/// "": neither.
std::string rock_file_of(const std::string& folder) {
  const auto request = request_in(folder);
  if (!request) return "";
  const fs::path named(request->rock), beside = whole(folder).parent_path();
  std::error_code none;
  for (const fs::path& file : {named, beside / named.filename()})
    if (fs::is_regular_file(file, none)) return file.string();
  return "";
}

using Lines = std::vector<std::pair<std::string, std::string>>;

/// Who and what for, by the rock file; the files.
Lines head_of_calibration(const std::string& folder) {
  Lines lines;
  if (const std::string rock = rock_file_of(folder); !rock.empty()) try {
      const rock::ReportHead head = rock::report_head(rock);
      lines = head.lines;
      lines.emplace_back("files",
                         fs::path(rock).filename().string() + (head.table.empty() ? "" : ", ") + head.table);
    } catch (const std::exception&) {
      // A rock file that has become unreadable since takes nothing from the results.
    }
  return lines;
}

report::PageExtras of_calibration(const std::string& folder) {
  report::PageExtras extras;
  extras.calibration = read_calibration(folder);
  extras.calibration_json = text_of(folder, calibration_file);
  extras.name = extras.calibration->rock;
  extras.recipe = text_of(folder, "calibrated.toml");
  extras.head = head_of_calibration(folder);
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
    // As text: the page shows the table as it is, and rounds nothing.
    for (const io::TableRow& row : table.rows) extras.effects.push_back(row.cells);
  }
  return extras;
}

}  // namespace

bool holds_calibration(const std::string& folder) { return has(folder, calibration_file); }

Calibration read_calibration(const std::string& folder) {
  return report::comparisons_of(text_of(folder, calibration_file),
                                (fs::path(folder) / calibration_file).string());
}

Calibration read_judged(const std::string& folder) {
  return report::judged_from(text_of(folder, calibration_file),
                             (fs::path(folder) / calibration_file).string());
}

FolderReport read_report(const std::string& folder) {
  FolderReport r;
  // Before a run: a calibration has results of tests below it, but its page is another.
  if (holds_calibration(folder)) {
    const std::string specimens = specimens_in(folder);
    // An elastic calibration has broken no specimen.
    r = {holds_results(specimens) ? io::read_run(specimens) : RunRecord(), of_calibration(folder)};
  } else if (io::holds_variation(folder)) {
    r = {{}, of_study(folder)};
  } else {
    r = {io::read_run(folder), {}};
  }
  r.extras.head.emplace_back("results", whole(folder).filename().string());
  r.extras.head.emplace_back("written", today());
  return r;
}

void write_report(const std::string& folder) {
  const FolderReport r = read_report(folder);
  io::write_output(page_of(folder), report::report_page(r.run, r.extras));
}

}  // namespace phy::jobs
