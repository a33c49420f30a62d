#include "design/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/check.hpp"
#include "base/least_squares.hpp"

namespace phy::design {
namespace {

constexpr double tolerance = 1e-12;  // of the sum and of the constants: far below what any test says

/// The place of a key; the number of keys: it is not there.
std::size_t place_of(const std::vector<Key>& keys, const Key& key) {
  return static_cast<std::size_t>(std::find(keys.begin(), keys.end(), key) - keys.begin());
}

double sum_of_squares(const Law& law, const Eigen::VectorXd& x) {
  Eigen::VectorXd r(static_cast<Eigen::Index>(law.n));
  law.misfits(x, r);
  return r.allFinite() ? r.squaredNorm() : std::numeric_limits<double>::infinity();
}

}  // namespace

const char* word_of(Refusal refusal) {
  switch (refusal) {
    case Refusal::none: return "";
    case Refusal::too_few: return "too_few";
    case Refusal::undetermined: return "undetermined";
    case Refusal::no_plane: return "no_plane";
    case Refusal::no_matrix: return "no_matrix";
    case Refusal::falling: return "falling";
    case Refusal::not_admissible: return "not_admissible";
    case Refusal::no_common: return "no_common";
    case Refusal::planes_absent: return "planes_absent";
    case Refusal::not_sought: return "not_sought";
    case Refusal::no_agreement: return "no_agreement";
  }
  return "";
}

bool Fit::has(const Key& key) const { return place_of(keys, key) < keys.size(); }

double Fit::value(const Key& key) const {
  const std::size_t i = place_of(keys, key);
  return i < keys.size() ? outer(key.constant, x[static_cast<Eigen::Index>(i)]) : nan;
}

Eigen::MatrixXd slopes_of(const std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)>& f,
                          const Eigen::VectorXd& x, Eigen::Index n) {
  // The cube root of the spacing of doubles: truncation and rounding are alike there.
  constexpr double step = 6e-6;
  Eigen::MatrixXd J(n, x.size());
  Eigen::VectorXd above(n), below(n);
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const double h = step * std::max(1.0, std::abs(x[j]));
    Eigen::VectorXd at = x;
    at[j] = x[j] + h, f(at, above);
    at[j] = x[j] - h, f(at, below);
    J.col(j) = (above - below) / (2.0 * h);
  }
  return J;
}

Fit fit_law(const Law& law, std::vector<Key> keys, const std::vector<Eigen::VectorXd>& starts) {
  const auto n = static_cast<Eigen::Index>(law.n), p = static_cast<Eigen::Index>(keys.size());
  if (n < p || starts.empty()) return refused(Refusal::too_few);
  const Misfits misfits{n, law.misfits,
                        [&](const auto& x, auto& slopes) { slopes = slopes_of(law.misfits, x, n); }};
  Fit fit{.refusal = Refusal::none, .keys = std::move(keys)};
  double least = std::numeric_limits<double>::infinity();
  // Laws with a choice of two have a minimum for each way to choose.
  for (const Eigen::VectorXd& start : starts) {
    if (!std::isfinite(sum_of_squares(law, start))) continue;
    const Eigen::VectorXd x = least_squares(misfits, start, {.tolerance = tolerance});
    const double sum = sum_of_squares(law, x);
    if (sum < least) least = sum, fit.x = x;
  }
  if (!std::isfinite(least)) return refused(Refusal::no_agreement);
  const Eigen::MatrixXd J = slopes_of(law.misfits, fit.x, n);
  if (!J.allFinite() || linear_least_squares(J, Eigen::VectorXd::Zero(n)).rank < p)
    return refused(Refusal::undetermined);
  fit.n = law.n, fit.error = std::sqrt(least / static_cast<double>(n));
  // As many constants as misfits leave no error to be seen: the draws alone give the interval then.
  const double variance = n > p ? least / static_cast<double>(n - p) : 0.0;
  fit.covariance = variance * inverse_of_squares(J);
  return fit;
}

Fit transformed(const Fit& fit, std::vector<Key> keys,
                const std::function<void(const Eigen::VectorXd&, Eigen::VectorXd&)>& f) {
  if (!fit.ok()) return fit;
  Fit other = fit;
  const auto n = static_cast<Eigen::Index>(keys.size());
  other.keys = std::move(keys), other.x.resize(n);
  f(fit.x, other.x);
  if (!other.x.allFinite()) return refused(Refusal::not_admissible);
  const Eigen::MatrixXd J = slopes_of(f, fit.x, n);
  other.covariance = J * fit.covariance * J.transpose();
  return other;
}

}  // namespace phy::design
