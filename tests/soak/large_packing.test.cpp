// A packing of a million discs: some five minutes of one core and 300 MB (PHY_LARGE_DISCS sets another
// number).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "genesis/packing.hpp"
#include "setting.hpp"
#include "system/process.hpp"

namespace phy {
namespace {

TEST(LargePacking, AMillionDiscsSettle) {
  const double n = setting("PHY_LARGE_DISCS", 1e6);
  Recipe r;
  const double larger = std::sqrt(n / static_cast<double>(r.packing.n_grains));
  r.specimen.width *= larger, r.specimen.height *= larger;
  r.packing.n_grains = std::llround(n);
  const double before = system::thread_seconds();
  const Packing packing = genesis::make_packing(r.specimen, r.packing, r.matrix);
  const PackingReport& p = packing.report;
  std::printf(
      "%zu discs: %.0f s of CPU, unbalanced %.2g, porosity %.4f, coordination %.3f, fabric %.4f, %lld "
      "rattlers\n",
      packing.discs.size(), system::thread_seconds() - before, p.unbalanced, p.porosity, p.coordination,
      p.fabric, static_cast<long long>(p.n_rattlers));
  EXPECT_LE(p.unbalanced, 1e-4);
  EXPECT_NEAR(p.porosity, 0.081, 0.003);  // of the paper's specimen
  EXPECT_NEAR(p.coordination, 5.0, 0.1);
  EXPECT_NEAR(p.fabric, 0.0, 0.005);
  EXPECT_LE(static_cast<double>(p.n_rattlers), 1e-3 * n);
}

}  // namespace
}  // namespace phy
