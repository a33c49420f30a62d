// report.html: one file that opens anywhere without a network. The page itself (web/, bundled into
// web/report.html) is part of the program; here the results are put in: one block of JSON, a scene per
// specimen. Every number in it is the one of result.json. Text is data to the page, never markup.
#pragma once
#include <string>
#include <vector>

#include "records/calibration.hpp"
#include "records/rock.hpp"
#include "records/test_record.hpp"

namespace phy {

/// What a report may say beyond a run.
struct PageExtras {
  std::vector<Target> laboratory;            ///< points beside E(theta), nu(theta), UCS(theta)
  const Calibration* calibration = nullptr;  ///< adds a section, and its targets as laboratory points
};

/// The page as text. A run without specimens gives a page that says so.
std::string report_page(const RunRecord& run, const PageExtras& extras = {});

}  // namespace phy
