// The Eq. 1 fit on exact data, on scattered data with a known answer, on every elastic tensor of data/rocks,
// and on data that it must refuse.
#include "theory/eq1_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "base/rng.hpp"
#include "theory/transverse_isotropy.hpp"

namespace phy::theory {
namespace {

const std::vector<double> seven{0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0};
const JointedRock known{45.3e9, 32e9, 8.3e9, 0.0};

std::vector<ModulusReading> exact(const JointedRock& rock, const std::vector<double>& angles) {
  std::vector<ModulusReading> readings;
  for (double theta : angles) readings.push_back({theta, goodman_E(rock, theta)});
  return readings;
}

TEST(Eq1Fit, RecoversExactDataWithEveryLossAndReference) {
  for (Eq1Loss loss : {Eq1Loss::compliance, Eq1Loss::modulus})
    for (Eq1Reference reference : {Eq1Reference::given, Eq1Reference::measured_90, Eq1Reference::free}) {
      const Eq1Fit fit = fit_eq1(exact(known, seven), {loss, reference, known.E});
      ASSERT_TRUE(fit.ok()) << fit.reason;
      EXPECT_NEAR(fit.rock.E / known.E, 1.0, 1e-10);
      EXPECT_NEAR(fit.rock.K_n_delta / known.K_n_delta, 1.0, 1e-10);
      EXPECT_NEAR(fit.rock.K_s_delta / known.K_s_delta, 1.0, 1e-10);
      EXPECT_NEAR(fit.R2, 1.0, 1e-12);
      EXPECT_EQ(fit.shape.type, CurveType::shoulder);
      ASSERT_EQ(fit.residual.size(), seven.size());
      for (double r : fit.residual) EXPECT_NEAR(r / known.E, 0.0, 1e-10);
      EXPECT_EQ(fit.degrees_of_freedom, reference == Eq1Reference::given ? 5 : 4);
      EXPECT_FALSE(fit.note.empty());
    }
}

TEST(Eq1Fit, MirroredAnglesAreTheSameData) {
  std::vector<ModulusReading> mirrored = exact(known, seven);
  for (ModulusReading& r : mirrored) r.theta = 180.0 - r.theta;
  const Eq1Options options{Eq1Loss::modulus, Eq1Reference::free, 0.0};
  EXPECT_EQ(fit_eq1(mirrored, options).rock.K_s_delta, fit_eq1(exact(known, seven), options).rock.K_s_delta);
}

// The fit must be the minimum of the loss it names: no neighbour may be better.
TEST(Eq1Fit, EachLossIsAtItsOwnMinimum) {
  std::vector<ModulusReading> scattered = exact(known, seven);
  for (std::size_t i = 0; i < scattered.size(); ++i)
    scattered[i].E *= 1.0 + 0.05 * normal(7, Stream::test, static_cast<std::uint32_t>(i));
  const auto misfit = [&](Eq1Loss loss, double e, double a, double b) {
    double sum = 0.0;
    for (const ModulusReading& r : scattered) {
      const double model = goodman_E({1.0 / e, 1.0 / a, 1.0 / b, 0.0}, r.theta);
      const double d = loss == Eq1Loss::modulus ? (r.E - model) / 1e10 : 1e10 / r.E - 1e10 / model;
      sum += d * d;
    }
    return sum;
  };
  for (Eq1Loss loss : {Eq1Loss::compliance, Eq1Loss::modulus}) {
    const Eq1Fit fit = fit_eq1(scattered, {loss, Eq1Reference::free, 0.0});
    ASSERT_TRUE(fit.ok()) << fit.reason;
    const double best = misfit(loss, fit.e, fit.a, fit.b);
    for (double h : {-1e-4, 1e-4}) {
      EXPECT_GT(misfit(loss, fit.e * (1.0 + h), fit.a, fit.b), best);
      EXPECT_GT(misfit(loss, fit.e, fit.a * (1.0 + h), fit.b), best);
      EXPECT_GT(misfit(loss, fit.e, fit.a, fit.b * (1.0 + h)), best);
    }
  }
  const double soft = fit_eq1(scattered, {Eq1Loss::compliance, Eq1Reference::free, 0.0}).rock.K_s_delta;
  const double stiff = fit_eq1(scattered, {Eq1Loss::modulus, Eq1Reference::free, 0.0}).rock.K_s_delta;
  EXPECT_GT(std::abs(soft / stiff - 1.0), 1e-4);  // the losses are not the same question
}

// 400 noisy repeats with fixed seeds: the spread of K must be what the standard errors say. The ratio of the
// root mean squares has a relative scatter of about 1/sqrt(2*400) + the error's own, so 15 % is more than
// three standard deviations.
TEST(Eq1Fit, StandardErrorsPredictTheSpread) {
  double square_n = 0.0, square_s = 0.0, claim_n = 0.0, claim_s = 0.0;
  const std::uint32_t repeats = 400;
  for (std::uint32_t seed = 0; seed < repeats; ++seed) {
    std::vector<ModulusReading> readings =
        exact(known, {0.0, 0.0, 15.0, 15.0, 30.0, 30.0, 45.0, 45.0, 60.0, 75.0, 90.0});
    for (std::size_t i = 0; i < readings.size(); ++i)
      readings[i].E += 0.2e9 * normal(seed, Stream::test, static_cast<std::uint32_t>(i), 1);
    const Eq1Fit fit = fit_eq1(readings, {Eq1Loss::modulus, Eq1Reference::given, known.E});
    ASSERT_TRUE(fit.ok()) << fit.reason;
    square_n += std::pow(fit.rock.K_n_delta - known.K_n_delta, 2);
    square_s += std::pow(fit.rock.K_s_delta - known.K_s_delta, 2);
    claim_n += fit.se_K_n_delta * fit.se_K_n_delta;
    claim_s += fit.se_K_s_delta * fit.se_K_s_delta;
  }
  EXPECT_NEAR(std::sqrt(square_n / claim_n), 1.0, 0.15);
  EXPECT_NEAR(std::sqrt(square_s / claim_s), 1.0, 0.15);
}

TEST(Eq1Fit, ThreeReadingsLeaveNothingForAnError) {
  const Eq1Fit fit = fit_eq1(exact(known, {0.0, 45.0, 90.0}), {Eq1Loss::compliance, Eq1Reference::free, 0.0});
  ASSERT_TRUE(fit.ok()) << fit.reason;
  EXPECT_EQ(fit.degrees_of_freedom, 0);
  EXPECT_TRUE(std::isnan(fit.se_K_n_delta));
  EXPECT_NEAR(fit.rock.K_n_delta / known.K_n_delta, 1.0, 1e-10);
}

TEST(Eq1Fit, WrongReferenceShowsInR2) {
  JointedRock weak_along = known;
  weak_along.E = 0.6 * known.E;  // bedding zones: E(90) far below the intact rock
  const Eq1Fit given = fit_eq1(exact(weak_along, seven), {Eq1Loss::compliance, Eq1Reference::given, known.E});
  const Eq1Fit measured =
      fit_eq1(exact(weak_along, seven), {Eq1Loss::compliance, Eq1Reference::measured_90, 0.0});
  ASSERT_TRUE(given.ok() && measured.ok());
  EXPECT_LT(given.R2, 0.5);
  EXPECT_NEAR(measured.R2, 1.0, 1e-12);
  EXPECT_LT(given.residual.back(), 0.0);
}

Eq1Status status_of(const std::vector<ModulusReading>& readings, Eq1Options options) {
  const Eq1Fit fit = fit_eq1(readings, options);
  EXPECT_EQ(fit.ok(), fit.reason.empty());
  return fit.status;
}

TEST(Eq1Fit, RefusesWhatItCannotHold) {
  const Eq1Options given{Eq1Loss::compliance, Eq1Reference::given, known.E};
  const Eq1Options at_90{Eq1Loss::compliance, Eq1Reference::measured_90, 0.0};
  const Eq1Options free{Eq1Loss::compliance, Eq1Reference::free, 0.0};
  EXPECT_EQ(status_of({}, given), Eq1Status::too_few_angles);
  EXPECT_EQ(status_of(exact(known, {0.0, 45.0, 45.0}), given), Eq1Status::too_few_angles);
  EXPECT_EQ(status_of(exact(known, {45.0, 90.0, 135.0}), free), Eq1Status::too_few_angles);
  EXPECT_EQ(status_of(exact(known, {0.0, 10.0, 20.0, 70.0, 90.0}), given), Eq1Status::no_oblique_angle);
  EXPECT_EQ(status_of(exact(known, {0.0, 30.0, 60.0}), at_90), Eq1Status::no_reading_at_90);
  EXPECT_EQ(status_of({{0.0, 1e9}, {45.0, -1e9}, {90.0, 2e9}}, given), Eq1Status::bad_reading);
  EXPECT_EQ(status_of(exact(known, seven), {Eq1Loss::compliance, Eq1Reference::given, 0.0}),
            Eq1Status::bad_reading);
}

// Such numbers come out of files that somebody has changed.
TEST(Eq1Fit, RefusesModuliWhoseComplianceIsNoNumber) {
  for (const double tiny : {4.9e-324, 1e-310, 1e-300})
    for (const std::size_t at : {0U, 3U, 6U})
      for (const Eq1Loss loss : {Eq1Loss::compliance, Eq1Loss::modulus})
        for (const Eq1Reference reference :
             {Eq1Reference::given, Eq1Reference::measured_90, Eq1Reference::free}) {
          std::vector<ModulusReading> readings = exact(known, seven);
          readings[at].E = tiny;
          const Eq1Fit fit = fit_eq1(readings, {loss, reference, known.E});
          EXPECT_TRUE(!fit.ok() || std::isfinite(fit.a + fit.b)) << tiny << " " << at;
          EXPECT_EQ(fit.ok(), fit.reason.empty());
        }
}

TEST(Eq1Fit, RefusesNegativeStiffnessesWithAReason) {
  for (Eq1Loss loss : {Eq1Loss::compliance, Eq1Loss::modulus}) {
    std::vector<ModulusReading> turned = exact(known, seven);  // theta and beta confused
    for (ModulusReading& r : turned) r.theta = 90.0 - r.theta;
    const Eq1Fit confused = fit_eq1(turned, {loss, Eq1Reference::free, 0.0});
    EXPECT_EQ(confused.status, Eq1Status::K_n_not_positive);
    EXPECT_NE(confused.reason.find("angle convention"), std::string::npos);
    EXPECT_LT(confused.a, 0.0);
    const std::vector<ModulusReading> hump{
        {0.0, 20e9}, {30.0, 32e9}, {45.0, 42e9}, {60.0, 44e9}, {90.0, 40e9}};
    const Eq1Fit stiff = fit_eq1(hump, {loss, Eq1Reference::free, 0.0});
    EXPECT_EQ(stiff.status, Eq1Status::K_s_not_positive);
    EXPECT_LT(stiff.b, 0.0);
  }
  EXPECT_EQ(
      fit_eq1(exact({45e9, INFINITY, INFINITY, 0.0}, seven), {Eq1Loss::compliance, Eq1Reference::free, 0.0})
          .status,
      Eq1Status::K_n_not_positive);  // intact rock has no joints to fit
}

// --- the elastic tensors of data/rocks
// -------------------------------------------------------------------------------

std::vector<std::string> split_csv(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

// rock + confining pressure + source -> readings.
std::map<std::string, std::vector<ModulusReading>> all_tensors() {
  std::map<std::string, std::vector<ModulusReading>> tensors;
  for (const auto& entry : std::filesystem::directory_iterator(PHY_SOURCE_DIR "/data/rocks")) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("dyn_", 0) != 0) continue;
    std::ifstream file(entry.path());
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
      const std::vector<std::string> cell = split_csv(line);
      tensors[cell[0] + " | " + cell[2] + " MPa | " + cell[8]].push_back(
          {std::stod(cell[1]), 1e9 * std::stod(cell[3])});
    }
  }
  return tensors;
}

double E_at(const std::vector<ModulusReading>& readings, double theta) {
  for (const ModulusReading& r : readings)
    if (r.theta == theta) return r.E;
  return std::nan("");
}

// The tables give E at seven angles, computed from a tensor and rounded to 0.01 GPa. Eq. 1 is exact for a
// tensor, so three of its values fix the answer: a = 1/E_0 - 1/E_90, b = 4/E_45 - 4/E_90 - a. Rounding
// (uniform, standard deviation 0.01/sqrt(12) GPa) gives that answer an error s of its own; the fit over seven
// angles must agree within 2 % or 3 s. Exactness also means that the four angles the analytic answer does not
// use must lie on the curve to the rounding.
TEST(Eq1Fit, FindsTheStiffnessesOfEveryElasticTensor) {
  const auto tensors = all_tensors();
  ASSERT_EQ(tensors.size(), 26U);
  const double rounding = 0.01e9 / std::sqrt(12.0);
  for (const auto& [name, readings] : tensors) {
    ASSERT_EQ(readings.size(), 7U) << name;
    const double E_0 = E_at(readings, 0.0), E_45 = E_at(readings, 45.0), E_90 = E_at(readings, 90.0);
    const double s_0 = rounding / (E_0 * E_0), s_45 = rounding / (E_45 * E_45),
                 s_90 = rounding / (E_90 * E_90);
    const double a = 1.0 / E_0 - 1.0 / E_90;
    const double b = 4.0 / E_45 - 4.0 / E_90 - a;
    const double K_n = 1.0 / a, K_s = 1.0 / b;
    const double tolerance_n = std::max(0.02 * K_n, 3.0 * K_n * K_n * std::hypot(s_0, s_90));
    const double tolerance_s =
        std::max(0.02 * K_s, 3.0 * K_s * K_s * std::hypot(s_0, 4.0 * s_45, 3.0 * s_90));
    for (Eq1Loss loss : {Eq1Loss::compliance, Eq1Loss::modulus})
      for (Eq1Reference reference : {Eq1Reference::measured_90, Eq1Reference::free}) {
        const Eq1Fit fit = fit_eq1(readings, {loss, reference, 0.0});
        ASSERT_TRUE(fit.ok()) << name << ": " << fit.reason;
        EXPECT_NEAR(fit.rock.K_n_delta, K_n, tolerance_n) << name;
        EXPECT_NEAR(fit.rock.K_s_delta, K_s, tolerance_s) << name;
        EXPECT_GT(fit.R2, 0.9998) << name;
        for (double r : fit.residual) EXPECT_LT(std::abs(r), 0.02e9) << name;
      }
    const TransverseIsotropy body = ti_from_three_tests(E_0, E_45, E_90, 0.15, 0.15);
    const JointedRock same = goodman_from_ti(body);
    EXPECT_NEAR(same.K_n_delta / K_n, 1.0, 1e-9) << name;
    EXPECT_NEAR(same.K_s_delta / K_s, 1.0, 1e-9) << name;
  }
}

}  // namespace
}  // namespace phy::theory
