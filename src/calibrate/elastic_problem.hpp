// The least squares of the elastic stage: unknowns, targets, residuals and their derivatives.
//
//   minimise  sum ((log E_i - log E_lab,i)/s_i)^2 + sum ((nu_i - nu_lab,i)/s_i)^2
//             + sum ((x_j - x_usual,j)/s_j)^2
//
// over the logarithms x of the parameters. s_i^2: squared standard errors of the laboratory's mean (at least
// 0.5 %; 0.005 for nu) and of the mean over packings. The last sum is weak (half of the box of parameters.hpp
// is one standard deviation); it keeps what the data do not determine at usual values.
//
// The direct solution gives E, nu and their exact derivatives. Contacts pull as well as push in all of this
// (bilateral: one linear solution each). What one-sided contacts make of it is a factor on E and an addition
// to nu for each angle, measured where the search has come to. The factor (0.97-0.98) differs by 0.2-0.5 %
// between packings, while E itself differs by 3-20 %, so five packings give it to 0.2 %; and it hardly moves
// with the parameters. The verification solves the one-sided contacts themselves.
#pragma once
#include <cstdint>
#include <vector>

#include "calibrate/parameters.hpp"
#include "calibrate/simulator.hpp"
#include "records/evidence.hpp"

namespace phy::calibrate {

/// E or nu of one target with derivatives by the logarithms of the parameters, mean over packings.
struct ElasticAnswer {
  double mean = 0.0, sd = 0.0;
  std::vector<double> slope;
  std::vector<double> values;  ///< of the packings
};

/// Residuals, and their derivatives column by column.
struct Linearised {
  std::vector<double> residuals, jacobian;
};

class ElasticProblem {
 public:
  using Point = std::vector<double>;  ///< logarithms, in the order of the parameters

  ElasticProblem(const Evidence& evidence, Simulator& simulator);

  std::size_t n_parameters() const { return parameters_.size(); }
  std::size_t n_targets() const { return rows_.size(); }
  /// Targets first, then the prior and the walls of the box.
  std::size_t n_residuals() const { return n_targets() + 2 * n_parameters(); }
  const Parameter& parameter(std::size_t j) const { return *parameters_[j]; }
  const LogBox& box(std::size_t j) const { return boxes_[j]; }

  void use_packings(std::vector<std::int64_t> seeds);
  /// Where moduli and nu contradict each other: share of its weight that nu keeps.
  void weigh_nu(double weight) { nu_weight_ = weight; }
  /// Takes weights and corrections, but no solutions, from an earlier state.
  void go_back_to(const ElasticProblem& before) { nu_weight_ = before.nu_weight_, rows_ = before.rows_; }

  /// A point well inside the box, from the least squares of Eq. 1 and one solution of the bare recipe.
  Point first_guess(std::int64_t seed);
  Recipe recipe_at(const Point& x) const;
  /// Bilateral contacts with the corrections; solved anew only where x or packings have changed.
  const std::vector<ElasticAnswer>& answers(const Point& x);
  Linearised linearised(const Point& x);
  /// Rows of the macro table, without intervals.
  std::vector<Comparison> comparisons(const Point& x);
  /// One-sided contacts at x on the first `n` packings, over the bilateral ones on the same.
  void correct(const Point& x, std::size_t n);
  /// Scatter of the mean over packings at x becomes part of every unit of misfit.
  void weigh_packings(const Point& x);
  /// Of each target its unit of misfit at x, SI, and the share of it that packings make.
  struct Unit {
    double size, packings;
  };
  std::vector<Unit> units(const Point& x);
  /// Of each packing, what its answers at x deviate from their mean, SI.
  std::vector<std::vector<double>> deviations(const Point& x);
  /// Largest relative scatter of E between packings.
  double worst_scatter(const Point& x);

 private:
  /// A target and what the search has learnt of it.
  struct Row {
    Target target;
    double factor, addition;     ///< what one-sided contacts make of a bilateral answer
    double packing_error = 0.0;  ///< of the mean; relative for E
    bool is_modulus() const { return target.property == Property::E; }
  };
  const Evidence& evidence_;
  Simulator& simulator_;
  std::vector<const Parameter*> parameters_;
  std::vector<LogBox> boxes_;
  std::vector<Row> rows_;
  std::vector<std::int64_t> seeds_;
  double nu_weight_ = 1.0;
  Point x_;
  std::vector<ElasticAnswer> two_sided_, answers_;  // at x_; without and with the corrections

  std::vector<ElasticAnswer> solved(const Point& x, const std::vector<std::int64_t>& seeds, Statics what);
  ElasticAnswer mean_of(const std::vector<ElasticResult>& results, Property property,
                        const Recipe& recipe) const;
  double unit_of_misfit(const Row& row) const;
};

}  // namespace phy::calibrate
