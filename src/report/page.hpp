// report.html: one file that opens anywhere without a network. The page itself (web/, bundled into
// web/report.html) is part of the program; here the results are put in: one block of JSON, a scene per
// specimen. Every number in it is the one of result.json. Text is data to the page, never markup.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "records/calibration.hpp"
#include "records/rock.hpp"
#include "records/specimen_record.hpp"
#include "records/variation.hpp"

namespace phy::report {

/// What a report says beyond a run, or instead of one.
struct PageExtras {
  std::string name;                               ///< title; default: that of the run's recipe
  std::vector<Target> laboratory;                 ///< beside the specimens of a run
  std::string calibration_json;                   ///< taken over unchanged; empty: none
  std::optional<Calibration> calibration;         ///< what figures need of the same
  std::optional<Variation> variation;             ///< of a study
  std::vector<std::vector<std::string>> effects;  ///< of a study: effects.csv with its header
  std::string design_json;  ///< the sheet of a design: tables, findings, figure; empty: none
  std::string recipe;       ///< of a study or calibration; default: that of the run
  std::vector<std::pair<std::string, std::string>>
      head;  ///< of the first page, name and text: "author", "NN"
};

/// The page as text. A run without specimens gives a page that says so.
std::string report_page(const RunRecord& run, const PageExtras& extras = {});

/// The specimens of a run as the page carries them, each with its scene in base 64; without one null.
nlohmann::ordered_json specimens_json(const RunRecord& run);

}  // namespace phy::report
