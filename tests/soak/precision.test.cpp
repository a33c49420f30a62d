// Does single precision give the same rock? Seven angles, four bond seeds, both precisions. A single pair of
// runs says little: trajectories part, and another bond seed moves the strength as much. So means over the
// seeds are compared, and the spread over the seeds stands beside them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "analysis/analyse.hpp"
#include "base/stats.hpp"
#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "study/worker.hpp"

namespace phy {
namespace {

constexpr std::size_t n_seeds = 4;

struct Series {
  std::vector<std::vector<double>> ucs, E;  // [angle][seed]
};

Series press(Recipe r, Precision precision, const std::shared_ptr<const Packing>& packing) {
  r.engine.precision = precision;
  std::vector<std::shared_ptr<const Specimen>> specimens;
  for (std::size_t seed = 1; seed <= n_seeds; ++seed) {
    r.matrix.bond_seed = static_cast<std::int64_t>(seed);
    for (Specimen& s : genesis::make_specimens(packing, r))
      specimens.push_back(std::make_shared<const Specimen>(std::move(s)));
  }
  study::MachineOptions machine;
  machine.isa = engine::native_isa();
  machine.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const std::vector<TestResult> results = study::run_tests(specimens, r, machine);
  Series s;
  s.ucs.resize(r.test.angles.size()), s.E.resize(r.test.angles.size());
  for (std::size_t i = 0; i < results.size(); ++i) {
    EXPECT_EQ(results[i].outcome.status, Status::peaked) << results[i].name;
    s.ucs[i % r.test.angles.size()].push_back(analysis::find(results[i].numbers, "ucs")->value);
    s.E[i % r.test.angles.size()].push_back(analysis::find(results[i].numbers, "E_small")->value);
  }
  return s;
}

double mean(const std::vector<double>& v) { return summarise(v).mean; }
double spread(const std::vector<double>& v) { return summarise(v).sd; }

TEST(Precision, SingleAgainstDoubleBesideBondSeeds) {
  Recipe r;
  r.bedding = {BeddingRecipe{}};
  r.test.angles = {0, 15, 30, 45, 60, 75, 90};
  r.test.n_snapshots = 0;
  const auto packing =
      std::make_shared<const Packing>(genesis::make_packing(r.specimen, r.packing, r.matrix));
  const Series d = press(r, Precision::double_precision, packing),
               f = press(r, Precision::single_precision, packing);
  fmt::print("means of {} bond seeds +- standard deviation over them\n", n_seeds);
  fmt::print("{:>5} {:>18} {:>18} {:>7} {:>12} {:>12} {:>8}\n", "theta", "UCS double [MPa]",
             "UCS float [MPa]", "[%]", "E double", "E float", "[%]");
  std::vector<double> ucs_d, ucs_f, E_d, E_f;
  for (std::size_t i = 0; i < r.test.angles.size(); ++i) {
    ucs_d.push_back(mean(d.ucs[i])), ucs_f.push_back(mean(f.ucs[i]));
    E_d.push_back(mean(d.E[i])), E_f.push_back(mean(f.E[i]));
    const double off = ucs_f[i] / ucs_d[i] - 1.0;
    fmt::print("{:>5} {:>10.2f} +- {:>4.2f} {:>10.2f} +- {:>4.2f} {:>+7.2f} {:>12.4f} {:>12.4f} {:>+8.4f}\n",
               r.test.angles[i], ucs_d[i] * 1e-6, spread(d.ucs[i]) * 1e-6, ucs_f[i] * 1e-6,
               spread(f.ucs[i]) * 1e-6, 100.0 * off, E_d[i] * 1e-9, E_f[i] * 1e-9,
               100.0 * (E_f[i] / E_d[i] - 1.0));
    EXPECT_LT(std::fabs(off), 0.03) << "at " << r.test.angles[i] << " degrees";
  }
  fmt::print(" mean {:>10.2f} {:>26.2f} {:>+15.2f} {:>12.4f} {:>12.4f} {:>+8.4f}\n", mean(ucs_d) * 1e-6,
             mean(ucs_f) * 1e-6, 100.0 * (mean(ucs_f) / mean(ucs_d) - 1.0), mean(E_d) * 1e-9,
             mean(E_f) * 1e-9, 100.0 * (mean(E_f) / mean(E_d) - 1.0));
  EXPECT_LT(std::fabs(mean(ucs_f) / mean(ucs_d) - 1.0), 0.01);
  EXPECT_LT(std::fabs(mean(E_f) / mean(E_d) - 1.0), 0.001);
}

}  // namespace
}  // namespace phy
