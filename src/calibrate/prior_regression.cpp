#include "calibrate/prior_regression.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/check.hpp"
#include "base/exact_math.hpp"

namespace phy::calibrate {
namespace {

constexpr int n_angles = 7;
constexpr double angle_step = 15.0;
constexpr int n_bedded = 45, n_intact = 10;
constexpr double held = 1.2;  // farthest a modulus ratio is believed, in half ranges

// Made by tests/soak/prior_regression.test.cpp; a column per angle 0, 15 ... 90, rows in the order of
// regression_features.
constexpr double bedded_table[n_bedded][n_angles] = {
    {0.693, 0.544, -0.020, -0.133, -0.208, 0.172, 0.894},
    {0.134, 0.190, 0.424, 0.514, 0.425, 0.408, 0.187},
    {0.078, 0.075, 0.058, 0.033, 0.031, 0.028, 0.091},
    {0.052, 0.211, 0.595, 0.699, 0.575, 0.544, 0.066},
    {0.041, 0.054, 0.147, 0.217, 0.340, 0.340, 0.059},
    {0.009, 0.170, 0.155, 0.000, 0.001, 0.006, 0.000},
    {-0.147, -0.143, -0.082, -0.111, -0.086, -0.087, -0.189},
    {-0.027, -0.012, -0.001, 0.044, 0.011, -0.005, -0.042},
    {-0.014, -0.021, -0.001, -0.051, 0.004, 0.025, 0.009},
    {0.004, -0.095, -0.260, -0.275, -0.233, -0.245, 0.011},
    {0.011, -0.009, 0.033, 0.071, 0.062, 0.024, 0.001},
    {-0.003, -0.078, -0.175, -0.195, -0.142, -0.235, -0.028},
    {0.016, 0.034, 0.071, 0.083, 0.079, 0.009, 0.017},
    {0.003, -0.017, -0.013, 0.008, 0.029, 0.034, 0.022},
    {0.017, 0.034, 0.076, 0.144, 0.065, -0.066, 0.001},
    {0.000, -0.019, 0.009, -0.041, -0.058, -0.137, -0.010},
    {0.011, -0.180, -0.173, -0.012, -0.037, 0.000, -0.019},
    {0.007, -0.022, 0.010, 0.028, 0.011, 0.021, 0.004},
    {-0.015, -0.310, -0.263, -0.017, -0.016, -0.021, -0.018},
    {0.007, 0.007, -0.008, -0.017, -0.025, -0.035, -0.002},
    {-0.009, -0.152, 0.169, -0.003, -0.012, 0.008, 0.014},
    {0.044, 0.027, -0.036, 0.014, 0.008, 0.006, 0.080},
    {0.317, 0.327, 0.227, 0.101, 0.045, -0.034, -0.016},
    {0.050, 0.028, 0.107, 0.095, 0.197, 0.125, 0.030},
    {0.056, 0.087, 0.032, 0.010, 0.022, 0.036, 0.100},
    {0.029, 0.039, -0.062, 0.016, -0.013, -0.014, 0.006},
    {0.005, 0.068, 0.000, 0.020, 0.056, 0.040, 0.031},
    {0.014, -0.004, 0.043, 0.023, 0.065, 0.099, 0.006},
    {-0.031, -0.021, -0.055, 0.028, 0.014, 0.015, -0.012},
    {0.015, -0.005, -0.071, 0.008, 0.054, 0.086, -0.001},
    {0.006, 0.031, -0.031, -0.035, -0.003, -0.033, 0.017},
    {-0.023, -0.012, -0.059, 0.059, 0.116, 0.099, -0.004},
    {-0.021, -0.045, -0.009, 0.052, 0.140, 0.186, -0.004},
    {0.034, 0.068, 0.118, 0.008, -0.011, 0.019, 0.022},
    {0.005, 0.017, 0.043, 0.071, 0.021, 0.016, 0.007},
    {-0.035, -0.035, 0.028, -0.002, -0.007, -0.004, -0.008},
    {0.012, 0.049, 0.070, 0.122, 0.056, 0.047, 0.017},
    {-0.020, -0.021, -0.046, -0.119, -0.219, -0.230, -0.013},
    {0.028, 0.066, 0.121, 0.015, -0.013, -0.015, 0.007},
    {-0.010, -0.001, 0.042, 0.015, -0.021, 0.014, -0.023},
    {0.044, 0.014, 0.026, 0.009, -0.060, -0.041, -0.002},
    {-0.052, -0.085, -0.102, -0.070, -0.059, -0.007, -0.011},
    {-0.016, 0.026, -0.010, -0.015, 0.026, 0.040, 0.012},
    {0.019, 0.100, 0.184, 0.131, 0.162, 0.131, -0.021},
    {-0.015, 0.001, -0.032, -0.132, -0.172, -0.107, -0.040},
};
// The same without bedding: tau_c/sigma_c, mu, k_s/k_n.
constexpr std::array<double, n_intact> intact_table = {1.135, 0.149, 0.096, -0.202, -0.043,
                                                       0.004, 0.107, 0.114, 0.021,  -0.044};

/// Position of a positive number between two others, in logarithms: -1 at the lower, 1 at the higher.
double position(double value, double low, double high) {
  return std::clamp(2.0 * std::log(value / low) / std::log(high / low) - 1.0, -held, held);
}

/// 0 to 90: bedding at theta and at 180 - theta are mirror images.
std::vector<double> coefficients_at(double theta) {
  const double place = std::clamp(theta > 90.0 ? 180.0 - theta : theta, 0.0, 90.0) / angle_step;
  const int low = std::min(static_cast<int>(place), n_angles - 2);
  const double share = place - low;
  std::vector<double> coefficients;
  for (const auto& row : bedded_table)
    coefficients.push_back((1.0 - share) * row[low] + share * row[low + 1]);
  return coefficients;
}

/// Where a parameter stands among the ratios of a rock.
std::size_t index_of(const CalibratedParameter& p, bool bedded) {
  const std::vector<const StrengthParameter*> all = strength_ratios(bedded);
  return static_cast<std::size_t>(std::find(all.begin(), all.end(), &p) - all.begin());
}

/// A strength over sigma_c: the product of the ratios along its chain.
class OverSigmaC {
 public:
  explicit OverSigmaC(const CalibratedParameter& strength) {
    for (const CalibratedParameter* p = &strength; p->over != nullptr; p = p->over)
      chain_.insert(chain_.begin(), {p, index_of(*p, true)});
  }
  double at(std::span<const double> z) const {
    double product = 1.0;
    for (const auto& [ratio, i] : chain_) product *= ratio->at_place(z[i]);
    return product;
  }

 private:
  std::vector<std::pair<const CalibratedParameter*, std::size_t>> chain_;
};

/// log(tensile strength/sigma_c): the weaker of matrix and planes, with a smooth passage. `theta`: of the
/// planes against the pull.
struct Tension {
  bool bedded;
  double theta;
  OverSigmaC cohesion{joint_cohesion}, sigma_n{joint_sigma_n};

  double at(std::span<const double> z) const {
    constexpr double matrix = 0.55, sharpness = 4.0;
    if (!bedded) return std::log(matrix);
    const double c = std::cos(theta * pi / 180.0), s = std::sin(theta * pi / 180.0);
    const double opened = c * c / sigma_n.at(z), slid = std::fabs(s * c) / cohesion.at(z),
                 broken = 1.0 / matrix;
    return -std::log(std::pow(opened, sharpness) + std::pow(slid, sharpness) + std::pow(broken, sharpness)) /
           sharpness;
  }
};

}  // namespace

std::vector<const StrengthParameter*> regressed_ratios(bool bedded) {
  if (!bedded) return {&matrix_tau_c, &matrix_mu};
  return {&matrix_tau_c, &matrix_mu, &joint_cohesion, &joint_sigma_n, &joint_mu};
}

std::vector<double> regression_features(std::span<const double> places, std::span<const double> moduli) {
  std::vector<double> f = {1.0};
  const auto squares = [&](std::span<const double> v) {
    for (std::size_t i = 0; i < v.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j) f.push_back(v[i] * v[j]);
  };
  f.insert(f.end(), places.begin(), places.end());
  squares(places);
  f.insert(f.end(), moduli.begin(), moduli.end());
  for (const double m : moduli)
    for (const double z : places) f.push_back(m * z);
  squares(moduli);
  return f;
}

std::vector<double> regression_moduli(const Recipe& recipe) {
  const MatrixRecipe& m = recipe.matrix;
  std::vector<double> moduli = {position(m.ks_over_kn, 0.2, 0.6)};
  if (recipe.bedding.empty()) return moduli;
  const BeddingRecipe& b = recipe.bedding.front();
  moduli.push_back(position(b.k_n * b.spacing / m.E_c, 0.11, 1.76));
  moduli.push_back(position(b.k_s * b.spacing / m.E_c, 0.0315, 0.504));
  return moduli;
}

PriorRegression::PriorRegression(const Recipe& recipe, double theta) : moduli_(regression_moduli(recipe)) {
  const bool bedded = !recipe.bedding.empty();
  for (const StrengthParameter* p : regressed_ratios(bedded)) learnt_.push_back(index_of(*p, bedded));
  coefficients_ =
      bedded ? coefficients_at(theta) : std::vector<double>(intact_table.begin(), intact_table.end());
}

double PriorRegression::at(std::span<const double> z) const {
  std::vector<double> places;
  for (const std::size_t i : learnt_) places.push_back(z[i]);
  const std::vector<double> f = regression_features(places, moduli_);
  PHY_CHECK(f.size() == coefficients_.size(), "a coefficient per feature");
  using Vector = Eigen::Map<const Eigen::VectorXd>;
  const auto n = static_cast<Eigen::Index>(f.size());
  return Vector(coefficients_.data(), n).dot(Vector(f.data(), n));
}

PriorMean prior_strength(const Recipe& recipe, Property property, double theta) {
  if (property == Property::ucs)
    return {[e = PriorRegression(recipe, theta)](std::span<const double> z) { return e.at(z); }, 0.15, 0.06,
            0.04};
  const double across = property == Property::brazilian ? 90.0 - theta : theta;
  return {[t = Tension{!recipe.bedding.empty(), across}](std::span<const double> z) { return t.at(z); }, 0.4,
          0.2, 0.06};
}

}  // namespace phy::calibrate
