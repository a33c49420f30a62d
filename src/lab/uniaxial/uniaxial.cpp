#include "lab/uniaxial/uniaxial.hpp"

#include "analysis/analyse.hpp"
#include "lab/boundaries.hpp"

namespace phy::lab {
namespace {

constexpr std::int64_t pre_strain_cycles = 3000;  // damped cycles after the affine strain

class UniaxialTest final : public Procedure {
 public:
  using Procedure::Procedure;

 private:
  void on_placed() override;
  bool prepare(std::int64_t n_blocks) override;
  bool begin_without() override;
  void prescribe_motion() override;
  std::vector<Number> numbers(const analysis::WavePath& path) const override;

  bool may_pre_strain_ = recipe_.test.pre_strain > 0.0;
  bool pre_strained_ = false;  // the pre-strain was made and kept
};

void UniaxialTest::on_placed() {
  if (!may_pre_strain_) return start_loading();
  group_->forbid_breakage(lane_, true);
  // An affine strain saves the slow first part of the loading; what it breaks would be its own doing.
  group_->pre_strain(lane_, recipe_.test.pre_strain);
}

bool UniaxialTest::prepare(std::int64_t n_blocks) {
  // Damped, until the jump has become a state of rest.
  if (n_blocks * recipe_.test.history_interval < pre_strain_cycles) return false;
  // A bond at its strength would have broken on the way: the jump went too far.
  if (!specimen_->matrix.unbreakable && group_->at_strength(lane_)) return !begin_without();
  may_pre_strain_ = false, pre_strained_ = true;
  start_loading();
  return false;
}

/// From rest. Where layers are far softer than grains an affine strain throws the grains about.
bool UniaxialTest::begin_without() {
  may_pre_strain_ = false;
  begin();
  return true;
}

void UniaxialTest::prescribe_motion() { close_platens(packing().height); }

std::vector<Number> UniaxialTest::numbers(const analysis::WavePath& path) const {
  const History& history = result_.history;
  return analysis::axial_numbers(history, analysis::loading_branch(history, stop_rule()), result_.cracks,
                                 {path, pre_strained_ ? recipe_.test.pre_strain : 0.0});
}

TestDescription description() {
  TestDescription d;
  d.name = "uniaxial";
  d.columns = joined(
      {clock_columns(),
       {{"axial_strain", "1", "shortening between the platens / initial height", &HistoryRow::axial_strain}},
       gauge_columns(),
       platen_stress_columns(),
       balance_columns()});
  d.hashed = hashed_fields({"axial_strain", "axial_strain_gauge", "lateral_strain_gauge", "axial_stress",
                            "stress_top", "stress_bottom"});
  d.table = {{"E tan50", "GPa", "E_tangent", 1e-9, 2},
             {"E sec50", "GPa", "E_secant", 1e-9, 2},
             {"nu", "", "nu", 1.0, 3},
             {"UCS", "MPa", "ucs", 1e-6, 2},
             {"sigma_ci", "MPa", "sigma_ci", 1e-6, 2},
             {"ci strain", "MPa", "sigma_ci_strain", 1e-6, 2},
             {"sigma_cd", "MPa", "sigma_cd", 1e-6, 2}};
  d.may_pre_strain = true;
  d.may_harden = true;
  d.loading_text = [](const Recipe& r) { return platens_text(r.test) + " on specimens with free sides."; };
  return d;
}

}  // namespace

const TestRoom& uniaxial_room() {
  static const TestRoom room = {description(), [](const Recipe&) { return std::string("uniaxial"); },
                                [](const Packing& packing, const Recipe&) { return platens(packing); },
                                begin_test<UniaxialTest>};
  return room;
}

}  // namespace phy::lab
