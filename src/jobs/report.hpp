// report.html from the folder of a run, a study or a calibration.
#pragma once
#include <string>

#include "records/calibration.hpp"
#include "records/specimen_record.hpp"
#include "report/page.hpp"

namespace phy::jobs {

/// What the page of a folder shows.
struct FolderReport {
  RunRecord run;              ///< without tests for a study; of a calibration: its specimens
  report::PageExtras extras;  ///< of these
};

bool holds_calibration(const std::string& folder);
/// What a calibration has compared, for pictures (report/calibration_files.hpp). Throws IoError or
/// InputError.
Calibration read_calibration(const std::string& folder);
/// The same with the verdict, for what is computed from it.
Calibration read_judged(const std::string& folder);

/// Throws IoError, or InputError where the folder holds no result.
FolderReport read_report(const std::string& folder);

/// Writes report.html into the folder.
void write_report(const std::string& folder);

}  // namespace phy::jobs
