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
#include "records/rock.hpp"

namespace phy::calibrate {

/// A strength of the table against the model.
struct Residual {
  double value = 0.0;    ///< log(laboratory/model)
  double noise = 0.0;    ///< variance of the laboratory
  double unknown = 0.0;  ///< variance of the model's own answer
};

class Discrepancy {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  /// `residuals`: of the targets, in their order; `left_out` is not used.
  Discrepancy(const std::vector<Target>& targets, const std::vector<Residual>& residuals,
              std::size_t left_out = none);

  /// log(rock/model) at a target is the sum of `weights` times the residuals of the targets, about which the
  /// rock lies with `variance`. Draws have residuals of their own, and these weights.
  struct Term {
    std::vector<double> weights;
    double variance = 0.0;
    double mean(const std::vector<Residual>& residuals) const;
  };
  Term of(std::size_t target) const;
  /// The same where no test of the table was made: delta alone.
  struct Value {
    double mean = 0.0, variance = 0.0;
  };
  Value at(const Target& test, double theta) const;

 private:
  struct Group {
    double strength = 0.0;             ///< mean of the table
    std::vector<std::size_t> members;  ///< targets, without the one left out
    std::optional<AngleProcess> process;
  };
  std::vector<Target> targets_;
  std::vector<double> unknown_;
  std::map<Property, Group> groups_;

  const Group& group_of(Property property) const;
  AnglePlace place_of(const Target& test, double theta) const;
};

}  // namespace phy::calibrate
