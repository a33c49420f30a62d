// Recipes drawn at random from the one list of keys, so that a key that comes to the list is drawn, too.
//
// Every key has a chance to be drawn: near its value, anywhere in its range (over all magnitudes, where the
// range has several), or at an end of it. Sizes are drawn together, so that 16 to 300 discs fill the box.
// What the checks between keys refuse goes back to where it was; a recipe that cannot be mended so is drawn
// anew.
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "base/rng.hpp"
#include "records/recipe_schema.hpp"
#include "records/test_description.hpp"
#include "study/expected.hpp"
#include "study/experiment.hpp"

namespace phy {

constexpr double most_discs = 300.0, most_cycles = 25000.0, usual_speed = 1.0;

class RandomRecipe {
 public:
  explicit RandomRecipe(std::uint32_t number) : number_(number) {}

  /// The recipe of that number; nothing after 200 tries.
  std::optional<Recipe> draw() {
    for (int i = 0; i < 200; ++i)
      if (std::optional<Recipe> r = one(); r && is_small(*r)) return r;
    return {};
  }

 private:
  std::uint32_t number_, n_drawn_ = 0;

  double unit() { return uniform(number_, Stream::test, n_drawn_++); }
  double between(double a, double b) { return a + (b - a) * unit(); }
  bool chance(double p) { return unit() < p; }

  /// A box for some hundred discs, of any size between sand and boulders, and all that scales with it.
  Recipe base() {
    Recipe r;
    const double radius = 1e-5 * std::pow(10.0, between(0.0, 4.0)), ratio = between(1.0, 2.0);
    r.packing.radius_min = radius, r.packing.radius_max = ratio * radius;
    r.specimen.width = between(10.05, 12.0) * (1.0 + ratio) * radius;
    r.specimen.height = between(1.0, 2.0) * r.specimen.width;
    r.packing.n_grains = 0, r.packing.porosity = between(0.05, 0.2);
    if (chance(0.5)) r.packing.n_grains = std::llround(study::expected_grains(r)), r.packing.porosity = 0.0;
    r.bedding.resize(chance(0.15) ? 0 : chance(0.2) ? 2 : 1);
    for (BeddingRecipe& b : r.bedding) {
      b.spacing = between(2.0, 6.0) * ratio * radius, b.zone_thickness = between(0.3, 0.9) * b.spacing;
      b.k_n *= 2.5e-4 / radius, b.k_s *= 2.5e-4 / radius;
    }
    r.test.platen_speed = usual_speed;
    r.test.n_frames = r.test.n_snapshots = 1;
    return r;
  }

  double anywhere(const Field& f) {
    if (f.kind == FieldKind::choice) return std::floor(unit() * static_cast<double>(f.choices.size()));
    const double low = f.min > 0.0 ? f.min : 1e-9 * f.max;
    const bool magnitudes = f.kind != FieldKind::boolean && f.max > 100.0 * low && chance(0.5);
    return magnitudes ? low * std::pow(f.max / low, unit()) : between(f.min, f.max);
  }
  double value_of(const Field& f, double now) {
    double v = anywhere(f);
    if (f.kind == FieldKind::choice) return v;
    const double how = unit();
    if (how < 0.6 && now != 0.0) v = now * std::pow(10.0, between(-0.5, 0.5));
    if (how > 0.97) v = chance(0.5) ? f.min : f.max;
    if (f.kind == FieldKind::integer || f.kind == FieldKind::boolean) v = std::round(v);
    return v;
  }
  static bool is_size(const Field& f) {
    return f.table == "specimen" || f.key == "radius_min" || f.key == "radius_max" || f.key == "n_grains" ||
           f.key == "porosity";
  }

  void change(const Field& f, Recipe& r, std::size_t set) {
    if (is_size(f)) return;  // drawn together
    if (f.kind == FieldKind::text) {
      if (f.path() == "name" && chance(0.1)) f.set_text(r, "\"quoted\", \\ and \xc3\xb8");
      return;
    }
    if (f.kind == FieldKind::quantities) {
      for (double share = chance(0.4) ? unit() : 1.0; share < 0.5; share += 0.3)
        f.list(r).push_back(share * f.max);
      return;
    }
    const double chosen = f.kind == FieldKind::choice ? 0.6 : 0.15;
    if (!chance(chosen)) return;
    const double v = value_of(f, f.get(r, set));
    if (within_range(f, v)) f.set(r, set, v);
  }

  std::optional<Recipe> one() {
    const Recipe usual = base();
    Recipe r = usual;
    for (const Field& f : recipe_fields())
      for (std::size_t set = 0; set < (f.table == "bedding" ? r.bedding.size() : 1); ++set) change(f, r, set);
    const auto nowhere = [](const std::string&) { return std::string(); };
    for (std::size_t i = 0; i < recipe_fields().size(); ++i) {
      const std::vector<Problem> problems = cross_checks(r, nowhere);
      if (problems.empty()) return r;
      if (!mend(problems.front().key, usual, r)) return {};
    }
    return {};
  }

  /// The key as it was, "bedding[1].k_n" or "matrix.mu"; false if it was not drawn.
  static bool mend(const std::string& path, const Recipe& usual, Recipe& r) {
    const std::size_t bracket = path.find('[');
    const std::size_t set = bracket == path.npos ? 0 : std::stoul(path.substr(bracket + 1));
    const Field* f =
        find_field(recipe_fields(),
                   bracket == path.npos ? path : path.substr(0, bracket) + path.substr(path.find(']') + 1));
    if (f == nullptr) return false;
    if (f->list) {
      if (f->list(r).empty()) return false;
      f->list(r).clear();
      return true;
    }
    if (!f->get || f->get(r, set) == f->get(usual, set)) return false;
    f->set(r, set, f->get(usual, set));
    return true;
  }

  /// Stiffness of a joint over that of a bond, or 1: the time step follows from the larger.
  static double stiffest_joint(const Recipe& r) {
    double most = 1.0;
    for (const BeddingRecipe& b : r.bedding)
      most = std::max(most, std::max(b.k_n, b.k_s) * 2.0 * r.packing.radius_max / r.matrix.modulus());
    return most;
  }
  /// 1 and, over the way of test.max_strain, the way until the stress on the sides is there.
  static double way_to_kept_stress(const Recipe& r) {
    const KeptStress& kept = r.test.kind->kept_stress;
    if (kept.value == nullptr) return 1.0;
    return 1.0 + 2.0 * r.test.*kept.value / (r.matrix.modulus() * r.test.max_strain) * r.specimen.height /
                     r.test.kind->expected.length(r);
  }
  /// Gives a recipe whose speed was not drawn, or would take longer, the speed that makes the whole way of
  /// test.max_strain in most_cycles; false where that is too fast for a recipe, or with too many discs.
  static bool is_small(Recipe& r) {
    Recipe whole = r;
    whole.test.kind = TestKind(), whole.test.pre_strain = 0.0;
    if (study::expected_grains(whole) > most_discs) return false;
    const TestKind to_its_end("direct_shear");  // what it costs is the whole way
    whole.test.kind = to_its_end, whole.bedding.clear();
    const double cycles = study::expected_cost(whole) / study::expected_grains(whole) *
                          r.test.kind->expected.length(r) / to_its_end->expected.length(whole) *
                          std::sqrt(stiffest_joint(r)) * way_to_kept_stress(r);
    const bool as_drawn = r.test.platen_speed != usual_speed && cycles < most_cycles;
    if (!as_drawn) r.test.platen_speed *= cycles / most_cycles;
    return r.test.platen_speed <= 10.0;
  }
};

}  // namespace phy
