#include "lab/procedure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/analyse.hpp"
#include "analysis/elastic.hpp"
#include "analysis/failure_plane.hpp"
#include "analysis/specimen_checks.hpp"
#include "base/check.hpp"
#include "base/nan.hpp"
#include "events/b_value.hpp"
#include "lab/instability.hpp"
#include "records/quality.hpp"

namespace phy::lab {
namespace {

constexpr double settled = 1e-3;               // mean unbalanced force / mean contact force
constexpr std::int64_t settle_cycles = 40000;  // give up after
constexpr std::int64_t steady_blocks = 10;     // in a row, before a prepared stress counts as reached
constexpr double least_cracks = 3.0;           // as for sigma_ci: fewer are chance
constexpr double almost = 0.99;                // of the peak: the stress has not begun to fall
constexpr double sliding = 0.2;                // share of the work that friction takes

/// The begin of an advice: more damping than usual slows a specimen down and calms nothing.
std::string more_damping(const Recipe& recipe) {
  return recipe.engine.damping < EngineRecipe{}.damping ? "raise engine.damping, or " : "";
}

}  // namespace

Procedure::Procedure(TestSetup setup, engine::LaneGroup& group, int lane)
    : specimen_(std::move(setup.specimen)),
      recipe_(setup.recipe),
      group_(&group),
      lane_(lane),
      result_(blank_result(*specimen_, recipe_.test.kind)),
      boundary_(std::move(setup.boundary)),
      snapshots_(recipe_.test.n_snapshots),
      frames_(recipe_.test.n_frames) {
  PHY_CHECK(boundary_->boundary.axial.present(), "every test has an axial pair of bodies");
}

void Procedure::begin() {
  engine::LaneSetup setup;
  setup.damping = recipe_.engine.damping;
  setup.step_safety = recipe_.engine.step_safety;
  // A test may have a friction of its own: of jaws instead of platens.
  setup.body_friction = recipe_.test.*test().friction;
  setup.boundary = {boundary_, &boundary_->boundary};
  group_->load(lane_, specimen_, setup);
  result_.dt = group_->time_step(lane_);
  result_.n_contacts = group_->n_contacts(lane_);
  row_ = {};
  events_.reset();
  blocks_ = n_at_target_ = n_steady_ = 0;
  phase_ = Phase::settle;
  if (packing().stress_free) {
    place_boundary();
  } else {
    // While a locked-in stress settles the specimen has no sides to press on, and bonds that broke then would
    // be no result.
    group_->forbid_breakage(lane_, true);
  }
}

/// The specimen has settled: the boundary comes in.
void Procedure::place_boundary() {
  group_->place_boundary(lane_);
  row_ = {};
  zero_axial_ = zero_lateral_ = 0.0;
  blocks_ = 0;
  phase_ = Phase::prepare;
  on_placed();
}

void Procedure::start_loading() {
  phase_ = Phase::load;
  loads_from_ = static_cast<std::int64_t>(row_.step);
  approaching_ = recipe_.test.approach_strain > 0.0;
  group_->forbid_breakage(lane_, specimen_->matrix.unbreakable);
  prescribe_motion();
  if (recipe_.test.events) begin_events();
  // Of the specimen as it was made: strains and stresses refer to it.
  result_.history.width = packing().width;
  result_.history.height = packing().height;
}

Procedure::Speeds Procedure::speeds() const {
  const TestRecipe& test = recipe_.test;
  if (approaching_) return {0.0, test.approach_speed};
  const bool has_approached = !result_.history.rows.empty() && test.approach_strain > 0.0;
  return {has_approached ? test.approach_speed : 0.0, test.platen_speed};
}

double Procedure::ramp_over(double length, const Speeds& speed) const {
  return recipe_.test.ramp_strain * length / (speed.before + speed.now);
}

void Procedure::close_platens(double length) {
  const Speeds speed = speeds();
  const double ramp = ramp_over(length, speed);
  for (const auto& [platen, way] : {std::pair(0, 1.0), std::pair(1, -1.0)})
    group_->prescribe(
        lane_, platen,
        {.velocity = {0.0, way * speed.now}, .ramp = ramp, .before = {0.0, way * speed.before}});
}

/// From here on the bodies are as slow as the test asks.
void Procedure::end_approach(double strain) {
  if (!approaching_ || strain < recipe_.test.approach_strain) return;
  approaching_ = false;
  prescribe_motion();
}

bool Procedure::end(Status status, std::string reason, std::string advice) {
  result_.outcome = {status, std::move(reason), std::move(advice)};
  phase_ = Phase::over;
  return true;
}

/// What broke in the block that the watchdog has rejected is as little worth as its row.
bool Procedure::end_unstable(const engine::LaneHealth& health) {
  // The watchdog looks once in a block: what broke within it may be the blow-up itself.
  const double last_good = row_.step - static_cast<double>(recipe_.test.history_interval);
  std::erase_if(group_->cracks(lane_),
                [&](const engine::Breakage& b) { return static_cast<double>(b.crack.step) > last_good; });
  return end(Status::unstable, health.reason,
             advice_on_instability(*specimen_, recipe_, boundary(), row_, health.outran));
}

bool Procedure::load_once_steady(bool at_target, double stress_over_target, double tolerance) {
  if (!at_target) return false;
  n_steady_ = std::fabs(stress_over_target - 1.0) < tolerance ? n_steady_ + 1 : 0;
  // In a row: a swing that passes the target is not steady.
  if (n_steady_ == steady_blocks) {
    zero_strains();
    start_loading();
    return false;
  }
  const std::int64_t cycles = ++n_at_target_ * recipe_.test.history_interval;
  if (cycles < settle_cycles) return false;
  return end(
      Status::not_settled,
      fmt::format(
          "the stress before the test does not settle: {:.1f} % off its target or balance after {} cycles",
          100.0 * (stress_over_target - 1.0), cycles),
      fmt::format("{}lower test.platen_speed or test.{}", more_damping(recipe_), test().kept_stress.key));
}

/// Of a row that the watchdog has rejected only step and time are of now, as in the group.
void Procedure::read_row() {
  const HistoryRow& now = group_->row(lane_);
  if (group_->health(lane_).ok) {
    row_ = now;
    if (phase_ != Phase::settle) write_load(), read_more(row_);
  } else {
    row_.step = now.step, row_.time = now.time;
  }
}

/// Strain and stress, from what the bodies and the jacket have done.
void Procedure::write_load() {
  const auto body = [&](int number) -> const engine::BodyState& { return group_->body(lane_, number); };
  const auto strain = [&](const engine::LoadAxis& a, const LoadScale& over) {
    return a.travel(body(a.lo).displacement, body(a.hi).displacement) / over.length;
  };
  const engine::LoadAxis &along = boundary_->boundary.axial, &across = boundary_->boundary.lateral;
  row_.axial_strain = strain(along, boundary_->axial) - zero_axial_;
  row_.stress_bottom = dot(body(along.lo).force, along.direction) / boundary_->axial.area;
  row_.stress_top = -dot(body(along.hi).force, along.direction) / boundary_->axial.area;
  row_.axial_stress = 0.5 * (row_.stress_bottom + row_.stress_top);
  if (across.present()) {
    // Opposite bodies push against each other: half of the difference is the mean.
    const Vec2 force = body(across.lo).force - body(across.hi).force;
    row_.lateral_strain = strain(across, boundary_->lateral) - zero_lateral_;
    row_.lateral_stress = 0.5 * dot(force, across.direction) / boundary_->lateral.area;
  }
  if (boundary_->boundary.jacket.sides) {
    const engine::JacketState jacket = group_->jacket(lane_);
    // A jacket has no place: the area that it has swept, over that of the specimen, is its strain.
    row_.lateral_strain = jacket.swept / (packing().width * packing().height) - zero_lateral_;
    row_.lateral_stress = jacket.pressure;
  }
  row_.deviatoric_stress = row_.axial_stress - row_.lateral_stress;
  row_.volumetric_strain = row_.axial_strain + row_.lateral_strain;
}

void Procedure::zero_strains() {
  group_->zero_strains(lane_);
  // Strains count from the end of the preparation, as a laboratory zeroes its gauges.
  zero_axial_ += row_.axial_strain, zero_lateral_ += row_.lateral_strain;
  row_.axial_strain = row_.lateral_strain = row_.volumetric_strain = 0.0;
  row_.axial_strain_gauge = row_.lateral_strain_gauge = 0.0;
}

bool Procedure::after_block() {
  ++blocks_;
  read_row();
  const HistoryRow& row = row_;
  if (const engine::LaneHealth& health = group_->health(lane_); !health.ok)
    return !(phase_ == Phase::prepare && begin_without()) && end_unstable(health);
  if (phase_ == Phase::settle) {
    const std::int64_t cycles = blocks_ * recipe_.test.history_interval;
    // As quiet as the tests themselves are while they load.
    if (row.unbalanced <= settled) {
      place_boundary();
      return false;
    }
    if (cycles < settle_cycles) return false;
    return end(
        Status::not_settled,
        fmt::format("unbalanced force {:.1e} of the contact force after {} cycles", row.unbalanced, cycles),
        more_damping(recipe_) + (recipe_.packing.file.empty()
                                     ? "lower packing.isotropic_stress"
                                     : "choose packing.initial_stress = \"stress_free\""));
  }
  if (phase_ == Phase::prepare) return prepare(blocks_);
  result_.history.rows.push_back(row);
  const Reading now = reading(row);
  // The first of equal rows: a plateau peaks where it begins.
  if (now.stress > peak_.stress) peak_ = now;
  end_approach(now.strain);
  keep_pictures();
  if (events_) keep_events();
  return after_row() || check_stop();
}

Procedure::Reading Procedure::reading(const HistoryRow& row) const {
  const TestCurve& curve = test().curve;
  const double way = curve.strain_of(row);
  return {curve.stress_of(row), test().loads_by_strain() ? way : way / packing().width};
}

std::string Procedure::extent(double strain, int digits) const {
  return fmt::format(fmt::runtime(test().extent), fmt::format("{:.{}f}", 100.0 * strain, digits));
}

bool Procedure::check_stop() {
  const HistoryRow& row = result_.history.rows.back();
  const Reading now = reading(row);
  const char* const stress = test().stress;
  const bool to_the_end = test().runs_to_end;
  // Nothing fails before it has carried something and something has broken: what falls earlier is the first
  // stress wave.
  const bool may_stop = may_peak() && !to_the_end && peak_.stress > 0.0 &&
                        now.strain > boundary_->first_wave && row.n_cracks >= least_cracks;
  if (may_stop && now.stress < recipe_.test.stop_at * peak_.stress)
    return end(Status::peaked,
               fmt::format("peak {} {:.2f} MPa at {}, stopped at {:.0f} % of it", stress, peak_.stress * 1e-6,
                           extent(peak_.strain, 4), recipe_.test.stop_at * 100.0),
               "");
  // Ductile rock may never fall to stop_at: enough strain without a new peak ends its test.
  if (may_stop && recipe_.test.post_peak > 0.0 && now.strain > (1.0 + recipe_.test.post_peak) * peak_.strain)
    return end(Status::peaked,
               fmt::format("peak {} {:.2f} MPa at {}, at {:.0f} % of it when stopped at {:.4f} %", stress,
                           peak_.stress * 1e-6, extent(peak_.strain, 4), 100.0 * now.stress / peak_.stress,
                           now.strain * 100.0),
               "");
  if (now.strain >= max_strain() && to_the_end && peak_.strain < now.strain)
    return end(Status::peaked,
               fmt::format("peak {} {:.2f} MPa at {}, {:.2f} MPa at the end", stress, peak_.stress * 1e-6,
                           extent(peak_.strain, 4), now.stress * 1e-6),
               "");
  if (now.strain >= max_strain() && to_the_end)
    return end(Status::not_peaked,
               fmt::format("the {} still rises at the end, {}: {:.2f} MPa", stress, extent(now.strain, 3),
                           now.stress * 1e-6),
               "raise test.max_strain");
  return now.strain >= max_strain() && end_without_peak(now);
}

/// The largest strain is reached: why there is no peak, and what to change.
bool Procedure::end_without_peak(const Reading& now) {
  const char* const stress = test().stress;
  const double n_broken = result_.history.rows.back().n_cracks;
  const std::string at = extent(now.strain, 3);
  if (specimen_->matrix.unbreakable)
    return end(Status::not_peaked, "nothing can break, up to " + at,
               "set matrix.unbreakable = false to get a strength");
  // A stress that falls without cracks is no failure of bonds.
  if (now.stress < recipe_.test.stop_at * peak_.stress && n_broken < least_cracks)
    return end_without_cracks(
        fmt::format("the {} fell from {:.2f} to {:.2f} MPa up to {}, but only {} bonds "
                    "broke",
                    stress, peak_.stress * 1e-6, now.stress * 1e-6, at, n_broken));
  // Only a stress that has begun to fall would ever reach another stop_at.
  const char* const or_stop = now.stress < almost * peak_.stress ? ", or test.stop_at" : "";
  return end(Status::not_peaked,
             fmt::format("no drop to {:.0f} % of the largest {} ({:.2f} MPa) up to {}",
                         recipe_.test.stop_at * 100.0, stress, peak_.stress * 1e-6, at),
             std::string("raise test.max_strain") + or_stop);
}

/// The stress fell, and bonds did not break: grains slide, or what carried the load has come loose.
bool Procedure::end_without_cracks(const std::string& what) {
  const HistoryRow& last = result_.history.rows.back();
  // Friction between loose grains also makes a largest stress.
  if (last.slip > sliding * last.boundary_work)
    return end(Status::not_peaked,
               fmt::format("{}: grains slide past each other, which took {:.0f} % of the work; the largest "
                           "stress is one of friction, not of bonds",
                           what, 100.0 * last.slip / last.boundary_work),
               "");
  return end(Status::not_peaked, what + ": the specimen has lost contact with a " + result_.kind->body,
             "take smaller grains: more bonds then carry the load");
}

Snapshot Procedure::snapshot() const {
  Snapshot shot = group_->snapshot(lane_);
  // The group knows no strain: that belongs to the test.
  shot.axial_strain = row_.axial_strain, shot.axial_stress = row_.axial_stress;
  return shot;
}

Frame Procedure::frame() const {
  Frame f{row_.step, row_.axial_strain, row_.axial_stress, {}};
  for (const GrainState& g : group_->grains(lane_))
    // Enough for a picture, in half the room.
    f.u.push_back({static_cast<float>(g.ux), static_cast<float>(g.uy)});
  return f;
}

void Procedure::keep_pictures() {
  const auto row = static_cast<std::int64_t>(result_.history.rows.size()) - 1;
  if (snapshots_.due(row)) snapshots_.keep(snapshot());
  if (frames_.due(row)) frames_.keep(frame());
}

double Procedure::thickness_of_events() const {
  const double stated = recipe_.test.event_thickness;
  return stated > 0.0 ? stated : analysis::grain_diameter(*specimen_);
}

/// What broke before the test loads is no event of it.
void Procedure::begin_events() {
  const events::Window window = events::window_of(*specimen_);
  events_.emplace(window, thickness_of_events(), events::forces_of(packing(), group_->snapshot(lane_)));
  // Of a confinement, for example.
  cracks_seen_ = group_->cracks(lane_).size();
}

void Procedure::keep_events() {
  const std::vector<engine::Breakage>& all = group_->cracks(lane_);
  std::vector<CrackEvent> cracks;
  for (; cracks_seen_ < all.size(); ++cracks_seen_) cracks.push_back(crack_of(all[cracks_seen_]));
  events_->after_block(row_.time, cracks, events::forces_of(packing(), group_->snapshot(lane_)));
}

/// The engine knows how far the bodies had come when it broke; strain is a matter of the test.
CrackEvent Procedure::crack_of(const engine::Breakage& broken) const {
  CrackEvent crack = broken.crack;
  crack.strain = broken.travel / boundary_->axial.length - zero_axial_;
  return crack;
}

void Procedure::interrupt() {
  // Called for all tests of a group, also those that are done.
  if (phase_ != Phase::over)
    end(Status::interrupted, fmt::format("stopped by the user at {}", extent(reading(row_).strain, 4)),
        "run the same recipe again");
}

void Procedure::move_to(engine::LaneGroup& group, int lane) {
  group_->move_lane(lane_, group, lane);
  group_ = &group;
  lane_ = lane;
}

SpecimenNow Procedure::now() const {
  SpecimenNow now{frame(), {}};
  for (const engine::Breakage& broken : group_->cracks(lane_)) now.cracks.push_back(broken.crack);
  return now;
}

Procedure::Reading Procedure::latest() const {
  return result_.history.rows.empty() ? Reading{} : reading(result_.history.rows.back());
}

double Procedure::progress() const {
  return phase_ == Phase::load ? std::min(1.0, reading(row_).strain / max_strain()) : 0.0;
}

double Procedure::value(const std::string& name) const {
  const Number* n = analysis::find(result_.numbers, name);
  return n != nullptr ? n->value : nan;
}

void Procedure::accept_strength() {
  Outcome& outcome = result_.outcome;
  const std::vector<HistoryRow>& rows = result_.history.rows;
  if (!test().may_harden || outcome.status != Status::not_peaked || rows.empty() ||
      rows.back().n_cracks < least_cracks)
    return;
  const double rule = value("strength_rule"), stress = value(test().curve.strength);
  const double highest = value("largest_stress"), strain = value("peak_strain");
  const std::string at = fmt::format("{:.2f} MPa at {}", stress * 1e-6, extent(strain, 4));
  const std::string end = extent(reading(rows.back()).strain, 3);
  const std::string later = highest > stress ? fmt::format(" and rises to {:.2f} MPa", highest * 1e-6) : "";
  if (rule == static_cast<double>(analysis::StrengthRule::peak)) {
    // A later quality mark says whether the fall was as deep as the recipe asks.
    note_fall(strain, stress);
    outcome = {
        Status::peaked,
        fmt::format("peak {} {}, behind which it falls by at least 10 %{}; no drop to {:.0f} % up to {}",
                    test().stress, at, later, 100.0 * recipe_.test.stop_at, end),
        ""};
  }
  if (rule == static_cast<double>(analysis::StrengthRule::knee))
    outcome = {Status::knee,
               fmt::format("the {} bends at {}{}; no peak up to {}", test().stress, at, later, end), ""};
}

void Procedure::note_fall(double strain, double stress) {
  double lowest = stress;
  for (const HistoryRow& row : result_.history.rows)
    if (reading(row).strain > strain) lowest = std::min(lowest, reading(row).stress);
  result_.numbers.push_back({"fall_seen", (1.0 - lowest / stress) / (1.0 - recipe_.test.stop_at), "1",
                             "fall of stress behind the first peak / fall at which the recipe ends the test",
                             ""});
}

/// How much of the way to the peak was as slow as the test asks, and what was read while the bodies slowed
/// down.
void Procedure::judge_approach() {
  const TestRecipe& test = recipe_.test;
  if (test.approach_strain == 0.0 || test.approach_speed == test.platen_speed) return;
  // The ramp between both speeds belongs to neither.
  const double slow_from = test.approach_strain + test.ramp_strain;
  Number share{"slow_share", std::nan(""), "1",
               "part of the way to the largest stress, in strain, behind the fast approach", ""};
  if (peak_.strain > 0.0) share.value = std::max(0.0, 1.0 - slow_from / peak_.strain);
  result_.numbers.push_back(std::move(share));
  const auto branch = analysis::loading_branch(result_.history, stop_rule());
  analysis::note_slowing(result_.numbers, branch, test.approach_strain, slow_from);
}

void Procedure::read_numbers() {
  // Of the specimen as a body: waves run through it with its pores.
  const double density = specimen_->matrix.density * (1.0 - packing().report.porosity);
  result_.numbers = analysis::with_reasons(numbers({density, packing().height}));
  analysis::add(result_.numbers,
                analysis::failure_numbers(result_.cracks, analysis::grain_diameter(*specimen_),
                                          !specimen_->bedding.empty()));
  analysis::add(result_.numbers, analysis::specimen_checks(*specimen_));
  result_.numbers.push_back({"damping", recipe_.engine.damping, "1", "local damping coefficient", ""});
  // What the confinement broke is damage that the strength contains.
  if (const KeptStress& kept = test().kept_stress; kept.value != nullptr && recipe_.test.*kept.value > 0.0)
    result_.numbers.push_back(analysis::broken_at_start(*specimen_, result_.cracks, loads_from_));
  if (events_) analysis::add(result_.numbers, events::event_numbers(result_.events, thickness_of_events()));
  judge_approach();
  accept_strength();
  const std::vector<QualityMark> marks = quality_marks(result_.numbers);
  note_marks(result_.numbers);
  Outcome& outcome = result_.outcome;
  // The worst mark comes first.
  if (marks.empty() || !marks.front().ends_test()) return;
  // These have a worse name already.
  if (outcome.status == Status::unstable || outcome.status == Status::interrupted) return;
  if (has_strength(outcome.status)) outcome.status = Status::untrusted;
  outcome.reason = marks.front().text() + "; it ended with " + outcome.reason;
  outcome.advice = marks.front().limit->advice;
}

TestResult Procedure::take_result() {
  for (const engine::Breakage& broken : group_->cracks(lane_)) result_.cracks.push_back(crack_of(broken));
  // Cracks of one contact in one step stay in the order of its parts.
  std::stable_sort(result_.cracks.begin(), result_.cracks.end(),
                   [](const CrackEvent& p, const CrackEvent& q) {
                     return p.step != q.step ? p.step < q.step : p.a != q.a ? p.a < q.a : p.b < q.b;
                   });
  if (events_) result_.events = events_->take();
  finish();
  result_.snapshots = snapshots_.take(snapshot());
  result_.frames = frames_.take(frame());
  result_.n_steps = static_cast<std::int64_t>(row_.step);
  read_numbers();
  result_.hash = hash_of(result_);
  return std::move(result_);
}

TestResult blank_result(const Specimen& specimen, TestKind kind) {
  TestResult r;
  r.name = specimen.name;
  r.kind = r.history.kind = kind;
  r.n_grains = static_cast<std::int64_t>(specimen.packing->discs.size());
  // Foliation of the matrix counts as layers, too.
  r.intact = !layered(specimen);
  if (!r.intact) r.theta = inclination(specimen);
  return r;
}

}  // namespace phy::lab
