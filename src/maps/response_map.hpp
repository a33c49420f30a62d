// What models reach: the tables of data/maps, which `make maps` writes and the program holds.
//
// A row is one point of a model on one packing: its variables and what its tests gave, strengths over
// sigma_c, moduli over E_c. "(30)" in a column is the inclination. An empty cell is a test without a usable
// strength. Between the points a quadratic in the places of the variables, by ridge regression to the rows,
// says what a model may answer; it is the expectation with which a calibration begins (prior_regression.hpp).
#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "maps/mapped_model.hpp"
#include "records/rock.hpp"

namespace phy::maps {

class ResponseMap {
 public:
  /// Text of a table of data/maps. Broken text is a broken program: it was taken in when that was built.
  ResponseMap(const MappedModel& model, std::string_view csv);

  const MappedModel& model() const { return *model_; }
  std::size_t n_rows() const { return rows_.size(); }
  /// NaN where the cell is empty.
  double at(std::size_t row, const std::string& column) const;
  /// Places of the variables of a row.
  const std::vector<double>& places(std::size_t row) const { return places_[row]; }
  /// Of the packing of the model's base recipe, not of the loose one.
  bool is_dense(std::size_t row) const;
  /// Few bonds broken before the peak (below 20 %), nu at half the strength below 0.6, sigma_ci above 0.3
  /// UCS, at every inclination that was mapped.
  bool is_plausible(std::size_t row) const;

 private:
  const MappedModel* model_;
  std::vector<std::string> columns_;
  std::vector<std::vector<double>> rows_, places_;
};

/// The table of a model.
const ResponseMap& map_of(const MappedModel& model);

/// "nu50(30)", "nu50": a column at a mapped inclination.
std::string column_at(const MappedModel& model, const std::string& column, double theta);

/// The column of a property in the map of a model, as a table reads its moduli; nullptr: it was not mapped.
const char* map_column(const MappedModel& model, Property property, ModulusReading reading);
/// What a property adds to the logarithm of that column.
double log_share(Property property);

/// The two mapped inclinations about an angle [0, 180 deg] of a property, and the share of the
/// second.
struct Bracket {
  double low, high, share;
};
Bracket bracket_of(Property property, double theta);

/// log(strength/sigma_c) of a model over its variables.
class MapRegression {
 public:
  /// `column`: of the table. `fold`: one fifth of the points to leave out; negative: none.
  MapRegression(const ResponseMap& table, const std::string& column, int fold = -1);
  /// Of any number that a row of the table answers, by its logarithm; NaN: no answer.
  MapRegression(const ResponseMap& table, const std::function<double(std::size_t row)>& log_answer,
                int fold = -1);
  /// Between two regressions of one model, linear.
  MapRegression(const MapRegression& low, const MapRegression& high, double share);
  /// At places of the variables; kept within 1.2 half ranges.
  double at(std::span<const double> places) const;
  /// The same over the `open` variables alone, in rising order; the others stay at their `places`.
  MapRegression over(const std::vector<std::size_t>& open, std::span<const double> places) const;
  /// Root mean square of what regressions without a fifth of the points miss there.
  static double left_out_error(const ResponseMap& table, const std::string& column);

 private:
  std::vector<double> coefficients_;  // as features_of() orders them
};

/// Made once for what is asked of a model; `what`: a name of the answer.
const MapRegression& regression_of(const MappedModel& model, const std::string& what,
                                   const std::function<double(std::size_t row)>& log_answer, int fold = -1);
/// Likewise of a column.
const MapRegression& regression_of(const MappedModel& model, const std::string& column, int fold = -1);

}  // namespace phy::maps
