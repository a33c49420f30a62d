#include "calibrate/read_moduli.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>

#include "base/exact_math.hpp"
#include "calibrate/parameters.hpp"

namespace phy::calibrate {
namespace {

/// Before the first test, in units of log E and of nu: any softening, alike over the box to within so much.
const maps::PriorMean nothing_known = {[](std::span<const double>) { return 0.0; }, 0.5, 0.1, 0.05};
constexpr double least_nu = 0.5;  // share of nu that is left to the direct solution

/// E_c and the stiffnesses of layers; k_s/k_n is left for nu.
Eigen::Index n_stiffnesses(const Recipe& model) {
  return static_cast<Eigen::Index>(elastic_parameters(model).size()) - 1;
}

/// Without a stress on the sides all stresses are proportional to sigma_c, and its place tells nothing.
std::span<const double> inputs_of(const TestRead& test, std::span<const double> z) {
  return test.confining > 0.0 ? z : z.first(z.size() - 1);
}

}  // namespace

ReadModuli::ReadModuli(const Evidence& evidence)
    : reading_(evidence.rock.E_is),
      moduli_(evidence.moduli),
      read_(tests_to_read(evidence)),
      n_harmonics_(n_stiffnesses(evidence.rock.model)) {}

bool ReadModuli::reads(const Target& strength) const {
  return std::any_of(read_.begin(), read_.end(), [&](const Target& t) { return same_cell(t, strength); });
}

void ReadModuli::add(const Target& strength, const SurrogateRun& where, const TestResult& test,
                     const ElasticResult& solution) {
  const std::optional<Softening> s = softening_of(test, strength.property, solution, reading_);
  if (!s) return;
  SurrogateRun factor = where, addition = where;
  // A factor by its logarithm, so that a surrogate never makes a negative E of it.
  factor.y = std::log(s->factor), addition.y = s->addition;
  Answers& answers = tests_[test_of_cell(strength)];
  answers.factors.push_back(std::move(factor)), answers.additions.push_back(std::move(addition));
}

void ReadModuli::learn() {
  for (auto& [test, a] : tests_)
    a.learnt = {Surrogate(a.factors, nothing_known), Surrogate(a.additions, nothing_known)};
}

void ReadModuli::take_solution(const std::vector<Comparison>& moduli) {
  E_.clear(), nu_.clear();
  for (std::size_t i = 0; i < moduli_.size(); ++i) {
    const Target& t = moduli_[i];
    if (!tests_.contains(test_of_cell(t)) || !moduli[i].answered()) continue;
    const double error = t.normal_error();
    if (t.property == Property::E) E_.push_back({t, std::log(moduli[i].mean), std::pow(error / t.mean, 2.0)});
    if (t.property == Property::nu) nu_.push_back({t, moduli[i].mean, error * error});
  }
  find_left();
}

/// Harmonics that the values tell apart: those of the stiffnesses, but no more than there are inclinations.
Eigen::Index ReadModuli::n_followed() const {
  std::set<double> inclinations;
  for (const Value& v : E_) inclinations.insert(v.target.theta);
  return std::min(n_harmonics_, static_cast<Eigen::Index>(inclinations.size()));
}

/// Projects out what stiffnesses can follow: least squares of the harmonics through the values.
void ReadModuli::find_left() {
  const auto n = static_cast<Eigen::Index>(E_.size()), n_harmonics = n_followed();
  // As many stiffnesses as values follow any course: nothing is left to be missed.
  if (n <= n_harmonics) return E_.clear();
  Eigen::MatrixXd harmonics(n, n_harmonics);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n_harmonics; ++k)
      harmonics(i, k) =
          sin_cos_degrees(2.0 * static_cast<double>(k) * E_[static_cast<std::size_t>(i)].target.theta).cos;
  left_ = Eigen::MatrixXd::Identity(n, n) -
          harmonics * (harmonics.transpose() * harmonics).ldlt().solve(harmonics.transpose());
  // Variances of independent errors go through a linear map by its squares.
  known_ = left_.cwiseAbs2();
}

Softenings ReadModuli::at(std::span<const double> z) const {
  Softenings all;
  for (const auto& [test, a] : tests_) {
    const std::span<const double> own = inputs_of(test, z);
    all[test] = {std::exp(a.learnt.front().at(own).mean), a.learnt.back().at(own).mean};
  }
  return all;
}

std::vector<ReadModuli::Miss> ReadModuli::misses(std::span<const double> z) const {
  std::vector<Miss> all;
  const auto n = static_cast<Eigen::Index>(E_.size());
  Eigen::VectorXd error(n), variance(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Value& v = E_[static_cast<std::size_t>(i)];
    const TestRead test = test_of_cell(v.target);
    const Surrogate::Value s = tests_.at(test).learnt.front().at(inputs_of(test, z));
    error[i] = std::log(v.target.mean) - v.solution - s.mean, variance[i] = s.variance;
  }
  if (n > 0) error = left_ * error, variance = known_ * variance;
  for (Eigen::Index i = 0; i < n; ++i)
    all.push_back({Property::E, error[i], variance[i], E_[static_cast<std::size_t>(i)].scatter});
  for (const Value& v : nu_) {
    const TestRead test = test_of_cell(v.target);
    const double d = tests_.at(test).learnt.back().at(inputs_of(test, z)).mean;
    // Below that share the moduli take it up, and strengths need not care.
    const double beyond = std::max(0.0, d - (1.0 - least_nu) * v.target.mean);
    all.push_back({Property::nu, -beyond, 0.0, v.scatter});
  }
  return all;
}

}  // namespace phy::calibrate
