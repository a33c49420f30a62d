// What contacts without a consistent state do to E and nu of the direct solution: specimens stopped after 1,
// 2, 3
// ... factorisations against the same ones solved to the end. The table stands in docs/reliability.md.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "statics/uniaxial.hpp"

namespace phy {
namespace {

struct Bin {
  double most;  ///< alternating contacts over all
  int n = 0;
  double squares_E = 0.0, worst_E = 0.0, worst_nu = 0.0;
};

/// 340 discs whose cement is as stiff as the grains, or a tenth of that, so that what only pushes carries
/// most.
std::vector<Specimen> specimens() {
  std::vector<Specimen> all;
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    Recipe r;
    r.specimen = {0.008, 0.016};
    r.packing.n_grains = 340, r.packing.seed = seed;
    r.bedding.push_back({});
    const auto packing =
        std::make_shared<const Packing>(genesis::make_packing(r.specimen, r.packing, r.matrix));
    for (const double cement : {1.0, 0.1})
      for (const double theta : {0.0, 30.0, 60.0, 90.0}) {
        Recipe one = r;
        one.matrix.E_b = cement * one.matrix.E_c;
        genesis::turn_layers(one.matrix, one.bedding, theta);
        all.push_back(genesis::make_specimen(packing, one.matrix, one.bedding, "one"));
      }
  }
  return all;
}

TEST(NotConverged, WhatTheLimitOfAlternatingContactsAllows) {
  std::vector<Bin> bins = {{0.0}, {0.005}, {0.01}, {0.02}, {0.05}, {0.1}, {1.0}};
  statics::UniaxialStatics statics;
  int n = 0, n_solved = 0;
  for (const Specimen& s : specimens()) {
    statics::ElasticOptions whole;
    whole.sensitivities = false;
    const ElasticResult end = statics.solve(s, whole);
    ++n;
    if (!end.outcome.ok()) continue;
    ++n_solved;
    statics::ElasticOptions short_of_it = whole;
    for (int i = 1; i < end.n_iterations; ++i) {
      short_of_it.max_iterations = i;
      const ElasticResult r = statics.solve(s, short_of_it);
      const double share = static_cast<double>(r.n_alternating) / static_cast<double>(s.contacts.size());
      const double error_E = r.E_gauge / end.E_gauge - 1.0, error_nu = r.nu_gauge - end.nu_gauge;
      for (Bin& b : bins) {
        if (share > b.most) continue;
        ++b.n, b.squares_E += error_E * error_E;
        b.worst_E = std::fmax(b.worst_E, std::fabs(error_E));
        b.worst_nu = std::fmax(b.worst_nu, std::fabs(error_nu));
        break;
      }
    }
  }
  std::printf("%d of %d solved\n", n_solved, n);
  for (const Bin& b : bins)
    std::printf("alternating up to %5.1f %%: %4d, E rms %7.3f %%, worst %7.3f %%, nu worst %.4f\n",
                100.0 * b.most, b.n, 100.0 * std::sqrt(b.squares_E / std::max(b.n, 1)), 100.0 * b.worst_E,
                b.worst_nu);
  EXPECT_GE(10 * n_solved, 9 * n);
  for (std::size_t i = 0; i < 2; ++i) {  // what may count as solved, even before E and nu stand still
    EXPECT_LT(bins[i].worst_E, 0.01);
    EXPECT_LT(bins[i].worst_nu, 0.015);
  }
}

}  // namespace
}  // namespace phy
