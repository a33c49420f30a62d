// Envelopes: from peaks to fits, and the whole way on a small specimen.
#include "study/envelope.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/analyse.hpp"
#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "study/worker.hpp"
#include "theory/hoek_brown.hpp"

namespace phy::study {
namespace {

TestResult peak(double theta, double sigma_1) {
  TestResult r;
  r.name = "theta = " + std::to_string(static_cast<int>(theta)) + " deg";
  r.kind = TestKind("biaxial"), r.intact = false, r.theta = theta;
  r.outcome.status = Status::peaked;
  r.numbers = {{"sigma_1", sigma_1, "Pa", "", ""}};
  return r;
}

Recipe bedded_rock() {
  Recipe r;
  r.bedding.resize(1);
  return r;
}

// Rock made of Saroglou & Tsiambaos: m_i = 10, k = 1 and 0.6.
TEST(Envelope, FindsAnisotropyAndLeavesOutWhatDidNotPeak) {
  EnvelopeTests tests{{0.0, 5e6, 10e6, 20e6}, {}};
  for (const double s : tests.confining)
    tests.results.push_back({peak(0.0, theory::saroglou_tsiambaos_sigma_1(90e6, 1.0, 10.0, s)),
                             peak(45.0, theory::saroglou_tsiambaos_sigma_1(50e6, 0.6, 10.0, s)),
                             peak(60.0, theory::saroglou_tsiambaos_sigma_1(40e6, 0.6, 10.0, s))});
  tests.results[1][1].outcome.status = Status::unstable;
  tests.results[1][1].numbers[0].value = 1e9;
  const Envelope e = fit_envelope(tests, bedded_rock());
  EXPECT_NEAR(e.m_i, 10.0, 1e-6);
  EXPECT_NEAR(e.specimens[0].k.value, 1.0, 1e-12);
  EXPECT_EQ(e.specimens[1].readings.size(), 3u);
  EXPECT_NEAR(e.specimens[1].k.value, 0.6, 1e-6);
  EXPECT_NEAR(e.specimens[2].hoek_brown.ucs.value, 40e6, 1.0);
  EXPECT_EQ(e.matrix, "theta = 0 deg");
  EXPECT_TRUE(e.plane.ok) << e.plane.reason;
  Recipe foliated = bedded_rock();
  foliated.matrix.tension_ratio = 2.0;
  const Envelope none = fit_envelope(tests, foliated);
  EXPECT_FALSE(none.plane.ok);
  EXPECT_NE(none.plane.reason.find("directions"), std::string::npos);
}

TEST(Envelope, ReadsKneesAndNamesThem) {
  EnvelopeTests tests{{0.0, 10e6, 20e6}, {}};
  for (const double s : tests.confining) tests.results.push_back({peak(0.0, 100e6 + 4.0 * s)});
  tests.results[2][0].outcome.status = Status::knee;
  tests.results[2][0].numbers.push_back({"strength_rule", 2.0, "1", "", ""});
  const Envelope e = fit_envelope(tests, bedded_rock());
  EXPECT_EQ(e.specimens[0].readings.size(), 3u);
  EXPECT_EQ(e.specimens[0].knees, std::vector<double>{20e6});
  EXPECT_NEAR(e.specimens[0].mohr_coulomb.ucs.value, 100e6, 1.0);
}

TEST(Envelope, ConfinementStrengthensAndOneThreadGivesTheSameBits) {
  Recipe r;
  r.specimen = {0.008, 0.016};
  r.packing.n_grains = 330;
  r.bedding.resize(1);
  r.bedding.front().spacing = 0.002;
  r.test.angles = {0.0, 90.0};
  r.test.platen_speed = 0.1;
  r.test.history_interval = 50;
  r.test.confinement = Confinement::jacket;
  r.test.stop_at = 0.9, r.test.max_strain = 0.05;
  r.engine.precision = Precision::single_precision;
  const auto packing =
      std::make_shared<const Packing>(genesis::make_packing(r.specimen, r.packing, r.matrix));
  std::vector<std::shared_ptr<const Specimen>> specimens;
  for (Specimen& s : genesis::make_specimens(packing, r))
    specimens.push_back(std::make_shared<const Specimen>(std::move(s)));
  MachineOptions one, two;
  one.isa = two.isa = engine::native_isa();
  two.threads = 2, two.lanes = 4;
  std::vector<std::vector<TestResult>> a;
  for (const double sigma_3 : {0.0, 4e6, 8e6}) {
    const Recipe confined = confined_recipe(r, sigma_3);
    a.push_back(run_tests(specimens, confined, one));
    const auto b = run_tests(specimens, confined, two);
    for (std::size_t k = 0; k < specimens.size(); ++k) EXPECT_EQ(a.back()[k].hash, b[k].hash);
  }
  for (std::size_t k = 0; k < specimens.size(); ++k) {
    ASSERT_EQ(a[2][k].outcome.status, Status::peaked) << a[2][k].outcome.reason;
    EXPECT_GT(analysis::find(a[2][k].numbers, "sigma_1")->value,
              analysis::find(a[0][k].numbers, "sigma_1")->value + 8e6);
  }
}

}  // namespace
}  // namespace phy::study
