// report.html from the folder of a run, a study or a calibration.
#pragma once
#include <string>

#include "records/specimen_record.hpp"
#include "report/page.hpp"

namespace phy::jobs {

/// What the page of a folder shows.
struct FolderReport {
  RunRecord run;              ///< without tests for a study; of a calibration: its specimens
  report::PageExtras extras;  ///< of these
};

/// Throws IoError, or InputError where the folder holds no result.
FolderReport read_report(const std::string& folder);

/// Writes report.html into the folder.
void write_report(const std::string& folder);

}  // namespace phy::jobs
