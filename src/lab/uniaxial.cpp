#include "lab/uniaxial.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/analyse.hpp"

namespace phy {
namespace {

constexpr double settled = 1e-3;               // mean unbalanced force / mean contact force
constexpr std::int64_t settle_cycles = 40000;  // give up after
constexpr std::int64_t jump_cycles = 3000;     // damped cycles after the affine strain
constexpr double least_cracks = 3.0;           // as for sigma_ci: fewer are chance
constexpr double first_stop_strain =
    2e-4;  // the stop rule sleeps while the first wave runs through the specimen

}  // namespace

UniaxialTest::UniaxialTest(std::shared_ptr<const Specimen> specimen, const Recipe& recipe, LaneGroup& group,
                           int lane)
    : specimen_(std::move(specimen)),
      recipe_(recipe),
      group_(group),
      lane_(lane),
      may_jump_(recipe.test.jump_strain > 0.0),
      snapshots_(recipe.test.n_snapshots),
      frames_(recipe.test.n_frames) {
  result_.name = specimen_->name;
  result_.intact = specimen_->bedding.empty();
  if (!result_.intact) result_.theta = specimen_->bedding.front().theta;
  begin();
}

void UniaxialTest::begin() {
  LaneSetup setup;
  setup.damping = recipe_.engine.damping;
  setup.step_safety = recipe_.engine.step_safety;
  setup.platen_speed = recipe_.test.platen_speed;
  setup.ramp_strain = recipe_.test.ramp_strain;
  setup.platen_friction = recipe_.test.platen_friction;
  group_.load(lane_, specimen_, setup);
  result_.dt = group_.time_step(lane_);
  result_.n_contacts = group_.n_contacts(lane_);
  blocks_ = 0;
  if (specimen_->packing->stress_free) {
    start_loading();
  } else {
    phase_ = Phase::settle;
    group_.hold_bonds(lane_, true);
  }
}

void UniaxialTest::start_loading() {
  group_.place_platens(lane_);
  blocks_ = 0;
  if (may_jump_) {
    phase_ = Phase::jump;
    group_.hold_bonds(lane_, true);
    group_.jump(lane_, recipe_.test.jump_strain);
    return;
  }
  phase_ = Phase::load;
  group_.hold_bonds(lane_, specimen_->matrix.unbreakable);
  group_.drive_platens(lane_, true);
  result_.history.width = specimen_->packing->width;
  result_.history.height = specimen_->packing->height;
}

bool UniaxialTest::end(Status status, std::string reason, std::string advice) {
  result_.outcome = {status, std::move(reason), std::move(advice)};
  phase_ = Phase::over;
  return true;
}

bool UniaxialTest::after_block() {
  ++blocks_;
  const HistoryRow& row = group_.row(lane_);
  if (const LaneHealth& health = group_.health(lane_); !health.ok)
    return end(Status::unstable, health.reason,
               "lower engine.step_safety, or look for extreme stiffness ratios");
  const std::int64_t cycles = blocks_ * recipe_.test.history_interval;
  if (phase_ == Phase::settle) {
    if (row.unbalanced > settled && cycles < settle_cycles) return false;
    if (row.unbalanced > settled)
      return end(
          Status::not_settled,
          fmt::format("unbalanced force {:.1e} of the contact force after {} cycles", row.unbalanced, cycles),
          "lower packing.isotropic_stress, or raise engine.damping");
    start_loading();
    return false;
  }
  if (phase_ == Phase::jump) {
    if (cycles < jump_cycles) return false;
    may_jump_ = false;
    if (!specimen_->matrix.unbreakable && group_.at_strength(lane_)) {
      begin();
      return false;
    }
    jumped_ = true;
    phase_ = Phase::load;
    group_.hold_bonds(lane_, specimen_->matrix.unbreakable);
    group_.drive_platens(lane_, true);
    result_.history.width = specimen_->packing->width;
    result_.history.height = specimen_->packing->height;
    return false;
  }
  result_.history.rows.push_back(row);
  if (row.axial_stress > peak_) peak_ = row.axial_stress, peak_strain_ = row.axial_strain;
  keep_pictures();
  return check_stop();
}

bool UniaxialTest::check_stop() {
  const HistoryRow& row = result_.history.rows.back();
  // Nothing fails before something has broken: what falls earlier is the first stress wave.
  const bool may_stop = row.axial_strain > first_stop_strain && row.n_cracks >= least_cracks;
  if (may_stop && row.axial_stress < recipe_.test.stop_at * peak_)
    return end(Status::peaked,
               fmt::format("peak {:.2f} MPa at strain {:.4f} %, stopped at {:.0f} % of it", peak_ * 1e-6,
                           peak_strain_ * 100.0, recipe_.test.stop_at * 100.0),
               "");
  if (may_stop && recipe_.test.post_peak > 0.0 &&
      row.axial_strain > (1.0 + recipe_.test.post_peak) * peak_strain_)
    return end(Status::peaked,
               fmt::format("peak {:.2f} MPa at strain {:.4f} %, at {:.0f} % of it when stopped at {:.4f} %",
                           peak_ * 1e-6, peak_strain_ * 100.0, 100.0 * row.axial_stress / peak_,
                           row.axial_strain * 100.0),
               "");
  if (row.axial_strain >= recipe_.test.max_strain)
    return end(Status::not_peaked,
               fmt::format("no drop to {:.0f} % of the largest stress ({:.2f} MPa) up to strain {:.3f} %",
                           recipe_.test.stop_at * 100.0, peak_ * 1e-6, row.axial_strain * 100.0),
               "raise test.max_strain, or test.stop_at");
  return false;
}

Frame UniaxialTest::frame() const {
  const HistoryRow& row = group_.row(lane_);
  Frame f{row.step, row.axial_strain, row.axial_stress, {}};
  for (const GrainState& g : group_.grains(lane_))
    f.u.push_back({static_cast<float>(g.ux), static_cast<float>(g.uy)});
  return f;
}

void UniaxialTest::keep_pictures() {
  const auto row = static_cast<std::int64_t>(result_.history.rows.size()) - 1;
  if (snapshots_.due(row)) snapshots_.keep(group_.snapshot(lane_));
  if (frames_.due(row)) frames_.keep(frame());
}

void UniaxialTest::interrupt() {
  if (phase_ != Phase::over)
    end(Status::interrupted,
        fmt::format("stopped by the user at strain {:.4f} %", group_.row(lane_).axial_strain * 100.0),
        "run the same recipe again");
}

double UniaxialTest::progress() const {
  return phase_ == Phase::load ? std::min(1.0, group_.row(lane_).axial_strain / recipe_.test.max_strain)
                               : 0.0;
}

TestResult UniaxialTest::take_result() {
  result_.cracks = group_.cracks(lane_);
  std::sort(result_.cracks.begin(), result_.cracks.end(), [](const CrackEvent& p, const CrackEvent& q) {
    return p.step != q.step ? p.step < q.step : p.a != q.a ? p.a < q.a : p.b < q.b;
  });
  result_.snapshots = snapshots_.take(group_.snapshot(lane_));
  result_.frames = frames_.take(frame());
  result_.n_steps = static_cast<std::int64_t>(group_.row(lane_).step);
  AnalysisOptions options;
  options.jump_strain = jumped_ ? recipe_.test.jump_strain : 0.0;
  result_.numbers = analyse(result_.history, result_.cracks, options);
  result_.hash = hash_of(result_);
  return std::move(result_);
}

}  // namespace phy
