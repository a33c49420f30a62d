// All that has been made of one rock, side by side: the laboratory, its calibration, and tests of the model
// by their names. What nobody has computed is not drawn.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "records/calibration.hpp"
#include "records/specimen_record.hpp"
#include "report/figure.hpp"

namespace phy::report {

struct NamedRun {
  std::string name;
  RunRecord run;
};

struct RockResults {
  Figure over_theta;    ///< a panel for each property, stress and size of disc, as calibration_figure()
  Figure curves;        ///< of the tests, those of one kind laid over one another
  Figure over_sigma_3;  ///< sigma_1; without panels where one stress alone has results
};
/// Without a calibration the laboratory stands beside the tests. Specimens without a strength have a curve
/// and no point.
RockResults rock_results(const std::optional<Calibration>& calibration, const std::vector<Target>& laboratory,
                         const std::vector<NamedRun>& tests);

}  // namespace phy::report
