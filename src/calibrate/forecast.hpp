// The verdict foretold before any test: what the maps of models (reach.hpp) say that a search will find.
//
// A family's answers are quadratics in the places of its levers, one per column of its map. The levers that a
// calibration moves, and the scales of moduli and strengths, go downhill to where these quadratics lie
// nearest to the whole table (least squares in half tolerances; a value that cannot be met counts by its
// miss alone, not by its square), from the points of the map that lie nearest; the others stay as the recipe
// has them. What is missed there is the forecast. It is no test: a quadratic misses single specimens that it
// was not shown by 11 - 25 % of UCS and 5 - 13 % of E, and packings of the rock's own grains are others than
// those of the maps. So strengths are out of reach only where they miss by the verdict's 10 % and by 0.6 of
// what the quadratics miss of single specimens, E by its root mean square: then nine of ten specimens of the
// maps that were left out are said to be within reach (docs/calibration.md, "Before").
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "calibrate/evidence.hpp"
#include "calibrate/reach.hpp"

namespace phy::calibrate {

struct Forecast {
  const ModelFamily* family = nullptr;  ///< of several that may model the rock the one that comes nearest
  VerdictStatus status = VerdictStatus::calibrated;
  std::vector<Comparison> rows;     ///< `mean` as foretold; those that the map has
  std::vector<std::string> silent;  ///< of the table, but not of the map
  double distance = 0.0;            ///< sum of squares of what is minimised
  bool beyond_map = false;  ///< E lies where nothing was mapped, though planes in an isotropic rock have it
  /// Is every property met within its tolerance, root mean square?
  bool meets() const;
  /// Root mean square miss of a property, relative, of nu absolute; NaN: no row of it.
  double rms(Property property) const;
};

/// By the models that `layers` of the rock admits; nothing: none of them was mapped, or the table has neither
/// E nor UCS. `fold`: a fifth of the points that the quadratics are not shown; negative: none.
std::optional<Forecast> foretell(const Evidence& evidence, int fold = -1);

/// In words, with what it rests on.
std::string forecast_text(const Forecast& forecast);

}  // namespace phy::calibrate
