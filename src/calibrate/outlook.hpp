// What a calibration will do, stage by stage, before it does it: for the time that it takes, and for nothing
// else. Which of its stages come is open: rounds follow while the estimate has not settled, packings where
// these differ, another model where one ended out of reach. So there are the stages that will come, and all
// that may. Pure: it follows from the table and the options.
#pragma once
#include <cstdint>
#include <vector>

#include "calibrate/options.hpp"
#include "records/evidence.hpp"

namespace phy::calibrate {

struct PlannedStage {
  FindingKind kind;              ///< by which it begins (finding_of_course.def)
  bool certain;                  ///< else it may be left out
  double cost = 0.0;             ///< as study::expected_cost() counts: cycles times grains
  std::int64_t tests = 0;        ///< all
  std::int64_t compression = 0;  ///< of these, those that `max_tests` counts
};

/// Least and most that is ahead.
struct Ahead {
  double least_cost = 0.0, most_cost = 0.0;
  std::int64_t least_tests = 0, most_tests = 0;
};

struct Outlook {
  int model = 0, models = 1;         ///< which of at most how many; 0: they are compared first
  std::vector<PlannedStage> stages;  ///< of this model, in their order
  Ahead first;                       ///< by one model: this one, or whichever is taken first
  Ahead later;                       ///< of models behind it
  Ahead ahead() const;               ///< all of it
};

/// Before anything runs.
Outlook outlook_of(const Evidence& evidence, const CalibrationOptions& options);

/// Of the model that begins, the `model`-th; `rivals`: that may follow.
Outlook outlook_of(const Evidence& begins, int model, const std::vector<Evidence>& rivals,
                   const CalibrationOptions& options);

}  // namespace phy::calibrate
