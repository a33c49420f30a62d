#include "lab/uniaxial.hpp"

namespace phy {
namespace {

constexpr std::int64_t jump_cycles = 3000;  // damped cycles after the affine strain

}  // namespace

UniaxialTest::UniaxialTest(const std::shared_ptr<const Specimen>& specimen, const Recipe& recipe,
                           LaneGroup& group, int lane)
    : LabTest(specimen, recipe, group, lane), may_jump_(recipe.test.jump_strain > 0.0) {
  begin();
}

void UniaxialTest::on_placed() {
  if (!may_jump_) return start_loading();
  group_->hold_bonds(lane_, true);
  group_->jump(lane_, recipe_.test.jump_strain);
}

bool UniaxialTest::prepare(std::int64_t n_blocks) {
  if (n_blocks * recipe_.test.history_interval < jump_cycles) return false;
  may_jump_ = false;
  if (!specimen_->matrix.unbreakable && group_->at_strength(lane_))
    begin();
  else
    jumped_ = true, start_loading();
  return false;
}

void UniaxialTest::drive() { close_platens(packing().height); }

AnalysisOptions UniaxialTest::analysis() const {
  AnalysisOptions options;
  options.jump_strain = jumped_ ? recipe_.test.jump_strain : 0.0;
  return options;
}

}  // namespace phy
