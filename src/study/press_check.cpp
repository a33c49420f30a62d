#include "study/press_check.hpp"

#include <memory>

#include "base/nan.hpp"
#include "base/stats.hpp"
#include "study/worker.hpp"

namespace phy::study {
namespace {

// Per platen [m/s]. The first wave crosses a specimen of any size some 100 times until the strain is reached.
constexpr double speed = 0.004;
constexpr double ramp_strain = 2e-5;

Recipe short_test(Recipe r) {
  r.test.kind = TestKind("uniaxial");  // as in the direct solution, whatever test the recipe names
  r.test.platen_speed = speed, r.test.ramp_strain = ramp_strain;
  // To a given small strain, whatever happens: no rule ends the test before.
  r.test.max_strain = press_check_strain, r.test.pre_strain = r.test.approach_strain = 0.0;
  r.test.stop_at = 0.0, r.test.post_peak = 0.0, r.test.platen_friction = 0.0;
  r.test.n_snapshots = 0;
  return r;
}

/// The specimens with all overlaps stress-free, as the direct solution takes them.
std::vector<std::shared_ptr<const Specimen>> stress_free(const std::vector<Specimen>& specimens,
                                                         bool elastic) {
  // One copy per packing: specimens that shared one go on sharing it.
  std::vector<std::shared_ptr<const Specimen>> list;
  std::shared_ptr<const Packing> original, copy;
  for (const Specimen& s : specimens) {
    if (s.packing != original) {
      auto p = std::make_shared<Packing>(*s.packing);
      p->stress_free = true;
      original = s.packing, copy = std::move(p);
    }
    auto specimen = std::make_shared<Specimen>(s);
    specimen->packing = copy;
    // `elastic`: bonds cannot break; otherwise the recipe decides.
    specimen->matrix.unbreakable = elastic || s.matrix.unbreakable;
    list.push_back(std::move(specimen));
  }
  return list;
}

PressModuli read(const TestResult& result) {
  PressModuli m;
  m.name = result.name;
  m.E = m.nu = nan;
  m.n_cracks = static_cast<std::int64_t>(result.cracks.size());
  const std::vector<HistoryRow>& rows = result.history.rows;
  // Ended before the strain was reached: no modulus.
  if (rows.empty() || rows.back().axial_strain < press_check_strain) {
    m.outcome = result.outcome.reason;
    return m;
  }
  std::vector<double> axial, lateral, stress;
  for (const HistoryRow& row : rows) {
    // The lower half contains the ramp of the platens.
    if (row.axial_strain < 0.5 * press_check_strain) continue;
    axial.push_back(row.axial_strain_gauge), lateral.push_back(row.lateral_strain_gauge);
    stress.push_back(row.axial_stress);
  }
  m.E = fit_line(axial, stress).slope;
  m.nu = -fit_line(axial, lateral).slope;
  m.slip_share = rows.back().slip / rows.back().boundary_work;
  return m;
}

}  // namespace

std::vector<PressModuli> press_moduli(const std::vector<Specimen>& specimens, const Recipe& recipe,
                                      const MachineOptions& machine, bool elastic) {
  std::vector<PressModuli> moduli;
  for (const TestResult& r : run_tests(stress_free(specimens, elastic), short_test(recipe), machine))
    moduli.push_back(read(r));
  return moduli;
}

}  // namespace phy::study
