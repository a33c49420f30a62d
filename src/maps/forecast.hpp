// The forecast of a verdict before any test: what the maps of models (response_map.hpp) say that a search
// will find.
//
// A model's answers are quadratics in the places of its variables, one per column of its map. The variables
// that a calibration moves, and the scales of moduli and strengths, go downhill to where these quadratics lie
// nearest to the whole table (least squares in half tolerances; a value that cannot be met counts by its
// miss alone, not by its square), from the points of the map that lie nearest; the others stay as the recipe
// has them. What is missed there is the forecast. It is no test: a quadratic misses single specimens that it
// was not shown by 11 - 25 % of UCS and 5 - 13 % of E, and packings of the rock's own grains are others than
// those of the maps. So strengths are out of reach only where they miss by the verdict's 10 % and by 0.6 of
// what the quadratics miss of single specimens, E by its root mean square: then nine of ten specimens of the
// maps that were left out are said to be within reach (docs/calibration.md, "Before").
#pragma once
#include <optional>
#include <vector>

#include "maps/response_map.hpp"
#include "records/calibration.hpp"
#include "records/finding.hpp"

namespace phy::maps {

/// Root mean square over the values of a property, relative or absolute as it counts.
struct ErrorRange {
  double low, high;
};

struct Forecast {
  const MappedModel* model = nullptr;  ///< of several that may stand for the rock the one that comes nearest
  VerdictStatus status = VerdictStatus::calibrated;
  std::vector<Comparison> rows;     ///< `mean` as forecast; those that the map has
  std::vector<Target> unmapped;     ///< of the table, but not of the map
  double distance = 0.0;            ///< sum of squares of what is minimised
  double n_grains = 0.0;            ///< of the rock's specimen
  double grains_across = 0.0;       ///< its disc; 0: there is none
  double nu_of_nearest_body = 0.0;  ///< what the nearest layered elastic body misses of nu
  /// By a search of the effort "quick": as `auto` takes where the forecast is out of reach, unless said
  /// otherwise.
  bool quick = false;
  bool beyond_map = false;  ///< E lies where nothing was mapped, though planes in an isotropic rock have it
  /// Is every property met within its tolerance, root mean square?
  bool meets() const;
  /// Root mean square miss of a property, relative or absolute as it counts; NaN: no row of it.
  double rms(Property property) const;
  /// What the quadratics miss of such a value of specimens that they were not shown, by its logarithm.
  double error_of(const Target& target) const;
  /// What a calibration is expected to miss on unseen packings. Low: what the quadratics miss of the table,
  /// but no less than what packings of this size differ by, nor, of nu, than the nearest layered body. High:
  /// with what the quadratics themselves miss of single specimens, what a quick search misses more than a
  /// usual one, and of discs what coarse grains add. Nothing without a row of it.
  std::optional<ErrorRange> expected_error(Property property) const;
};

/// Grains across the disc of a target.
double grains_across_disc(const Recipe& model, const Target& target);
/// Tension of discs so many grains across over that of the maps, 24 across: a power through 12 to 48 grains
/// (docs/theory/reach.md).
double tension_over_maps(double grains_across);

/// By the models that `layers` of the rock admits; nothing: none of them was mapped, or the table has neither
/// E nor UCS. `fold`: a fifth of the points that the quadratics are not shown; negative: none.
std::optional<Forecast> forecast_of(const Evidence& evidence, int fold = -1);

/// The forecast and what it rests on.
std::vector<Finding> findings_of(const Forecast& forecast);

}  // namespace phy::maps
