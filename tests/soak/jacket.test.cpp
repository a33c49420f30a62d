// A jacket at 10 MPa on ten packings of coarse grains, three angles, both precisions: no energy comes from
// nothing. Grains that break loose at the sides are driven by the pressure at tens of metres per second.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "analysis/analyse.hpp"
#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "setting.hpp"
#include "study/worker.hpp"

namespace phy {
namespace {

Recipe coarse(std::int64_t seed, Precision precision) {
  Recipe r;
  r.packing.n_grains = 1197;
  r.packing.radius_min = 0.625e-3, r.packing.radius_max = 1.0375e-3;
  r.packing.seed = seed;
  r.bedding = {BeddingRecipe{}};
  r.bedding[0].spacing = 12.5e-3, r.bedding[0].zone_thickness = 1.5e-3;
  r.test.kind = TestKind("biaxial");
  r.test.confining_stress = 10e6;
  r.test.confinement = Confinement::jacket;
  r.test.angles = {0, 30, 60};
  r.test.n_snapshots = 0;
  r.engine.precision = precision;
  return r;
}

std::vector<TestResult> press(const Recipe& r) {
  const auto packing =
      std::make_shared<const Packing>(genesis::make_packing(r.specimen, r.packing, r.matrix));
  std::vector<std::shared_ptr<const Specimen>> specimens;
  for (Specimen& s : genesis::make_specimens(packing, r))
    specimens.push_back(std::make_shared<const Specimen>(std::move(s)));
  study::MachineOptions machine;
  machine.isa = engine::native_isa();
  machine.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return study::run_tests(specimens, r, machine);
}

TEST(Jacket, MakesNoEnergy) {
  const auto packings = static_cast<std::int64_t>(setting("PHY_JACKET_PACKINGS", 10.0));
  for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
    double most = 0.0;
    fmt::print("{}: sigma_1 [MPa], energy error [1e-3] at 0, 30, 60 degrees\n",
               precision == Precision::double_precision ? "double" : "float");
    for (std::int64_t seed = 1; seed <= packings; ++seed) {
      fmt::print("{:>3}", seed);
      for (const TestResult& result : press(coarse(seed, precision))) {
        EXPECT_EQ(result.outcome.status, Status::peaked)
            << "packing " << seed << ", " << result.name << ": " << result.outcome.reason;
        const double error = analysis::find(result.numbers, "energy_error")->value;
        EXPECT_LT(error, 1e-3) << "packing " << seed << ", " << result.name;
        most = std::max(most, error);
        fmt::print("{:>9.2f} {:>5.2f}", analysis::find(result.numbers, "sigma_1")->value * 1e-6, 1e3 * error);
      }
      fmt::print("\n");
    }
    fmt::print("largest energy error {:.2e}\n", most);
  }
}

}  // namespace
}  // namespace phy
