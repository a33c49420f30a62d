#include "lab/biaxial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/rigs.hpp"

namespace phy {
namespace {

constexpr double close_enough = 5e-3;  // of the target
constexpr double servo_speed = 20.0;  // of the platens while they bring the stress on, over their speed later
constexpr double most_confining_strain = 0.05;  // beyond, the specimen has failed under the confinement

}  // namespace

BiaxialTest::BiaxialTest(const std::shared_ptr<const Specimen>& specimen, const Recipe& recipe,
                         LaneGroup& group, int lane)
    : LabTest(specimen, recipe, group, lane) {
  begin();
}

void BiaxialTest::confine(double stress, bool platens_too) {
  const Packing& p = packing();
  if (platens_too) {
    Servo axial;
    axial.on = true;
    axial.force = stress * p.width;
    axial.stiffness = block_stiffness(*specimen_, p.width, p.height,
                                      result_.dt * static_cast<double>(recipe_.test.history_interval));
    axial.max_speed = servo_speed * recipe_.test.platen_speed;
    group_->drive(lane_, 0, {{}, 0.0, {}, axial});
    axial.force = -axial.force;
    group_->drive(lane_, 1, {{}, 0.0, {}, axial});
  }
  if (recipe_.test.confinement == Confinement::jacket) return group_->press(lane_, stress);
  Drive wall;
  wall.balance_x = {true, stress * p.height};
  group_->drive(lane_, 2, wall);
  wall.balance_x.force = -wall.balance_x.force;
  group_->drive(lane_, 3, wall);
}

void BiaxialTest::on_placed() {
  if (recipe_.test.confining_stress == 0.0) return start_loading();
  group_->hold_bonds(lane_, specimen_->matrix.unbreakable);
  prepare(0);
}

bool BiaxialTest::prepare(std::int64_t n_blocks) {
  const double target = recipe_.test.confining_stress, speed = recipe_.test.platen_speed;
  const MatrixRecipe& m = specimen_->matrix;
  const double time = static_cast<double>(n_blocks * recipe_.test.history_interval) * result_.dt;
  // As fast as the platens would raise the stress of sound rock.
  const double ramp = target / (m.E_c + m.E_b) * packing().height / (2.0 * speed);
  const double now = target * std::min(1.0, time / ramp);
  confine(now, true);
  if (n_blocks == 0) return false;
  const HistoryRow& row = group_->row(lane_);
  if (std::fabs(row.axial_strain) > most_confining_strain)
    return end(
        Status::not_peaked,
        fmt::format("strain {:.1f} % before the confining stress was reached", 100.0 * row.axial_strain),
        "the rock does not bear this confining stress; lower it");
  const double axial =
      0.5 * (group_->tool(lane_, 0).mean_force.y - group_->tool(lane_, 1).mean_force.y) / packing().width;
  const double lateral = row.lateral_stress / target, along = axial / target;
  const double worse = std::fabs(lateral - 1.0) > std::fabs(along - 1.0) ? lateral : along;
  return load_once_steady(now == target, worse, close_enough);
}

void BiaxialTest::drive() { close_platens(packing().height); }

AnalysisOptions BiaxialTest::analysis() const {
  AnalysisOptions options;
  options.confining_stress = recipe_.test.confining_stress;
  return options;
}

}  // namespace phy
