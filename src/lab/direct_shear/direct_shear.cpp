#include "lab/direct_shear/direct_shear.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "engine/stable_step.hpp"
#include "lab/boundaries.hpp"
#include "lab/direct_shear/reading.hpp"

namespace phy::lab {

TestBoundary shear_boxes(const Packing& packing, double gap) {
  TestBoundary box;
  engine::Boundary& boundary = box.boundary;
  boundary.bodies = {{"lower box", {}, {}, false}, {"upper box", {}, {}, false}};
  const double middle = 0.5 * packing.height;
  for (std::uint32_t i = 0; i < packing.discs.size(); ++i) {
    const double y = packing.discs[i].y - middle;
    // Held in every way: a box neither tilts nor lets its grains turn.
    if (y < -0.5 * gap) boundary.bodies[0].grips.push_back({i, true, true, true});
    if (y >= 0.5 * gap) boundary.bodies[1].grips.push_back({i, true, true, true});
  }
  // A displacement and no strain: what shears is a plane without thickness.
  set_axial(box, 1, 0, {1.0, 0.0}, {1.0, packing.width});
  boundary.lateral = {0, 1, {0.0, 1.0}};
  box.lateral = {1.0, packing.width};
  return box;
}

namespace {

constexpr double close_enough = 2e-3;  // of the normal stress
constexpr double servo_speed = 20.0;   // of the boxes: grains that ride up push them apart fast

/// For the servo of a shear box: normal stiffness at rest of what lies between the boxes, the contacts across
/// half the height in series with layers of sound rock that fill the gap [N/m per m].
double plane_stiffness(const Specimen& specimen, double gap) {
  const std::vector<Disc>& discs = specimen.packing->discs;
  const double middle = 0.5 * specimen.packing->height;
  double across = 0.0, sound = 0.0, radius = 0.0;  // sound: as if no joint were there
  const contact::Models& models = contact::models_of(specimen);
  for (Contact c : specimen.contacts) {
    // Contacts that cross the middle carry all of the normal load.
    if ((discs[c.a].y < middle) == (discs[c.b].y < middle)) continue;
    across += engine::initial_stiffness(models, specimen, c).k.k_n;
    if (c.kind == ContactKind::joint) c.kind = ContactKind::bonded;
    sound += engine::initial_stiffness(models, specimen, c).k.k_n;
  }
  for (const Disc& d : discs) radius += d.r / static_cast<double>(discs.size());
  // In series: the plane, and as many layers of grains as the gap has room for.
  return across / (1.0 + gap / (2.0 * radius) * (across / sound));
}

class DirectShearTest final : public Procedure {
 public:
  using Procedure::Procedure;

 private:
  void on_placed() override;
  bool prepare(std::int64_t n_blocks) override;
  void prescribe_motion() override;
  std::vector<Number> numbers(const analysis::WavePath& path) const override;

  engine::Servo normal_load(double stress, double spring, double offset) const;

  // Of what lies between the boxes, for the servo [N/m per m].
  double stiffness_ = plane_stiffness(*specimen_, recipe_.test.shear_gap);
};

/// The upper box pushes down: its force on the specimen is negative along y. `offset` is its displacement
/// where the spring is slack. Free grains in a gap carry waves: with the gains of the servo
/// (engine/boundary.hpp) the stress swings for ever where its stiffness is less than 0.4 of what answers
/// within a block; more only makes it slower.
engine::Servo DirectShearTest::normal_load(double stress, double spring, double offset) const {
  const double length = packing().width;
  engine::Servo s;
  s.on = true;
  const double block = result_.dt * static_cast<double>(recipe_.test.history_interval);
  const double wave = recipe_.test.shear_gap > 0.0 ? wave_stiffness(specimen_->matrix, length, block) : 0.0;
  s.stiffness = stiffness_ + wave + spring * length;
  s.spring = spring * length;
  // The spring counts from where shearing begins, not from where the box was set down.
  s.force = -stress * length + s.spring * offset;
  s.max_speed = servo_speed * recipe_.test.platen_speed;
  return s;
}

void DirectShearTest::on_placed() {
  // Boxes that nothing presses have no stress to wait for.
  if (recipe_.test.normal_stress == 0.0) return start_loading();
  group_->forbid_breakage(lane_, specimen_->matrix.unbreakable);
  prepare(0);
}

bool DirectShearTest::prepare(std::int64_t n_blocks) {
  const double target = recipe_.test.normal_stress;
  // As long as the box needs at its speed to press the plane together.
  const double ramp = target / (stiffness_ / packing().width) / recipe_.test.platen_speed;
  const double time = static_cast<double>(n_blocks * recipe_.test.history_interval) * result_.dt;
  const double now = target * std::min(1.0, time / ramp);
  group_->prescribe(lane_, 1, {{}, 0.0, {}, normal_load(now, 0.0, 0.0)});
  if (n_blocks == 0) return false;
  return load_once_steady(now == target, latest_row().lateral_stress / target, close_enough);
}

void DirectShearTest::prescribe_motion() {
  const double speed = recipe_.test.platen_speed;
  const double ramp = recipe_.test.ramp_strain * packing().width / speed;
  const engine::Servo load = normal_load(recipe_.test.normal_stress, recipe_.test.normal_stiffness,
                                         group_->body(lane_, 1).displacement.y);
  group_->prescribe(lane_, 0, {{-speed, 0.0}, ramp, {}, {}});
  group_->prescribe(lane_, 1, {{speed, 0.0}, ramp, {}, load});
}

std::vector<Number> DirectShearTest::numbers(const analysis::WavePath& /*the boxes carry no wave*/) const {
  return shear_numbers(result_.history, result_.cracks,
                       {recipe_.test.normal_stress, recipe_.test.normal_stiffness});
}

std::string loading_text_of(const Recipe& r) {
  const TestRecipe& t = r.test;
  return fmt::format(
      "The halves of the specimen, {}, were held in two boxes and sheared past each other at {} each, under "
      "a normal stress of {}{}.",
      t.shear_gap > 0.0 ? print_quantity(t.shear_gap, Dimension::length) + " of free rock between them"
                        : "each rigid",
      print_quantity(t.platen_speed, Dimension::speed), print_quantity(t.normal_stress, Dimension::pressure),
      t.normal_stiffness > 0.0 ? fmt::format(" that grew with dilation by {}",
                                             print_quantity(t.normal_stiffness, Dimension::stiffness))
                               : std::string(", kept constant"));
}

HistoryColumns columns() {
  using Row = HistoryRow;
  return joined(
      {clock_columns(),
       {{"shear_displacement", "m", "of the upper box against the lower one", &Row::axial_strain},
        {"normal_closure", "m", "approach of the boxes; dilation is negative", &Row::lateral_strain},
        {"shear_stress", "Pa", "mean box force along the plane / width", &Row::axial_stress},
        {"shear_stress_upper", "Pa", "upper box force along the plane / width", &Row::stress_bottom},
        {"shear_stress_lower", "Pa", "lower box force along the plane / width", &Row::stress_top},
        {"normal_stress", "Pa", "mean box force across the plane / width", &Row::lateral_stress}},
       balance_columns()});
}

/// Until joints that stick break; bonds, where there are none.
double strain_at_peak(const Recipe& r, double tau) {
  const MatrixRecipe& m = r.matrix;
  const double bonds = m.ks_over_kn * m.modulus() / (r.packing.radius_min + r.packing.radius_max);
  return tau / (r.bedding.empty() ? bonds : r.bedding.front().k_s) / r.specimen.width;
}

TestDescription description() {
  TestDescription d;
  d.name = "direct_shear", d.stress = "shear stress", d.body = "box";
  d.extent = "a shear displacement of {} % of the width";
  d.columns = columns();
  d.hashed = hashed_fields({"shear_displacement", "normal_closure", "shear_stress", "shear_stress_upper",
                            "shear_stress_lower", "normal_stress"});
  d.curve.strain = "shear displacement", d.curve.strain_unit = "mm", d.curve.strain_factor = 1000.0;
  d.curve.stress = "shear stress";
  d.curve.strength = "tau_peak", d.curve.strength_label = "peak shear strength";
  d.table = {{"sigma_n", "MPa", "sigma_n", 1e-6, 2}, {"tau peak", "MPa", "tau_peak", 1e-6, 2},
             {"u peak", "um", "u_peak", 1e6, 2},     {"tau resid.", "MPa", "tau_residual", 1e-6, 2},
             {"K_s", "GPa/m", "K_s", 1e-9, 1},       {"dilation", "deg", "dilation", 1.0, 2}};
  d.runs_to_end = true;
  d.may_approach = false;  // what is read begins with the first row
  d.kept_stress = {"normal_stress", &TestRecipe::normal_stress};
  d.expected.length = [](const Recipe& r) { return r.specimen.width; };
  // Rigid halves carry no wave; what takes time is their motion across the plane.
  d.peak_of_value.strain_of_plane = strain_at_peak, d.peak_of_value.wave_transits = 50.0;
  d.loading_text = loading_text_of;
  d.load_on_box = "", d.load_on_bedding = ", along which the boxes move";
  return d;
}

}  // namespace

const TestRoom& direct_shear_room() {
  static const TestRoom room = {
      description(),
      [](const Recipe& r) { return "direct_shear" + print_number(r.test.shear_gap); },
      [](const Packing& packing, const Recipe& r) { return shear_boxes(packing, r.test.shear_gap); },
      begin_test<DirectShearTest>,
      {"test.shear_gap", &TestRecipe::shear_gap, "boxes that hold discs", "lower it"}};
  return room;
}

}  // namespace phy::lab
