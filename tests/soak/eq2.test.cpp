// Eq. 2 of the paper by the direct solution: on the dense packing with the crossing rule each macro joint
// stiffness is a straight line of its own micro stiffness.
#include <gtest/gtest.h>

#include <algorithm>

#include "../program.hpp"
#include "study/effects.hpp"
#include "study/store_queue.hpp"
#include "study/study_in.hpp"
#include "study/table.hpp"
#include "study/worker.hpp"

namespace phy {
namespace {

class PaperEq2 : public ProgramTest {};

double straightness(const std::vector<study::Effect>& effects) {
  return std::ranges::find(effects, "R2", &study::Effect::name)->value.mean;
}

TEST_F(PaperEq2, DensePackingCrossingRuleGivesLines) {
  study::Study s = study::read_study(PHY_SOURCE_DIR "/examples/paper/elastic-crossing.toml");
  s.packings = {1};
  for (study::Factor& f : s.vary)
    std::erase_if(f.levels, [&](double v) { return v > 1.6 * f.key.get(s.base); });
  const study::Plan plan = study::make_plan(s);
  study::Store store(at("study.sqlite"));
  study::MachineOptions machine;
  machine.threads = 2;
  study::StoreQueue queue(plan, store, {}, machine.threads);
  study::work_at(queue, plan, machine);
  const study::JointFits fits = study::fit_joints(plan, study::rows_of(plan, store), {"E_gauge"});
  EXPECT_GE(straightness(study::effects_of(plan, fits.K_n, 0)), 0.999);
  EXPECT_GE(straightness(study::effects_of(plan, fits.K_s, 1)), 0.995);
}

}  // namespace
}  // namespace phy
