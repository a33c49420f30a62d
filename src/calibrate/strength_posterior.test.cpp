// The posterior of the strengths against a dense normal distribution of all that it compares.
#include "calibrate/strength_posterior.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdint>

#include "base/rng.hpp"
#include "maps/prior_regression.hpp"
#include "records/reading_fixture.hpp"

namespace phy::calibrate {
namespace {

constexpr double correlation = 0.4;  // of what a packing does to two strengths in compression

/// UCS at three angles and a tension, answered by twelve runs on six packings.
class Answered : public testing::Test {
 protected:
  Answered()
      : evidence_(rock()), posterior_(evidence_, evidence_.rock.model), middle_(posterior_.middle_of_box()) {
    for (std::uint32_t k = 0; k < 12; ++k) {
      Point x = middle_;
      for (std::size_t j = 1; j < x.size(); ++j)
        x[j] = 2.0 * uniform(3, Stream::test, k, static_cast<std::uint32_t>(j)) - 1.0;
      for (std::size_t i = 0; i < posterior_.n_targets(); ++i) {
        const double y = 0.7 + 0.2 * x[1] + 0.05 * normal(4, Stream::test, k, static_cast<std::uint32_t>(i));
        runs_[i].push_back({posterior_.inputs(x, i), static_cast<int>(k / 2), false, y});
        posterior_.add_run(i, runs_[i].back());
      }
    }
    posterior_.learn();
  }
  static Rock rock() {
    Rock r;
    r.model.bedding.resize(1);
    for (const double theta : {0.0, 45.0, 90.0}) r.readings.push_back(reading(Property::ucs, theta, 100e6));
    r.readings.push_back(reading(Property::direct_tension, 90.0, 10e6));
    return r;
  }
  /// Of the errors at a point, by factorising their whole covariance.
  double dense_log_density(const Point& x) const {
    const std::vector<StrengthPosterior::Miss> misses = posterior_.misses(x);
    const auto n = static_cast<Eigen::Index>(misses.size());
    Eigen::VectorXd error(n), by_packings(n);
    Eigen::MatrixXd covariance(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Surrogate alone(runs_[k],
                            maps::prior_strength(evidence_, evidence_.rock.model, posterior_.targets()[k]));
      error[i] = misses[k].error;
      by_packings[i] = is_compressive(misses[k].property) ? std::sqrt(alone.packing_variance()) : 0.0;
    }
    covariance = correlation * by_packings * by_packings.transpose();
    for (Eigen::Index i = 0; i < n; ++i) {
      const StrengthPosterior::Miss& m = misses[static_cast<std::size_t>(i)];
      covariance(i, i) = m.variance + m.scatter;
    }
    const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
    const Eigen::MatrixXd L = factor.matrixL();
    double prior = 0.0;
    for (std::size_t j = 1; j < x.size(); ++j) {
      const Parameter& p = *posterior_.parameters()[j];
      const double of_usual = std::log(p.from_normalised(x[j]) / p.range.usual);
      prior += of_usual * of_usual / (p.range.sd * p.range.sd);
    }
    return -0.5 * (error.dot(factor.solve(error)) + prior) - L.diagonal().array().log().sum();
  }
  Evidence evidence_;
  StrengthPosterior posterior_;
  Point middle_;
  std::vector<SurrogateRun> runs_[4];
};

TEST_F(Answered, IntervalsKnowThatOnePackingServesAllAngles) {
  posterior_.use_full_errors();
  for (std::uint32_t k = 0; k < 20; ++k) {
    Point x = middle_;
    for (std::size_t j = 0; j < x.size(); ++j)
      x[j] += 0.3 * (uniform(5, Stream::test, k, static_cast<std::uint32_t>(j)) - 0.5);
    EXPECT_NEAR(posterior_.log_density(x, StrengthPosterior::none), dense_log_density(x), 1e-9);
  }
}

// With all else as it is: the scale, which every strength tells, is known less well than from as many
// strengths that err each for itself.
TEST_F(Answered, TheScaleIsKnownLessWell) {
  const auto curvature = [&] {
    constexpr double h = 1e-3;
    Point less = middle_, more = middle_;
    less.front() -= h, more.front() += h;
    const auto at = [&](const Point& x) { return posterior_.log_density(x, StrengthPosterior::none); };
    return -(at(more) - 2.0 * at(middle_) + at(less)) / (h * h);
  };
  const double searching = curvature();
  posterior_.use_full_errors();
  EXPECT_LT(curvature(), 0.99 * searching);
}

// A laboratory takes the mean of its specimens, and so does the verification; runs are learnt by their
// logarithms, whose mean is lower where specimens scatter.
TEST(Predicted, TheMeanOfStrengthsIsMeantNotThatOfLogarithms) {
  constexpr std::uint32_t n = 80;
  constexpr double scatter = 0.15;
  Rock rock;
  rock.model.bedding.resize(1);
  rock.readings.push_back(reading(Property::ucs, 0.0, 100e6));
  const Evidence evidence(rock);
  StrengthPosterior posterior(evidence, rock.model);
  const Point x = posterior.middle_of_box();
  posterior.learn();
  const double level = posterior.predict(x, 0).mean - StrengthPosterior::log_sigma_c(x);  // of the prior
  double logarithms = 0.0, strengths = 0.0;
  for (std::uint32_t k = 0; k < n; ++k) {
    const double y = level + scatter * normal(6, Stream::test, k);
    posterior.add_run(0, {posterior.inputs(x, 0), static_cast<int>(k), false, y});
    logarithms += y / n, strengths += std::exp(y) / n;
  }
  posterior.learn();
  const double predicted = posterior.predict(x, 0).mean - StrengthPosterior::log_sigma_c(x);
  EXPECT_NEAR(predicted, std::log(strengths), 0.003);
  EXPECT_GT(predicted, logarithms + 0.007);
}

}  // namespace
}  // namespace phy::calibrate
