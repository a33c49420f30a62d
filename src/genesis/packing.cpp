#include "genesis/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "base/hash.hpp"
#include "base/rng.hpp"
#include "genesis/near_pairs.hpp"
#include "genesis/placement.hpp"
#include "genesis/rattlers.hpp"
#include "genesis/settle.hpp"

namespace phy::genesis {
namespace {

constexpr double balanced = 1e-6;          // mean unbalanced / mean contact force of the finished packing
constexpr double nearly_balanced = 1e-4;   // enough to tell which discs float
constexpr double roughly_balanced = 1e-3;  // enough to see how far the stress is from its target
// Of more discs the last two digits of balance are most of the cost. Three packings of 7,481 discs settled to
// 1e-4 against the same to 1e-6, four specimens each: small-strain E -0.2 +- 0.1 % (single ones within 1 %),
// UCS +0.3 +- 0.4 % (within 3.7 %; another draw of the bonds: 5 %). A packing of up to so many keeps the bits
// that it had before there were larger ones.
constexpr std::size_t many_discs = 200000;
constexpr double stress_tolerance = 0.01;  // of the target
constexpr double loose_growth = 2e-3;      // radii, when nothing touches yet
constexpr double no_force_overlap = 1e-9;  // of the mean radius: no force
constexpr long max_settle_iterations = 200000;
constexpr int max_stress_steps = 200;
constexpr int max_rattler_passes = 3;  // two thirds are gone then; further passes gain little

double draw_radius(const PackingRecipe& r, std::uint32_t i) {
  const double u = uniform(static_cast<std::uint32_t>(r.seed), Stream::radius, i);
  if (r.distribution == RadiusDistribution::by_number)
    return r.radius_min + u * (r.radius_max - r.radius_min);
  // density ~ 1/r^2: F(r) = (1/min - 1/r)/(1/min - 1/max)
  return 1.0 / (1.0 / r.radius_min - u * (1.0 / r.radius_min - 1.0 / r.radius_max));
}

double porosity_of(const SpecimenSize& size, const std::vector<Disc>& discs) {
  double area = 0.0;
  for (const Disc& d : discs) area += pi * d.r * d.r;
  return 1.0 - area / (size.width * size.height);
}

std::vector<Disc> draw_radii(const SpecimenSize& size, const PackingRecipe& r) {
  std::vector<Disc> discs;
  if (r.n_grains > 0) {
    const auto n = static_cast<std::uint32_t>(r.n_grains);
    for (std::uint32_t i = 0; i < n; ++i) discs.push_back({0.0, 0.0, draw_radius(r, i)});
    return discs;
  }
  double missing = (1.0 - r.porosity) * size.width * size.height;  // area still to fill
  for (;;) {
    const double radius = draw_radius(r, static_cast<std::uint32_t>(discs.size()));
    const double area = pi * radius * radius;
    // The last disc where it brings the porosity nearer: on average none is missing or too many.
    if (missing < 0.5 * area) return discs;
    discs.push_back({0.0, 0.0, radius});
    missing -= area;
  }
}

void scale_radii(std::vector<Disc>& discs, double factor) {
  for (Disc& d : discs) d.r *= factor;
}

double mean_radius(const std::vector<Disc>& discs) {
  double sum = 0.0;
  for (const Disc& d : discs) sum += d.r;
  return sum / static_cast<double>(discs.size());
}

/// Scales all radii and settles until the pressure (in units of E_c) is within the tolerance of the target.
Equilibrium settle_to_pressure(const SettleBox& box, std::vector<Disc>& discs, double target,
                               double final_tolerance) {
  const double volume = box.width * box.height;
  double growth = loose_growth, tolerance = roughly_balanced;
  bool has_held = false;
  Equilibrium e;
  for (int k = 0; k < max_stress_steps; ++k) {
    // Below a thousandth of the target the packing counts as loose: the overlap of one contact is about
    // pressure times the diameter.
    const double no_force = 1e-3 * target * mean_radius(discs);
    e = settle(box, discs, tolerance, no_force, max_settle_iterations);
    const double error = e.pressure / target - 1.0;
    if (e.loose) {
      if (has_held) growth *= 0.5;  // overshot: approach in smaller steps
      scale_radii(discs, 1.0 + growth);
      continue;
    }
    has_held = true;
    if (std::abs(error) <= stress_tolerance && tolerance <= final_tolerance) return e;
    tolerance = std::abs(error) <= 10.0 * stress_tolerance ? final_tolerance : roughly_balanced;
    if (std::abs(error) <= stress_tolerance) continue;  // right, but not yet balanced well enough
    const double alpha = radius_change(volume, target - e.pressure, e.stiffness);
    scale_radii(discs, 1.0 + std::min(alpha, growth));
  }
  return e;
}

PackingReport report_on(const SettleBox& box, const std::vector<Disc>& discs, const Equilibrium& e) {
  PackingReport r;
  r.porosity = porosity_of({box.width, box.height}, discs);
  r.coordination = 2.0 * static_cast<double>(e.n_contacts) / static_cast<double>(discs.size());
  r.mean_overlap = e.mean_overlap / mean_radius(discs);
  r.unbalanced = e.unbalanced;
  r.n_rattlers = static_cast<std::int64_t>(find_rattlers(box, discs).size());
  double fabric = 0.0;
  long n = 0;
  for (const Pair& p : near_pairs(discs, 0.0)) {
    const double dx = discs[p.b].x - discs[p.a].x, dy = discs[p.b].y - discs[p.a].y;
    const double d2 = dx * dx + dy * dy;
    if (d2 == 0.0) continue;
    fabric += (dx * dx - dy * dy) / d2;  // cos 2 angle
    ++n;
  }
  if (n > 0) r.fabric = fabric / static_cast<double>(n);
  return r;
}

/// Stress-free packings are settled with equal springs, so that E_c and its convention do not move the discs.
SettleBox box_of(const SpecimenSize& size, const PackingRecipe& recipe, const MatrixRecipe& matrix) {
  const bool stress_free = recipe.initial_stress == InitialStress::stress_free;
  return {
      size.width, size.height, stress_free ? StiffnessConvention::pfc31 : matrix.stiffness_convention, {}};
}

Packing finish(const SettleBox& box, const PackingRecipe& recipe, const MatrixRecipe& matrix,
               std::vector<Disc> discs, const Equilibrium& e) {
  Packing p;
  p.width = box.width;
  p.height = box.height;
  p.stress_free = recipe.initial_stress == InitialStress::stress_free;
  p.report = report_on(box, discs, e);
  p.report.stress_left = p.stress_free ? 0.0 : e.pressure * matrix.E_c;
  p.hash = packing_hash(discs);
  p.discs = std::move(discs);
  return p;
}

std::string number(double x) { return std::to_string(x); }

/// Least isotropic stress that a packing can be brought to [Pa]: overlaps are the radius times stress over
/// E_c, and below some the last bits of a coordinate across the specimen push more than the packing may be
/// out of balance.
double least_stress(const SpecimenSize& size, const PackingRecipe& r, const MatrixRecipe& matrix) {
  constexpr double of_a_coordinate = 0.25;  // share of its rounding that is left in the mean over contacts
  const double rounding =
      of_a_coordinate * std::numeric_limits<double>::epsilon() * std::max(size.width, size.height);
  return matrix.E_c * rounding / (balanced * 0.5 * (r.radius_min + r.radius_max));
}

void check_input(const SpecimenSize& size, const PackingRecipe& r, const MatrixRecipe& matrix) {
  std::vector<Problem> problems;
  const double room = 0.5 * std::min(size.width, size.height);
  if (!(r.radius_min > 0.0 && r.radius_min <= r.radius_max && r.radius_max < room))
    problems.push_back({"", "packing.radius_max", number(r.radius_max * 1e3) + " mm",
                        "0 < radius_min <= radius_max < " + number(room * 1e3) + " mm (half the specimen)",
                        "choose smaller discs or a larger specimen"});
  else if (r.n_grains <= 0 && !(r.porosity > 0.0 && r.porosity < 1.0))
    problems.push_back({"", "packing.porosity", number(r.porosity), "0 < porosity < 1 where n_grains is 0",
                        "give packing.n_grains or packing.porosity"});
  else if (r.n_grains > 0 ? r.n_grains < 2 : draw_radii(size, r).size() < 2)
    problems.push_back(
        {"", "packing.n_grains", std::to_string(r.n_grains), "at least 2 discs", "choose smaller discs"});
  if (r.initial_stress == InitialStress::isotropic && !(r.isotropic_stress > 0.0))
    problems.push_back({"", "packing.isotropic_stress", number(r.isotropic_stress) + " Pa", "> 0 Pa",
                        "give a stress, or initial_stress = \"stress_free\""});
  else if (r.initial_stress == InitialStress::isotropic && r.isotropic_stress < least_stress(size, r, matrix))
    problems.push_back(
        {"", "packing.isotropic_stress", fmt::format("{:g} Pa", r.isotropic_stress),
         fmt::format("at least {:.3g} Pa, as less is lost in rounding", least_stress(size, r, matrix)),
         "give more, or initial_stress = \"stress_free\""});
  if (!problems.empty()) throw InputError(problems);
}

}  // namespace

std::string packing_hash(const std::vector<Disc>& discs) {
  Hash h;
  for (const Disc& d : discs) {
    h.add(d.x);
    h.add(d.y);
    h.add(d.r);
  }
  return h.text();
}

Packing make_packing(const SpecimenSize& size, const PackingRecipe& recipe, const MatrixRecipe& matrix,
                     const std::function<bool()>& stop) {
  check_input(size, recipe, matrix);
  SettleBox box = box_of(size, recipe, matrix);
  box.stop = stop;
  std::vector<Disc> discs = draw_radii(size, recipe);
  const bool many = discs.size() > many_discs;
  (many ? place_in_rows : place_at_random)(size, recipe.seed, discs);
  const double pressure =
      recipe.initial_stress == InitialStress::isotropic ? recipe.isotropic_stress / matrix.E_c : 0.0;
  const auto balance = [&](double tolerance) {
    if (pressure > 0.0) return settle_to_pressure(box, discs, pressure, tolerance);
    return settle(box, discs, tolerance, no_force_overlap * mean_radius(discs), max_settle_iterations);
  };
  const double to_find_rattlers = many ? roughly_balanced : nearly_balanced;
  Equilibrium e = balance(to_find_rattlers);
  for (int pass = 0; pass < max_rattler_passes && !e.loose; ++pass) {
    if (grow_rattlers(box, discs, e.mean_overlap) == 0) break;
    e = balance(to_find_rattlers);
  }
  if (!e.loose) e = balance(many ? nearly_balanced : balanced);
  return finish(box, recipe, matrix, std::move(discs), e);
}

Packing adopt_packing(const SpecimenSize& size, const PackingRecipe& recipe, const MatrixRecipe& matrix,
                      std::vector<Disc> discs) {
  const auto problem = [&](std::size_t i, const char* what) {
    std::string disc = "disc " + std::to_string(i + 1);
    if (i < discs.size())
      disc += fmt::format(" at ({:g}, {:g}) mm, radius {:g} mm", 1e3 * discs[i].x, 1e3 * discs[i].y,
                          1e3 * discs[i].r);
    return InputError(
        Problem{"", "packing.file", disc, what,
                "check the units of the file, and its origin: the lower left corner of the specimen"});
  };
  if (discs.size() < 2) throw problem(discs.size(), "at least 2 discs");
  // Beyond these the cells of the neighbour search are without number, or one disc is the whole specimen.
  const double side = std::min(size.width, size.height), smallest = 1e-4 * side, largest = 0.5 * side;
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const Disc& d = discs[i];
    if (!(d.r >= smallest && d.r < largest))
      throw problem(i, "a radius from 1/10000 to less than 1/2 of the smaller side of the specimen");
    if (!(d.x > 0.0 && d.x < size.width && d.y > 0.0 && d.y < size.height))
      throw problem(i, "a centre inside the specimen, 0 < x < width, 0 < y < height");
  }
  const SettleBox box = box_of(size, recipe, matrix);
  const Equilibrium e = settle(box, discs, 0.0, 0.0, 0);
  return finish(box, recipe, matrix, std::move(discs), e);
}

}  // namespace phy::genesis
