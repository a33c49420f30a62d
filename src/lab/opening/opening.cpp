#include "lab/opening/opening.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/specimen_checks.hpp"
#include "base/exact_math.hpp"
#include "base/units.hpp"
#include "lab/boundaries.hpp"
#include "lab/opening/reading.hpp"

namespace phy::lab {

double opening_diameter(const Recipe& recipe) {
  const double given = recipe.test.opening_diameter;
  return given > 0.0 ? given : 0.2 * std::min(recipe.specimen.width, recipe.specimen.height);
}

TestBoundary block_with_hole(const Packing& packing, double diameter) {
  TestBoundary block = platens(packing);
  // Sides that bend: between four rigid walls layered rock cannot shear, which would be a stress far away.
  block.boundary.jacket = {true, {{0.5 * packing.width, 0.5 * packing.height}, 0.5 * diameter}};
  return block;
}

namespace {

constexpr double quiet = 1e-3;                // mean unbalanced force / mean contact force
constexpr std::int64_t most_waiting = 40000;  // cycles, for an excavated opening to come to rest
constexpr double first_wave = 2e-4;           // strain in which walls that start to move get their stress
constexpr double most_strain = 0.05;          // beyond, the block has failed before there is an opening

class OpeningTest final : public Procedure {
 public:
  using Procedure::Procedure;

 private:
  enum class Stage { excavating, standing, raising };

  void on_placed() override;
  bool prepare(std::int64_t n_blocks) override;
  void prescribe_motion() override;
  void read_more(HistoryRow& row) override;
  bool after_row() override;
  bool may_peak() const override {
    return stage_ == Stage::raising && latest_row().axial_strain > raised_from_ + first_wave;
  }
  void finish() override;
  std::vector<Number> numbers(const analysis::WavePath& path) const override;

  /// Sides and, until they are moved, bottom and top press with these stresses, along x and y [Pa].
  void load_edges(Vec2 stress);
  void support_hole(double excavated);
  bool stand();
  bool end_widened(double closure);
  OpeningState state(WallMoment moment) const {
    return opening_state(*specimen_, begin_, group_->snapshot(lane_), latest_row(), moment);
  }
  double time_of_ramp() const;
  double block_time() const { return static_cast<double>(recipe_.test.history_interval) * result_.dt; }

  const Vec2 far_ = recipe_.test.far_field();
  OpeningBegin begin_{{boundary().jacket.hole.centre, boundary().jacket.hole.radius}, {}};
  Stage stage_ = Stage::excavating;
  double excavated_ = 0.0;  // share of the traction on the wall of the hole that is taken away
  double swept_ = 0.0;      // by the wall when the excavation begins [m^2]
  std::int64_t n_waited_ = 0;
  double raised_from_ = 0.0;  // strain
  std::optional<OpeningState> standing_, at_end_;
};

void OpeningTest::load_edges(Vec2 stress) {
  group_->press(lane_, stress.x);
  if (stage_ == Stage::raising) return;
  engine::PrescribedMotion wall;
  wall.balance_y = {true, stress.y * packing().width};
  group_->prescribe(lane_, 0, wall);
  // Opposite walls push against each other.
  wall.balance_y.force = -wall.balance_y.force;
  group_->prescribe(lane_, 1, wall);
}

/// What rock in the place of the hole would exert, and less and less of it down to the internal pressure.
void OpeningTest::support_hole(double excavated) {
  const double inside = recipe_.test.internal_pressure;
  excavated_ = excavated;
  group_->press_hole(lane_, (1.0 - excavated) * far_ + excavated * Vec2{inside, inside});
}

/// As fast as the platens would raise the stress of sound rock [s].
double OpeningTest::time_of_ramp() const {
  return std::max(far_.x, far_.y) / specimen_->matrix.modulus() * packing().height /
         (2.0 * recipe_.test.platen_speed);
}

void OpeningTest::on_placed() {
  stage_ = Stage::excavating;
  n_waited_ = 0;
  standing_.reset(), begin_.shot = {};
  // While the specimen settled nothing could break; what the far field alone breaks is meant to show.
  group_->forbid_breakage(lane_, specimen_->matrix.unbreakable);
  prepare(0);
}

bool OpeningTest::prepare(std::int64_t n_blocks) {
  const double share = std::min(1.0, static_cast<double>(n_blocks) * block_time() / time_of_ramp());
  load_edges(share * far_);
  group_->press_hole(lane_, share * far_);
  if (n_blocks == 0) return false;
  const HistoryRow& row = latest_row();
  if (std::max(row.axial_strain, row.lateral_strain) > most_strain)
    return end(Status::not_peaked,
               fmt::format("strain {:.1f} % before the far-field stress was reached",
                           100.0 * std::max(row.axial_strain, row.lateral_strain)),
               "the rock does not bear this stress without an opening; lower it");
  // Edges have their stress in every step: what may be off is the rock between them.
  return load_once_steady(share == 1.0, 1.0 + row.unbalanced, quiet);
}

void OpeningTest::prescribe_motion() {
  if (stage_ == Stage::raising) return close_platens(packing().height);
  swept_ = group_->hole_swept(lane_);
  begin_.shot = group_->snapshot(lane_);
  support_hole(0.0);
}

void OpeningTest::read_more(HistoryRow& row) {
  row.excavated = excavated_;
  row.closure = (swept_ - group_->hole_swept(lane_)) / (2.0 * pi * begin_.place.radius * begin_.place.radius);
  row.borne_stress = stage_ == Stage::raising ? row.axial_stress : excavated_ * far_.y;
}

/// The opening is excavated: it waits until the grains have come to rest.
bool OpeningTest::stand() {
  ++n_waited_;
  const bool resting = latest_row().unbalanced <= quiet;
  if (!resting && n_waited_ * recipe_.test.history_interval < most_waiting) return false;
  if (resting) standing_ = state(WallMoment::standing);
  if (specimen_->matrix.unbreakable)
    return end(Status::not_peaked, "nothing can break: the opening stands",
               "set matrix.unbreakable = false to get a collapse stress");
  stage_ = Stage::raising;
  raised_from_ = latest_row().axial_strain;
  prescribe_motion();
  return false;
}

/// Rock that a pressure above its own stress has burst moves outwards without an end.
bool OpeningTest::end_widened(double closure) {
  return end(Status::not_peaked,
             fmt::format("widening by {:.1f} % of the radius under the internal pressure", -100.0 * closure),
             "lower test.internal_pressure");
}

bool OpeningTest::after_row() {
  const HistoryRow& row = latest_row();
  if (row.closure < -collapsed && stage_ != Stage::raising && recipe_.test.internal_pressure > 0.0)
    return end_widened(row.closure);
  if (row.closure > collapsed)
    return end(Status::peaked,
               excavated_ < 1.0
                   ? fmt::format("closure of {:.1f} % of the radius when {:.0f} % of it was excavated",
                                 100.0 * row.closure, 100.0 * excavated_)
                   : fmt::format("closure of {:.1f} % of the radius under a vertical stress of {:.2f} MPa",
                                 100.0 * row.closure, row.axial_stress * 1e-6),
               "");
  switch (stage_) {
    case Stage::excavating:
      support_hole(std::min(1.0, excavated_ + block_time() / time_of_ramp()));
      if (excavated_ == 1.0) stage_ = Stage::standing;
      return false;
    case Stage::standing: return stand();
    case Stage::raising: load_edges({far_.x / far_.y * row.axial_stress, row.axial_stress}); return false;
  }
  return false;
}

void OpeningTest::finish() {
  // A test that ended before has no opening to look at.
  if (begin_.shot.grains.empty()) return;
  at_end_ = state(WallMoment::end);
  if (standing_) result_.wall = standing_->points;
  result_.wall.insert(result_.wall.end(), at_end_->points.begin(), at_end_->points.end());
}

std::vector<Number> OpeningTest::numbers(const analysis::WavePath& path) const {
  const OpeningReading read{far_.y, begin_.place.radius, stage_ == Stage::raising, standing_, at_end_, path};
  return opening_numbers(result_.history, result_.cracks, read, analysis::grain_diameter(*specimen_));
}

std::string loading_text_of(const Recipe& r) {
  const TestRecipe& t = r.test;
  const auto stress = [](double v) { return print_quantity(v, Dimension::pressure); };
  return fmt::format(
      "Bottom and top walls without friction brought up a vertical stress of {}, and a pressure on the sides "
      "a horizontal stress of {}. "
      "The opening of {} in the middle was then excavated by relaxation, {}. {}",
      stress(t.vertical_stress), stress(t.far_field().x),
      print_quantity(opening_diameter(r), Dimension::length),
      t.internal_pressure > 0.0 ? "with an internal pressure of " + stress(t.internal_pressure)
                                : std::string("without internal pressure"),
      r.matrix.unbreakable
          ? std::string("Nothing could break, and a test ended when its opening stood.")
          : fmt::format(
                "Where it stood, bottom and top then approached at {}, the ratio of the stresses being "
                "kept.",
                speed_text(t)));
}

HistoryColumns columns() {
  using Row = HistoryRow;
  return joined(
      {clock_columns(),
       {{"axial_strain", "1", "approach of bottom and top since the excavation began / initial height",
         &Row::axial_strain},
        {"lateral_strain", "1", "area swept by the sides since the excavation began / initial area",
         &Row::lateral_strain},
        {"excavated", "1", "share of the rock's traction on the wall of the hole that is taken away",
         &Row::excavated},
        {"closure", "1", "mean displacement of the wall inwards since the excavation began / radius",
         &Row::closure},
        {"borne_stress", "Pa", "vertical stress times the share excavated", &Row::borne_stress}},
       platen_stress_columns(),
       {{"lateral_stress", "Pa", "pressure on the sides", &Row::lateral_stress}},
       balance_columns()});
}

TestDescription description() {
  TestDescription d;
  d.name = "opening", d.stress = "stress that the opening bears", d.body = "wall";
  d.columns = columns();
  d.hashed = hashed_fields({"axial_strain", "lateral_strain", "excavated", "closure", "borne_stress",
                            "axial_stress", "stress_top", "stress_bottom", "lateral_stress"});
  d.curve.stress = "vertical stress borne", d.curve.value = &HistoryRow::borne_stress;
  d.curve.strength = "collapse_stress", d.curve.strength_label = "collapse stress";
  d.table = {
      {"collapse", "MPa", "collapse_stress", 1e-6, 2},   {"collapse", "factor", "collapse_factor", 1.0, 2},
      {"closure", "% of R", "closure", 100.0, 3},        {"hoop max", "MPa", "hoop_max", 1e-6, 1},
      {"breakout", "depth/R", "breakout_depth", 1.0, 2}, {"breakout", "deg", "breakout_direction", 1.0, 0}};
  d.cut = [](const Recipe& r) { return SpecimenCut{.hole = opening_diameter(r)}; };
  d.may_approach = false;  // what is read begins with the first row
  d.closed_at = collapsed;
  d.kept_stress = {"vertical_stress", &TestRecipe::vertical_stress, true};
  d.loading_text = loading_text_of;
  d.load_on_box = d.load_on_bedding = "";
  return d;
}

}  // namespace

const TestRoom& opening_room() {
  static const TestRoom room = {
      description(), [](const Recipe& r) { return "opening" + print_number(opening_diameter(r)); },
      [](const Packing& packing, const Recipe& r) { return block_with_hole(packing, opening_diameter(r)); },
      begin_test<OpeningTest>};
  return room;
}

}  // namespace phy::lab
