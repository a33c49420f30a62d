#include "lab/biaxial/biaxial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "lab/biaxial/reading.hpp"
#include "lab/boundaries.hpp"

namespace phy::lab {

TestBoundary confined_platens(const Packing& packing, const TestRecipe& test) {
  TestBoundary press = platens(packing);
  engine::Boundary& boundary = press.boundary;
  // Free sides need neither walls nor jacket: the test is then a uniaxial one.
  if (test.confining_stress == 0.0) return press;
  if (test.confinement == Confinement::walls) {
    // Without friction: rough walls would carry a part of the axial load.
    boundary.bodies.push_back(flat_wall(packing, "left wall", {0.0, 0.0}, {1.0, 0.0}, false));
    boundary.bodies.push_back(flat_wall(packing, "right wall", {packing.width, 0.0}, {-1.0, 0.0}, false));
    boundary.lateral = {2, 3, {1.0, 0.0}};
    press.lateral = {packing.width, packing.height};
    return press;
  }
  boundary.jacket.sides = true;
  return press;
}

namespace {

constexpr double close_enough = 5e-3;  // of the target
constexpr double servo_speed = 20.0;  // of the platens while they bring the stress on, over their speed later
constexpr double most_confining_strain = 0.05;  // beyond, the specimen has failed under the confinement

/// For the servo of a pair of platens of that area, `length` apart [m]: change of force per displacement of
/// each within a block of `time`, of rock as stiff as its contacts, at rest and as a wave [N/m per m].
double block_stiffness(const Specimen& specimen, double area, double length, double time) {
  // Rock cannot be stiffer than its contacts: a servo that assumes this does not overshoot.
  return 2.0 * specimen.matrix.modulus() * area / length + wave_stiffness(specimen.matrix, area, time);
}

class BiaxialTest final : public Procedure {
 public:
  using Procedure::Procedure;

 private:
  void on_placed() override;
  bool prepare(std::int64_t n_blocks) override;
  void prescribe_motion() override;
  std::vector<Number> numbers(const analysis::WavePath& path) const override;

  /// A stress all round [Pa]: sides at once, platens by their servos; sides alone while the platens are
  /// driven.
  void confine(double stress, bool platens_too);
};

void BiaxialTest::confine(double stress, bool platens_too) {
  const Packing& p = packing();
  if (platens_too) {
    engine::Servo axial;
    axial.on = true;
    // The platens, too, have to let the specimen shorten under the stress all round.
    axial.force = stress * p.width;
    axial.stiffness = block_stiffness(*specimen_, p.width, p.height,
                                      result_.dt * static_cast<double>(recipe_.test.history_interval));
    axial.max_speed = servo_speed * recipe_.test.platen_speed;
    group_->prescribe(lane_, 0, {{}, 0.0, {}, axial});
    // Opposite bodies push against each other: up from below, down from above.
    axial.force = -axial.force;
    group_->prescribe(lane_, 1, {{}, 0.0, {}, axial});
  }
  if (recipe_.test.confinement == Confinement::jacket) return group_->press(lane_, stress);
  engine::PrescribedMotion wall;
  wall.balance_x = {true, stress * p.height};
  group_->prescribe(lane_, 2, wall);
  wall.balance_x.force = -wall.balance_x.force;
  group_->prescribe(lane_, 3, wall);
}

void BiaxialTest::on_placed() {
  if (recipe_.test.confining_stress == 0.0) return start_loading();
  // While the specimen settled nothing could break; what the confinement itself breaks is meant to show.
  group_->forbid_breakage(lane_, specimen_->matrix.unbreakable);
  prepare(0);
}

bool BiaxialTest::prepare(std::int64_t n_blocks) {
  const double target = recipe_.test.confining_stress, speed = recipe_.test.platen_speed;
  const double time = static_cast<double>(n_blocks * recipe_.test.history_interval) * result_.dt;
  // As fast as the platens would raise the stress of sound rock.
  const double ramp = target / specimen_->matrix.modulus() * packing().height / (2.0 * speed);
  // Brought up slowly: a sudden stress would be a wave of twice its height.
  const double now = target * std::min(1.0, time / ramp);
  confine(now, true);
  // Nothing has moved yet: there is no row to judge by.
  if (n_blocks == 0) return false;
  const HistoryRow& row = latest_row();
  if (std::fabs(row.axial_strain) > most_confining_strain)
    return end(
        Status::not_peaked,
        fmt::format("strain {:.1f} % before the confining stress was reached", 100.0 * row.axial_strain),
        "the rock does not bear this confining stress; lower it");
  const double axial =
      0.5 * (group_->body(lane_, 0).mean_force.y - group_->body(lane_, 1).mean_force.y) / packing().width;
  const double lateral = row.lateral_stress / target, along = axial / target;
  // Both have to be there: the strength depends on either.
  const double worse = std::fabs(lateral - 1.0) > std::fabs(along - 1.0) ? lateral : along;
  return load_once_steady(now == target, worse, close_enough);
}

void BiaxialTest::prescribe_motion() { close_platens(packing().height); }

std::vector<Number> BiaxialTest::numbers(const analysis::WavePath& path) const {
  return confined_numbers(result_.history, result_.cracks, recipe_.test.confining_stress, path, stop_rule());
}

std::string boundary_name_of(const Recipe& r) {
  if (r.test.confining_stress == 0.0) return "unconfined biaxial";
  return r.test.confinement == Confinement::walls ? "walls" : "jacket";
}

std::string sides_text(const TestRecipe& t) {
  if (t.confining_stress == 0.0) return "The sides were free (confining stress 0).";
  return fmt::format(
      "A confining stress of {} was brought up all round before the loading and held on the sides by {}.",
      print_quantity(t.confining_stress, Dimension::pressure),
      t.confinement == Confinement::walls ? "two rigid walls without friction"
                                          : "a pressure on the outermost grains, as by a rubber jacket");
}

HistoryColumns columns() {
  using Row = HistoryRow;
  return joined(
      {clock_columns(),
       {{"axial_strain", "1", "shortening between the platens since the confinement / initial height",
         &Row::axial_strain},
        {"lateral_strain", "1", "approach of the sides since the confinement / initial width",
         &Row::lateral_strain},
        {"volumetric_strain", "1", "axial + lateral strain", &Row::volumetric_strain}},
       gauge_columns(),
       platen_stress_columns(),
       {{"lateral_stress", "Pa", "mean side force / initial height, or pressure of the jacket",
         &Row::lateral_stress},
        {"deviatoric_stress", "Pa", "axial - lateral stress", &Row::deviatoric_stress}},
       balance_columns()});
}

TestDescription description() {
  TestDescription d;
  d.name = "biaxial", d.stress = "deviatoric stress";
  d.columns = columns();
  d.hashed = hashed_fields({"axial_strain", "lateral_strain", "volumetric_strain", "axial_strain_gauge",
                            "lateral_strain_gauge", "axial_stress", "stress_top", "stress_bottom",
                            "lateral_stress", "deviatoric_stress"});
  d.curve.stress = "deviatoric stress", d.curve.value = &HistoryRow::deviatoric_stress;
  d.curve.strength = "q_max", d.curve.strength_label = "largest deviatoric stress";
  d.table = {{"E tan50", "GPa", "E_tangent", 1e-9, 2},
             {"nu", "", "nu", 1.0, 3},
             {"sigma_3", "MPa", "sigma_3", 1e-6, 2},
             {"sigma_1", "MPa", "sigma_1", 1e-6, 2},
             {"q_max", "MPa", "q_max", 1e-6, 2},
             {"sigma_ci", "MPa, q", "sigma_ci", 1e-6, 2},
             {"ci strain", "MPa, q", "sigma_ci_strain", 1e-6, 2},
             {"sigma_cd", "MPa, q", "sigma_cd", 1e-6, 2},
             {"confinem.", "error", "confinement_error", 1.0, 4}};
  // Under confinement rock may yield without a peak.
  d.may_harden = true;
  d.kept_stress = {"confining_stress", &TestRecipe::confining_stress};
  d.loading_text = [](const Recipe& r) { return platens_text(r.test) + ". " + sides_text(r.test); };
  return d;
}

}  // namespace

const TestRoom& biaxial_room() {
  static const TestRoom room = {
      description(), boundary_name_of,
      [](const Packing& packing, const Recipe& r) { return confined_platens(packing, r.test); },
      begin_test<BiaxialTest>};
  return room;
}

}  // namespace phy::lab
