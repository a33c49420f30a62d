#include "lab/semi_circular_bend/semi_circular_bend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "analysis/analyse.hpp"
#include "base/nan.hpp"
#include "base/units.hpp"
#include "lab/boundaries.hpp"
#include "lab/semi_circular_bend/direct_solution.hpp"

namespace phy::lab {

BendSpecimen bend_specimen(const Recipe& recipe) {
  const TestRecipe& t = recipe.test;
  // The largest half disc in the box: as wide as the box, or twice its height.
  const double most = std::min(recipe.specimen.width, 2.0 * recipe.specimen.height);
  const double R = 0.5 * (t.disc_diameter > 0.0 ? t.disc_diameter : most);
  return {R, t.notch_ratio * R, t.span_ratio * 2.0 * R};
}

namespace {

constexpr double loaded_share = 1e-5;  // travel over diameter from which the energy balance means something

/// A roller whose line is at x pushes along `up` = (0, +-1) on what it meets first.
void add_roller(engine::BoundaryBody& body, const Packing& half, double x, double up, double bearing) {
  const int n = static_cast<int>(std::ceil(2.0 * bearing / ray_spacing(half)));
  const double outside = up > 0.0 ? -half.height : 2.0 * half.height;
  std::set<std::uint32_t> met;
  for (int k = 0; k <= n; ++k) {
    // Over one largest radius to either side: a line may lie between two grains.
    const double along = bearing * (2.0 * static_cast<double>(k) / n - 1.0);
    const std::int64_t g = first_grain(half, {x + along, outside}, {0.0, up});
    if (g >= 0) met.insert(static_cast<std::uint32_t>(g));
  }
  for (const std::uint32_t g : met) body.touches.push_back({g, {0.0, up}, 0.0});
}

}  // namespace

BendSpecimen as_sawn(const Packing& half, BendSpecimen specimen) {
  const Vec2 flat = specimen.flat_face(half.width);
  const std::int64_t first = first_grain(half, {flat.x, 0.0}, {0.0, 1.0});
  // The blunt end of the notch is a grain: its centre is where lattices have the tip of an equal crack.
  if (first >= 0) specimen.notch = half.discs[static_cast<std::size_t>(first)].y - flat.y;
  return specimen;
}

TestBoundary bend_rollers(const Packing& half, const BendSpecimen& specimen) {
  TestBoundary press;
  const Vec2 flat = specimen.flat_face(half.width);
  // The bottom of the box is one largest radius below the flat face (cut.hpp).
  const double centre = flat.x, bearing = flat.y;  // to either side of a line
  engine::BoundaryBody supports{"support rollers", {}, {}, true}, loading{"loading roller", {}, {}, true};
  for (const double side : {-0.5, 0.5})
    add_roller(supports, half, centre + side * specimen.span, 1.0, bearing);
  add_roller(loading, half, centre, -1.0, bearing);
  press.boundary.bodies = {std::move(supports), std::move(loading)};
  const double diameter = 2.0 * specimen.radius;
  press.boundary.axial = {0, 1, {0.0, 1.0}, loaded_share * diameter};
  // A displacement, and P/(2 R B) as the stress.
  press.axial = {1.0, diameter};
  return press;
}

NotchMouth notch_mouth(const Packing& half, const BendSpecimen& specimen) {
  const Vec2 flat = specimen.flat_face(half.width), inside{flat.x, 2.0 * flat.y};
  return {first_grain(half, inside, {-1.0, 0.0}), first_grain(half, inside, {1.0, 0.0})};
}

namespace {

class SemiCircularBendTest final : public Procedure {
 public:
  using Procedure::Procedure;

 private:
  void on_placed() override;
  void prescribe_motion() override;
  void read_more(HistoryRow& row) override;
  std::vector<Number> numbers(const analysis::WavePath& path) const override;
  double mouth() const;

  BendSpecimen bend_ = as_sawn(packing(), bend_specimen(recipe_));
  NotchMouth mouth_ = notch_mouth(packing(), bend_);
  double before_ = 0.0;  // opening when loading begins [m]
};

double SemiCircularBendTest::mouth() const {
  // A flank may have lost its grain to the saw.
  if (mouth_.left < 0 || mouth_.right < 0) return nan;
  const std::vector<GrainState> grains = group_->grains(lane_);
  return grains[static_cast<std::size_t>(mouth_.right)].ux - grains[static_cast<std::size_t>(mouth_.left)].ux;
}

void SemiCircularBendTest::on_placed() {
  // Settling may have opened the notch a little already.
  before_ = mouth();
  start_loading();
}

void SemiCircularBendTest::prescribe_motion() { close_platens(2.0 * bend_.radius); }

void SemiCircularBendTest::read_more(HistoryRow& row) {
  row.load = 2.0 * bend_.radius * row.axial_stress;
  row.mouth_opening = mouth() - before_;
}

std::vector<Number> SemiCircularBendTest::numbers(const analysis::WavePath& path) const {
  std::vector<Number> out = bend_numbers(result_.history, result_.cracks, bend_, path.density);
  const Number peak = *analysis::find(out, "bend_strength");
  if (std::isnan(peak.value)) {  // under which load, then?
    analysis::add(out, direct_numbers({peak.note}, nan));
    return out;
  }
  const DirectIntensity direct = direct_intensity(*specimen_, bend_, boundary());
  std::string note = "isotropic factor of Kuruppu et al. 2014";
  if (layered(*specimen_)) note += " on layered rock";
  if (!direct.missing.empty()) note += "; no K_I and K_II, " + direct.missing;
  out.front().note = analysis::joined(out.front().note, note);
  analysis::add(out, direct_numbers(direct, peak.value));
  return out;
}

std::string loading_text_of(const Recipe& r) {
  const BendSpecimen s = bend_specimen(r);
  const auto length = [](double v) { return print_quantity(v, Dimension::length); };
  return fmt::format(
      "Half discs of radius {} were cut from the specimens. They were notched from the middle of the flat "
      "face to a depth of {} (a/R = {:g}) and bent over two rollers {} apart (s/2R = {:g}). Loading and "
      "support "
      "rollers approached at {} (semi-circular bend, M.D. Kuruppu et al., Rock Mech. Rock Eng. 47 (2014) "
      "267-274). The apparent K_Ic takes the factor of an isotropic body from there.",
      length(s.radius), length(s.notch), r.test.notch_ratio, length(s.span), r.test.span_ratio,
      speed_text(r.test));
}

HistoryColumns columns() {
  using Row = HistoryRow;
  return joined(
      {clock_columns(),
       {{"load_point_displacement", "m", "approach of loading and support rollers", &Row::axial_strain},
        {"load", "N/m", "mean of loading and support rollers, per thickness", &Row::load},
        {"nominal_stress", "Pa", "load / diameter", &Row::axial_stress},
        {"nominal_stress_loading", "Pa", "force of the loading roller / diameter", &Row::stress_top},
        {"nominal_stress_supports", "Pa", "force of both support rollers / diameter", &Row::stress_bottom},
        {"mouth_opening", "m", "opening of the notch at the flat face", &Row::mouth_opening}},
       balance_columns()});
}

TestDescription description() {
  TestDescription d;
  d.name = "semi_circular_bend", d.stress = "nominal stress", d.body = "roller";
  d.extent = "a load-point displacement of {} % of the width";
  d.columns = columns();
  d.hashed = hashed_fields({"load_point_displacement", "load", "nominal_stress", "nominal_stress_loading",
                            "nominal_stress_supports", "mouth_opening"});
  d.curve.strain = "load-point displacement", d.curve.strain_unit = "mm", d.curve.strain_factor = 1000.0;
  d.curve.stress = "nominal stress P/(2RB)";
  d.curve.strength = "bend_strength", d.curve.strength_label = "largest load";
  d.curve.derived = {"K_Ic_apparent", "apparent K_Ic", "MPa sqrt(m)"};
  d.table = {{"apparent K_Ic", "MPa sqrt(m)", "K_Ic_apparent", 1e-6, 3},
             {"K_I", "MPa sqrt(m)", "K_I", 1e-6, 3},
             {"K_II", "MPa sqrt(m)", "K_II", 1e-6, 3},
             {"P max", "kN/m", "P_max", 1e-3, 2},
             {"u peak", "um", "u_peak", 1e6, 2},
             {"mouth", "um", "mouth_opening_at_peak", 1e6, 2}};
  d.cut = [](const Recipe& r) {
    const BendSpecimen s = bend_specimen(r);
    return SpecimenCut{2.0 * s.radius, true, s.notch, r.test.notch_width};
  };
  // Strengths from examples/lab/semi-circular-bend.toml.
  d.expected = {.length = [](const Recipe& r) { return 2.0 * bend_specimen(r).radius; },
                .strain_factor = bend_compliance,
                .intact = 0.02,
                .bedded = 0.015};
  // Bending waves are slower: at half of these transits K_Ic is 3 % higher.
  d.peak_of_value.strain_times_modulus = [](const Recipe& r, double K_Ic, double) {
    return bend_compliance * (K_Ic / isotropic_K_I(bend_specimen(r), 1.0));
  };
  d.peak_of_value.wave_transits = 200.0;
  d.loading_text = loading_text_of;
  d.load_on_box = ", from whose middle the half discs are cut";
  d.load_on_bedding = ", the load and the notch being vertical";
  return d;
}

}  // namespace

const TestRoom& semi_circular_bend_room() {
  static const TestRoom room = {
      description(),
      [](const Recipe& r) {
        const BendSpecimen s = bend_specimen(r);
        std::string name = "semi_circular_bend";
        // The saw takes more grains where bonds may span gaps: they belong to the name.
        for (const double v : {s.radius, s.notch, s.span, r.test.notch_width, r.matrix.bond_gap})
          name += print_number(v) + " ";
        return name;
      },
      [](const Packing& half, const Recipe& r) { return bend_rollers(half, bend_specimen(r)); },
      begin_test<SemiCircularBendTest>};
  return room;
}

}  // namespace phy::lab
