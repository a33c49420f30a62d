#include "calibrate/read_moduli.hpp"

#include <algorithm>
#include <cmath>

#include "base/exact_math.hpp"
#include "calibrate/parameters.hpp"

namespace phy::calibrate {
namespace {

/// Before the first test, in units of log E and of nu: any softening, alike over the box to within so much.
const PriorMean nothing_known = {[](std::span<const double>) { return 0.0; }, 0.5, 0.1, 0.05};
constexpr double least_nu = 0.5;  // share of nu that is left to the direct solution

/// E_c and the stiffnesses of layers; k_s/k_n is left for nu.
Eigen::Index n_stiffnesses(const Recipe& model) {
  return static_cast<Eigen::Index>(elastic_parameters(model).size()) - 1;
}

}  // namespace

ReadModuli::ReadModuli(const Evidence& evidence)
    : reading_(evidence.rock.E_is),
      moduli_(evidence.moduli),
      n_harmonics_(n_stiffnesses(evidence.rock.model)) {}

void ReadModuli::add(double theta, const SurrogateRun& where, const TestResult& test,
                     const ElasticResult& solution) {
  const std::optional<Softening> s = softening_of(test, solution, reading_);
  if (!s) return;
  SurrogateRun factor = where, addition = where;
  factor.y = std::log(s->factor), addition.y = s->addition;
  angles_[theta].factors.push_back(std::move(factor)),
      angles_[theta].additions.push_back(std::move(addition));
}

void ReadModuli::learn() {
  for (auto& [theta, a] : angles_)
    a.learnt = {Surrogate(a.factors, nothing_known), Surrogate(a.additions, nothing_known)};
}

void ReadModuli::take_solution(const std::vector<Comparison>& moduli) {
  E_.clear(), nu_.clear();
  for (std::size_t i = 0; i < moduli_.size(); ++i) {
    const Target& t = moduli_[i];
    if (!angles_.contains(t.theta) || !moduli[i].answered()) continue;
    const double error = t.normal_error();
    if (t.property == Property::E) E_.push_back({t, std::log(moduli[i].mean), std::pow(error / t.mean, 2.0)});
    if (t.property == Property::nu) nu_.push_back({t, moduli[i].mean, error * error});
  }
  find_left();
}

/// Projects out what stiffnesses can follow: least squares of the harmonics through the values.
void ReadModuli::find_left() {
  const auto n = static_cast<Eigen::Index>(E_.size());
  if (n <= n_harmonics_) return E_.clear();
  Eigen::MatrixXd harmonics(n, n_harmonics_);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n_harmonics_; ++k)
      harmonics(i, k) =
          sin_cos_degrees(2.0 * static_cast<double>(k) * E_[static_cast<std::size_t>(i)].target.theta).cos;
  left_ = Eigen::MatrixXd::Identity(n, n) -
          harmonics * (harmonics.transpose() * harmonics).ldlt().solve(harmonics.transpose());
  known_ = left_.cwiseAbs2();
}

Softenings ReadModuli::at(std::span<const double> z) const {
  Softenings all;
  for (const auto& [theta, a] : angles_)
    all[theta] = {std::exp(a.learnt.front().at(z).mean), a.learnt.back().at(z).mean};
  return all;
}

std::vector<ReadModuli::Miss> ReadModuli::misses(std::span<const double> z) const {
  std::vector<Miss> all;
  const auto n = static_cast<Eigen::Index>(E_.size());
  Eigen::VectorXd error(n), variance(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Value& v = E_[static_cast<std::size_t>(i)];
    const Surrogate::Value s = angles_.at(v.target.theta).learnt.front().at(z);
    error[i] = std::log(v.target.mean) - v.solution - s.mean, variance[i] = s.variance;
  }
  if (n > 0) error = left_ * error, variance = known_ * variance;
  for (Eigen::Index i = 0; i < n; ++i)
    all.push_back({Property::E, error[i], variance[i], E_[static_cast<std::size_t>(i)].scatter});
  for (const Value& v : nu_) {
    const double d = angles_.at(v.target.theta).learnt.back().at(z).mean;
    const double beyond = std::max(0.0, d - (1.0 - least_nu) * v.target.mean);
    all.push_back({Property::nu, -beyond, 0.0, v.scatter});
  }
  return all;
}

}  // namespace phy::calibrate
