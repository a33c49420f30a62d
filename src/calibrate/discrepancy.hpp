// What a calibrated model misses of the strengths of a table, as a smooth function of theta and sigma_3
// (Kennedy & O'Hagan 2001):
//
//   log strength of the rock = log model(x) + delta(theta, sigma_3/strength)
//
// One delta for strengths in compression, one for each kind of test in tension, each learnt from the
// residuals log(laboratory/model) of its cells at an estimate x. It is conditional on the estimate: the
// search keeps its own allowance per property (strength_posterior.hpp), which only stops a value that no
// model meets from dragging the others along.
//
// Rejected: delta among the unknowns of the search. A table has seven cells, and a free function of theta
// would take the part of the parameters.
#pragma once
#include <map>
#include <optional>
#include <vector>

#include "base/angle_process.hpp"
#include "records/calibration.hpp"

namespace phy::calibrate {

class Discrepancy {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  /// `left_out`: a residual that is not used.
  explicit Discrepancy(std::vector<StrengthResidual> residuals, std::size_t left_out = none);

  /// log(rock/model) is the sum of `weights` times the residuals, about which the rock lies with `variance`.
  struct Term {
    std::vector<double> weights;
    double mean = 0.0;  ///< at the estimate
    double variance = 0.0;
  };
  /// Where the table has a value: of the model as far as its stand-in knows it.
  Term of(std::size_t residual) const;
  /// In any test of a known kind: of the model itself, which is run.
  Term at(const Target& test) const;
  /// Has the table strengths of this kind?
  bool knows(Property property) const;
  /// A draw misses the table in its own way and is corrected by the weights of the estimate: one that is too
  /// strong everywhere is brought back, so that the level is not counted twice.
  double of_draw(const Term& term, std::size_t draw) const;
  /// How many draws the residuals have.
  std::size_t n_draws() const { return residuals_.empty() ? 0 : residuals_.front().of_draws.size(); }

 private:
  struct Group {
    double strength = 0.0;             ///< mean of the table
    std::vector<std::size_t> members;  ///< residuals, without the one left out
    std::optional<AngleProcess> process;
  };
  std::vector<StrengthResidual> residuals_;
  std::map<Property, Group> groups_;

  const Group& group_of(Property property) const;
  AnglePlace place_of(const Target& test) const;
  Term term_of(const Group& group, const AngleProcess::Prediction& prediction) const;
};

}  // namespace phy::calibrate
