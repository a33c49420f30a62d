// Does a table mean theta or beta = 90 - theta? Asked of each property by itself.
//
// What layers make of a property over theta has a sense: slip on a plane is easiest between 45 and 75
// degrees, E grows towards 90 degrees, a disc splits more easily with its layers along the load. Each
// property is held against a family of such curves, once with its angles as they are and once with their
// complements:
//
//   m = mean over the curves of exp(-chi^2/2),   chi^2 = sum (log value - log curve - level)^2/(s^2 + t^2)
//
// s: standard error of the cell, t: by how much rocks are off such curves, the level free. Half of the weight
// has a flat curve, so that chance in a rock without anisotropy says nothing. A share e of rocks breaks the
// rule though their table is right, so that a property speaks for its complement by the odds
//
//   ((1 - e) m' + e m)/((1 - e) m + e m')      between e/(1 - e) and (1 - e)/e, however good the data
//
// The prior: one table in ten means the other angle than the one by which it is read, and one column in
// twenty counts otherwise than its table. The likeliest of all 2^n readings decides. How often that accuses
// and finds: docs/calibration.md, "Theta or beta".
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "records/rock.hpp"

namespace phy::calibrate {

/// What one property says.
struct AngleEvidence {
  Property property = Property::E;
  double log_odds = 0.0;    ///< that its angles are the complements of theta, before any prior
  double as_read = 0.0;     ///< root mean square miss of the nearest curve, relative
  double complement = 0.0;  ///< the same with 90 - angle
  bool exchanged = false;   ///< by the likeliest reading of the table
};

/// There is one where the likeliest reading of a table is not the one as it is written.
struct AngleQuestion {
  std::vector<AngleEvidence> properties;  ///< all that were tested at several angles
  bool of_whole_table() const;
};

std::optional<AngleQuestion> angle_question(const std::vector<Target>& targets);

/// The question with what speaks, the misses both ways and what to do; `beta`: the table counts from the
/// load.
std::string text_of(const AngleQuestion& question, bool beta);

}  // namespace phy::calibrate
