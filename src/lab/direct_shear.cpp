#include "lab/direct_shear.hpp"

#include <algorithm>
#include <cmath>

#include "lab/rigs.hpp"

namespace phy {
namespace {

constexpr double close_enough = 2e-3;  // of the normal stress
constexpr double servo_speed = 20.0;   // of the boxes: grains that ride up push them apart fast

}  // namespace

DirectShearTest::DirectShearTest(const std::shared_ptr<const Specimen>& specimen, const Recipe& recipe,
                                 LaneGroup& group, int lane)
    : LabTest(specimen, recipe, group, lane), stiffness_(plane_stiffness(*specimen, recipe.test.shear_gap)) {
  begin();
}

/// The upper box pushes down: its force on the specimen is negative along y. `offset` is its displacement
/// where the spring is slack. Free grains in a gap carry waves: with the gains of the servo (rig.hpp) the
/// stress swings for ever where its stiffness is less than 0.4 of what answers within a block; more only
/// makes it slower.
Servo DirectShearTest::normal_load(double stress, double spring, double offset) const {
  const double length = packing().width;
  Servo s;
  s.on = true;
  const double block = result_.dt * static_cast<double>(recipe_.test.history_interval);
  const double wave = recipe_.test.shear_gap > 0.0 ? wave_stiffness(specimen_->matrix, length, block) : 0.0;
  s.stiffness = stiffness_ + wave + spring * length;
  s.spring = spring * length;
  s.force = -stress * length + s.spring * offset;
  s.max_speed = servo_speed * recipe_.test.platen_speed;
  return s;
}

void DirectShearTest::on_placed() {
  if (recipe_.test.normal_stress == 0.0) return start_loading();
  group_->hold_bonds(lane_, specimen_->matrix.unbreakable);
  prepare(0);
}

bool DirectShearTest::prepare(std::int64_t n_blocks) {
  const double target = recipe_.test.normal_stress;
  const double ramp = target / (stiffness_ / packing().width) / recipe_.test.platen_speed;
  const double time = static_cast<double>(n_blocks * recipe_.test.history_interval) * result_.dt;
  const double now = target * std::min(1.0, time / ramp);
  group_->drive(lane_, 1, {{}, 0.0, {}, normal_load(now, 0.0, 0.0)});
  if (n_blocks == 0) return false;
  return load_once_steady(now == target, group_->row(lane_).lateral_stress / target, close_enough);
}

void DirectShearTest::drive() {
  const double speed = recipe_.test.platen_speed;
  const double ramp = recipe_.test.ramp_strain * packing().width / speed;
  const Servo load = normal_load(recipe_.test.normal_stress, recipe_.test.normal_stiffness,
                                 group_->tool(lane_, 1).displacement.y);
  group_->drive(lane_, 0, {{-speed, 0.0}, ramp, {}, {}});
  group_->drive(lane_, 1, {{speed, 0.0}, ramp, {}, load});
}

AnalysisOptions DirectShearTest::analysis() const {
  AnalysisOptions options;
  options.normal_load = {recipe_.test.normal_stress, recipe_.test.normal_stiffness};
  return options;
}

}  // namespace phy
