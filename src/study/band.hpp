// What an ensemble predicts: a number of every draw, and the band of all draws.
//
// The band is the smallest to the largest value. Of n draws and one more of the same distribution every order
// is as likely: the band holds the next one with a probability of (n - 1)/(n + 1), of twenty 90.5 %. A draw
// without the number (no strength, no fit) is left out and counted.
//
// Where it is known what the model misses of a number (calibrate/discrepancy.hpp), a second band is the
// rock's: draw k times exp(missed_k), about which the rock lies log-normally with `missed_sd`. From that
// mixture come the middle and the quantiles 1/(n + 1) and n/(n + 1), which of a discrepancy of nothing are
// the smallest and the largest draw.
#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "base/nan.hpp"
#include "records/result.hpp"
#include "study/envelope.hpp"

namespace phy::study {

/// Of which specimen under which stress a number is.
struct Place {
  std::string specimen;  ///< its name
  bool intact = false;
  double theta = 0.0;    ///< [deg]
  double sigma_3 = nan;  ///< [Pa]; NaN: the test's own, or of all stresses together
};

/// A number that one draw predicts; NaN: it has none.
struct Prediction {
  Place place;
  std::string number, unit;
  double value = nan;
  /// log(rock/model) of the draw and its standard deviation; NaN: not known.
  double missed = nan, missed_sd = nan;
};
using Predictions = std::vector<Prediction>;  ///< of one draw

struct Band {
  Place place;
  std::string number, unit;
  std::size_t n = 0, n_without = 0;  ///< draws with and without the number
  double median = nan, low = nan, high = nan;
  /// exp(missed) over the draws, and its relative standard deviation; the rock's middle and band. NaN: it is
  /// not known what the model misses.
  double factor = nan, factor_sd = nan;
  double rock = nan, rock_low = nan, rock_high = nan;
  double width() const { return (high - low) / std::fabs(median); }
  bool has_rock() const { return std::isfinite(rock); }
};

/// Bands of all numbers that any draw has, in the order of their first appearance.
std::vector<Band> bands_of(const std::vector<Predictions>& draws);

/// Probability with which the band of n draws holds one more.
double band_probability(std::size_t n);

/// All numbers of a test with a strength; of another one, what the test is made for, without a value.
Predictions predictions_of(const TestResult& result, double sigma_3);
/// Cohesion, friction, UCS and m_i of every specimen; none where there is no fit.
Predictions predictions_of(const Envelope& envelope);

/// A row per band; empty cells: no number.
std::string bands_csv(const std::vector<Band>& bands);

}  // namespace phy::study
