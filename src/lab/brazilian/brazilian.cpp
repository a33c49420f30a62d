#include "lab/brazilian/brazilian.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/exact_math.hpp"
#include "base/units.hpp"
#include "lab/boundaries.hpp"
#include "lab/brazilian/reading.hpp"

namespace phy::lab {

double disc_diameter(const Recipe& recipe) {
  if (recipe.test.disc_diameter > 0.0) return recipe.test.disc_diameter;
  return std::min(recipe.specimen.width, recipe.specimen.height);
}

namespace {

/// A jaw on the arc of the rim around `up` = (0, +-1).
engine::BoundaryBody jaw(const Packing& packing, std::string name, double diameter, double angle, double up) {
  engine::BoundaryBody body{std::move(name), {}, {}, true};
  const Vec2 centre{0.5 * packing.width, 0.5 * packing.height};
  // Rays from outside along the arc: each grain of the rim that one meets is held.
  const double arc = angle / 180.0 * pi * 0.5 * diameter;
  const int n = static_cast<int>(std::ceil(arc / ray_spacing(packing)));
  std::vector<char> held(packing.discs.size(), 0);
  for (int k = 0; k <= n; ++k) {
    const SinCos sc = sin_cos_degrees(angle * (static_cast<double>(k) / n - 0.5));
    const Vec2 out{sc.sin, up * sc.cos};
    const std::int64_t g = first_grain(packing, centre + diameter * out, -1.0 * out);
    if (g >= 0) held[static_cast<std::size_t>(g)] = 1;
  }
  for (std::uint32_t g = 0; g < held.size(); ++g) {
    if (held[g] == 0) continue;
    // Pressed towards the centre, as by a jaw that fits the disc.
    const Vec2 inwards = centre - Vec2{packing.discs[g].x, packing.discs[g].y};
    body.touches.push_back({g, (1.0 / norm(inwards)) * inwards, 0.0});
  }
  return body;
}

}  // namespace

TestBoundary jaws(const Packing& packing, double diameter, double angle) {
  TestBoundary splitter;
  engine::Boundary& boundary = splitter.boundary;
  if (angle > 0.0) {
    boundary.bodies = {jaw(packing, "bottom jaw", diameter, angle, -1.0),
                       jaw(packing, "top jaw", diameter, angle, 1.0)};
  } else {
    // Flat platens touch the outermost grain, which a disc of grains has somewhere near its poles.
    double low = packing.height, high = 0.0;
    for (const Disc& d : packing.discs) low = std::min(low, d.y - d.r), high = std::max(high, d.y + d.r);
    boundary.bodies = {flat_wall(packing, "bottom platen", {0.0, low}, {0.0, 1.0}, true),
                       flat_wall(packing, "top platen", {0.0, high}, {0.0, -1.0}, true)};
  }
  // The area makes the tension at the centre of the platen force: 2P/(pi D t) times Hondros' factor.
  set_axial(splitter, 0, 1, {0.0, 1.0}, {diameter, 0.5 * pi * diameter / brazilian_arc_factor(0.5 * angle)});
  return splitter;
}

namespace {

class BrazilianTest final : public Procedure {
 public:
  using Procedure::Procedure;

 private:
  void prescribe_motion() override;
  std::vector<Number> numbers(const analysis::WavePath& path) const override;
};

/// The ramp is over the diameter, as strains of this test are.
void BrazilianTest::prescribe_motion() { close_platens(disc_diameter(recipe_)); }

std::vector<Number> BrazilianTest::numbers(const analysis::WavePath& path) const {
  return disc_numbers(result_.history, result_.cracks, disc_diameter(recipe_), path.density);
}

TestDescription description() {
  TestDescription d;
  d.name = "brazilian", d.stress = "tension at the centre of an elastic disc";
  d.columns = joined(
      {clock_columns(),
       {{"axial_strain", "1", "approach of the platens / diameter", &HistoryRow::axial_strain}},
       gauge_columns(),
       {{"centre_tension", "Pa", "2P/(pi D t) times Hondros' factor, P mean platen force",
         &HistoryRow::axial_stress},
        {"centre_tension_top", "Pa", "the same from the top platen", &HistoryRow::stress_top},
        {"centre_tension_bottom", "Pa", "the same from the bottom platen", &HistoryRow::stress_bottom}},
       balance_columns()});
  d.hashed = hashed_fields({"axial_strain", "axial_strain_gauge", "lateral_strain_gauge", "centre_tension",
                            "centre_tension_top", "centre_tension_bottom"});
  d.curve.strain = "closure of the platens / diameter", d.curve.stress = "tension at the centre";
  d.curve.strength = "bts", d.curve.strength_label = "Brazilian strength";
  d.table = {{"BTS", "MPa", "bts", 1e-6, 2},
             {"sigma_ci", "MPa", "sigma_ci", 1e-6, 2},
             {"1st crack", "y/D", "first_crack_y", 1.0, 2},
             {"1st crack", "x/D", "first_crack_x", 1.0, 2},
             {"cracks in", "central third", "central_cracks", 1.0, 2}};
  d.cut = [](const Recipe& r) { return SpecimenCut{.diameter = disc_diameter(r)}; };
  // Of its own: with that of platens a coarse disc rolls out of the jaws.
  d.friction = &TestRecipe::jaw_friction;
  // 6: approach of the jaws over the diameter, over BTS / E, after Hondros.
  d.expected = {.length = disc_diameter, .strain_factor = 6.0, .intact = 0.36, .bedded = 0.2};
  d.peak_of_value.strain_times_modulus = [](const Recipe&, double strength, double) {
    return disc_approach * strength;
  };
  d.loading_text = [](const Recipe& r) {
    return fmt::format("Discs of {} were cut from the specimens; {} (friction {:g}) closed on them at {}.",
                       print_quantity(disc_diameter(r), Dimension::length),
                       r.test.loading_angle > 0.0
                           ? fmt::format("two jaws, each on an arc of {:g} deg", r.test.loading_angle)
                           : "two flat platens",
                       r.test.jaw_friction, speed_text(r.test));
  };
  return d;
}

}  // namespace

const TestRoom& brazilian_room() {
  static const TestRoom room = {
      description(),
      [](const Recipe& r) {
        return "brazilian" + print_number(disc_diameter(r)) + " " + print_number(r.test.loading_angle);
      },
      [](const Packing& disc, const Recipe& r) { return jaws(disc, disc_diameter(r), r.test.loading_angle); },
      begin_test<BrazilianTest>};
  return room;
}

}  // namespace phy::lab
