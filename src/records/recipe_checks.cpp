// Problems between keys of a recipe that are each in range (cross_checks).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/exact_math.hpp"
#include "records/recipe_schema.hpp"
#include "records/test_description.hpp"

namespace phy {
namespace {

constexpr double min_grains_across = 10.0;  // fewer: the walls decide, not the rock
constexpr double widest_notch = 0.05;       // of the diameter; wider, the formula of a crack is off
constexpr double most_planes = 200.0;       // that scatter; a contact numbers them in one byte
constexpr std::int64_t min_grains = 16;     // fewer do not settle into a packing
constexpr double min_ligament = 5.0;        // mean grain diameters of rock between an opening and the outside
constexpr double min_opening = 2.0;         // largest grain diameters; a smaller one may take out no grain

using Paths = std::vector<std::string>;

/// The paths of `these` with `more` behind them.
Paths with(Paths these, const Paths& more) {
  these.insert(these.end(), more.begin(), more.end());
  return these;
}
// An imported packing brings its own grains: what the recipe says of them counts without a file only.
const Paths radii = {"packing.radius_min", "packing.radius_max", "packing.file"};
const Paths box = {"specimen.width", "specimen.height"};
const Paths ratios = {"matrix.stiffness_ratio", "matrix.tension_ratio", "matrix.cohesion_ratio",
                      "matrix.cohesion_oblique"};

/// Collects problems between keys; one function per table. A check names all keys that it compares and is
/// left out if one of them could not be read: what it would say is about a default that nobody wrote.
class CrossChecks {
 public:
  CrossChecks(const Recipe& recipe, const std::function<std::string(const std::string&)>& where,
              const std::function<bool(const std::string&)>& is_known)
      : r_(recipe), where_(where), is_known_(is_known) {}

  std::vector<Problem> run() {
    // An imported packing has its own grains: what the recipe says of them is not used.
    if (r_.packing.file.empty()) packing();
    matrix();
    for (set_ = 0; set_ < r_.bedding.size(); ++set_) bedding(r_.bedding[set_]);
    planes_that_scatter();
    test();
    r_.specimen.hole_diameter > 0.0 ? hole() : flaw();
    return std::move(problems_);
  }

 private:
  const Recipe& r_;
  const std::function<std::string(const std::string&)>& where_;
  const std::function<bool(const std::string&)>& is_known_;
  std::size_t set_ = 0;  // of bedding, that is looked at: "bedding.k_n" is its key
  std::vector<Problem> problems_;

  /// `paths`: the key that is reported, with its value, then those that it is held against.
  void report_problem(Paths paths, const std::string& expected, const std::string& remedy) {
    // As it would stand in the file, so that the user finds it there; quotes are for TOML.
    const Field& f = *find_field(recipe_fields(), paths.front());
    std::string value = print_field(f, r_, set_);
    std::erase(value, '"');
    report_value(std::move(paths), value, expected, remedy);
  }
  void report_value(Paths paths, const std::string& value, const std::string& expected,
                    const std::string& remedy) {
    // The user counts sets in the file: "bedding[1].k_n".
    for (std::string& path : paths)
      if (path.starts_with("bedding.")) path.insert(7, "[" + std::to_string(set_) + "]");
    if (std::all_of(paths.begin(), paths.end(), is_known_))
      problems_.push_back({where_(paths.front()), paths.front(), value, expected, remedy});
  }
  static std::string length(double v) { return print_quantity(v, Dimension::length); }
  bool has_own_grains() const { return r_.packing.file.empty(); }

  void packing() {
    const PackingRecipe& p = r_.packing;
    const bool isotropic = p.initial_stress == InitialStress::isotropic;
    // Either key alone would be passed over in silence: a stress that is not locked in, or none that is.
    const Paths stress = {"packing.isotropic_stress", "packing.initial_stress", "packing.file"};
    if (isotropic && !(p.isotropic_stress > 0.0))
      report_problem(stress, "above 0 with isotropic", "give the stress, for example \"0.5 MPa\"");
    if (!isotropic && p.isotropic_stress > 0.0)
      report_problem(stress, "0 with stress_free", "leave it out, or set initial_stress = \"isotropic\"");
    if (p.radius_min > p.radius_max)
      return report_problem(radii, "at most radius_max = " + length(p.radius_max), "exchange the two");
    const SpecimenSize& size = r_.specimen;
    const double least = min_grains_across * (p.radius_min + p.radius_max);
    if (std::min(size.width, size.height) < least)
      report_problem(
          with({size.width < size.height ? "specimen.width" : "specimen.height"}, with(box, radii)),
          "at least ten mean grain diameters, " + length(least), "use smaller grains or a larger specimen");
    // In a box of given size with given radii each follows from the other.
    if ((p.n_grains > 0) == (p.porosity > 0.0))
      return report_problem({"packing.n_grains", "packing.porosity", "packing.file"},
                            "exactly one of n_grains and porosity",
                            p.n_grains > 0 ? "set the other one to 0 or leave it out" : "give one of them");
    p.n_grains > 0 ? grains_fill_the_box() : porosity_gives_a_number();
  }
  void grains_fill_the_box() {
    const PackingRecipe& p = r_.packing;
    const double area = r_.specimen.width * r_.specimen.height, n = static_cast<double>(p.n_grains);
    const double smallest = n * pi * p.radius_min * p.radius_min,
                 largest = n * pi * p.radius_max * p.radius_max;
    if (p.n_grains < min_grains)
      report_problem({"packing.n_grains", "packing.file"}, "0, or at least " + std::to_string(min_grains),
                     "");
    // By discs that are all the smallest, or all the largest: only what cannot fill the box is refused.
    // The paper's discs fill 0.92 of their box, overlaps counted twice: a mixture of radii between these
    // bounds may come to that.
    else if (smallest > 1.05 * area || largest < 0.7 * area)
      report_problem(with({"packing.n_grains"}, with(box, radii)), "", how_to_fill());
  }
  /// "500 discs of 0.665 mm fill 6 % of 38 mm x 76 mm. About 7500 fill it; or make them larger: ..."
  std::string how_to_fill() const {
    const PackingRecipe& p = r_.packing;
    const Recipe usual;  // fills its specimen as packings do
    const auto share = [](const Recipe& r) {
      return static_cast<double>(r.packing.n_grains) * pi * r.packing.mean_square_radius() /
             (r.specimen.width * r.specimen.height);
    };
    // Two digits of a number and three of a radius are enough: how full packings are varies by more.
    const double scale = std::sqrt(share(usual) / share(r_)),
                 n = rounded(static_cast<double>(p.n_grains) * scale * scale, 2);
    const auto grown = [&](double radius) { return "\"" + length(rounded(scale * radius, 3)) + "\""; };
    std::string text = fmt::format(
        "{} discs of {} fill {} % of {} x {}.", p.n_grains, length(rounded(p.radius_min + p.radius_max, 4)),
        print_number(rounded(100.0 * share(r_), 2)), length(r_.specimen.width), length(r_.specimen.height));
    const bool countable = n <= static_cast<double>(max_recipe_grains),
               many_across = std::min(r_.specimen.width, r_.specimen.height) >=
                             min_grains_across * scale * (p.radius_min + p.radius_max);
    if (countable) text += fmt::format(" About {:.0f} fill it", n);
    if (many_across)
      text += fmt::format("{} make them {}: radius_min = {}, radius_max = {}", countable ? "; or" : " Or",
                          scale > 1.0 ? "larger" : "smaller", grown(p.radius_min), grown(p.radius_max));
    return text;
  }
  void porosity_gives_a_number() {
    const PackingRecipe& p = r_.packing;
    const double solid = (1.0 - p.porosity) * r_.specimen.width * r_.specimen.height;
    const double n = solid / (pi * p.mean_square_radius());
    if (n > static_cast<double>(max_recipe_grains))
      report_problem(with({"packing.porosity", "packing.distribution"}, with(box, radii)),
                     fmt::format("at most {} grains; this gives some {:.0f}", max_recipe_grains,
                                 // Beyond that the number would fill lines.
                                 std::floor(std::min(n, 1e15))),
                     "use larger grains or a smaller specimen");
  }

  /// Keys that the model of the matrix does not have; at their defaults they say nothing.
  void unused(const std::vector<const char*>& keys) {
    const std::string model = print_field(*find_field(recipe_fields(), "matrix.model"), r_, 0);
    for (const char* key : keys) {
      const Field& f = *find_field(recipe_fields(), key);
      // Written at its default a key does no harm; elsewhere the user expects an effect that it has not.
      if (print_field(f, r_, 0) != f.default_text)
        report_value({key, "matrix.model"}, print_field(f, r_, 0), "nothing where model = " + model,
                     "leave it out, or at its default of " + f.default_text);
    }
  }

  void flat_joint() {
    const MatrixRecipe& m = r_.matrix;
    if (m.model != MatrixModel::flat_joint)
      return unused({"matrix.elements", "matrix.break_at", "matrix.gapped_fraction", "matrix.initial_gap"});
    unused({"matrix.stiffness_convention", "matrix.E_b", "matrix.bond_ks_over_kn",
            "matrix.moment_contribution", "matrix.stiffness_ratio"});
    // A share without a gap touches all the same, and a gap of no share is nowhere.
    if ((m.gapped_fraction > 0.0) != (m.initial_gap > 0.0))
      report_problem({"matrix.gapped_fraction", "matrix.initial_gap"},
                     "above 0 together with initial_gap, or both 0", "give both or none");
    if (m.gapped_fraction + m.unbonded_fraction > 0.9)
      report_problem({"matrix.gapped_fraction", "matrix.unbonded_fraction"},
                     "at most 0.9 together with unbonded_fraction", "lower one of them");
  }

  void matrix() {
    const MatrixRecipe& m = r_.matrix;
    flat_joint();
    // The key would be passed over: with constant strength no pressure counts.
    if (m.phi > 0.0 && m.shear_strength == ShearStrength::constant)
      report_problem({"matrix.phi", "matrix.shear_strength"}, "0 deg with shear_strength = \"constant\"",
                     "leave it out, or set shear_strength = \"cohesion_friction\"");
    if (m.foliation != 0.0 && !m.directional())
      report_problem(with({"matrix.foliation"}, ratios), "0 deg where all ratios are 1",
                     "leave it out, or give the matrix directions by one of its ratios");
    const double grain = 2.0 * r_.packing.radius_max;
    if (m.bond_gap > grain && has_own_grains())
      report_problem({"matrix.bond_gap", "packing.radius_max", "packing.file"},
                     "at most the largest grain diameter, " + length(grain),
                     "wider bonds would reach past a neighbour");
  }

  void bedding(const BeddingRecipe& b) {
    if (!b.has_planes()) dispersed();
    layers(b);
    planes_apart(b);
    if (tan_degrees(b.psi) > b.mu)
      report_problem({"bedding.psi", "bedding.mu"}, "tan(psi) <= mu = " + print_number(b.mu),
                     "a joint that dilates more than it rubs would create energy; lower psi or raise mu");
  }

  /// A contact belongs to one plane: planes are farther apart than zones are thick and grains are wide. Where
  /// planes scatter this holds three standard deviations below the mean spacing, too.
  void planes_apart(const BeddingRecipe& b) {
    const std::string also = ", three standard deviations below the mean spacing, too";
    const double diameter = 2.0 * r_.packing.radius_max;
    const bool zone = b.rule == BeddingRule::zone;
    // The mean spacing before its scatter: a scatter is not to blame for planes that are too close anyway.
    if (zone && b.zone_thickness >= b.spacing)
      report_problem({"bedding.zone_thickness", "bedding.spacing", "bedding.rule"},
                     "below the spacing of " + length(b.spacing), "use a thinner zone or a wider spacing");
    else if (zone && b.zone_thickness >= b.narrowest())
      report_problem({"bedding.spacing_sd", "bedding.zone_thickness", "bedding.spacing", "bedding.rule"},
                     "planes more than zone_thickness = " + length(b.zone_thickness) + " apart" + also,
                     "lower spacing_sd, use a thinner zone or a wider spacing");
    // Closer than a grain two planes may cross one contact, which can be a joint of one only.
    if (!b.has_planes() || !has_own_grains() || b.narrowest() >= diameter) return;
    if (b.spacing < diameter)
      report_problem({"bedding.spacing", "packing.radius_max", "packing.file"},
                     "at least the largest grain diameter, " + length(diameter),
                     "use a wider spacing or smaller grains");
    else
      report_problem({"bedding.spacing_sd", "bedding.spacing", "packing.radius_max", "packing.file"},
                     "planes at least the largest grain diameter, " + length(diameter) + ", apart" + also,
                     "lower spacing_sd, use a wider spacing or smaller grains");
  }

  /// What an oriented set has not is refused: whoever writes it expects planes.
  void dispersed() {
    for (const char* path :
         {"bedding.spacing", "bedding.offset", "bedding.spacing_sd", "bedding.theta_sd",
          "bedding.persistence", "bedding.patch_length", "bedding.bridges", "bedding.layer_thickness"}) {
      const Field& f = *find_field(recipe_fields(), path);
      if (print_field(f, r_, set_) != f.default_text)
        report_problem({path, "bedding.rule"}, "nothing with rule = \"oriented\", which has no planes",
                       "leave it out, or use the rule zone or crossing");
    }
  }
  void layers(const BeddingRecipe& b) {
    if (b.has_planes() && b.layer_thickness >= b.narrowest())
      report_problem({"bedding.layer_thickness", "bedding.spacing", "bedding.spacing_sd", "bedding.rule"},
                     "below the least spacing, " + length(b.narrowest()),
                     "use thinner layers, or make them the matrix and the rest the layers");
    for (const auto& [path, value] : {std::pair{"bedding.layer_stiffness", b.layer_stiffness},
                                      std::pair{"bedding.layer_strength", b.layer_strength}})
      if (value != 1.0 && b.layer_thickness == 0.0)
        report_problem({path, "bedding.layer_thickness"}, "1 without layers", "give layer_thickness");
    // An interface of flat joints has one modulus all over the specimen.
    if (b.layer_stiffness != 1.0 && r_.matrix.model == MatrixModel::flat_joint)
      report_problem({"bedding.layer_stiffness", "matrix.model"}, "1 with model = \"flat_joint\"",
                     "layers of flat joints differ by layer_strength only");
    if (b.unjointed() && b.layer_thickness == 0.0)
      report_problem({"bedding.persistence", "bedding.layer_thickness"}, "above 0 without layers",
                     "a set without joints and without layers does nothing: leave the [[bedding]] out");
  }
  /// Planes that scatter are numbered in one byte, with the other sets.
  void planes_that_scatter() {
    const double diagonal = std::hypot(r_.specimen.width, r_.specimen.height);
    double n = 0.0;
    std::string first;
    Paths paths = box;
    for (std::size_t i = 0; i < r_.bedding.size(); ++i) {
      const BeddingRecipe& b = r_.bedding[i];
      // Planes across the diagonal, three more at the ends, and those that turn in from outside by three
      // standard deviations.
      n += b.scatters() ? (diagonal / b.spacing + 3.0) / sin_cos_degrees(3.0 * b.theta_sd).cos : 1.0;
      if (!b.scatters()) continue;
      const std::string set = "bedding[" + std::to_string(i) + "].";
      if (first.empty()) first = b.spacing_sd > 0.0 ? set + "spacing_sd" : set + "theta_sd";
      for (const char* key : {"spacing", "spacing_sd", "theta_sd"}) paths.push_back(set + key);
    }
    if (first.empty() || n <= most_planes) return;
    paths.insert(paths.begin(), first);
    report_value(paths, "some " + std::to_string(std::lround(n)) + " planes",
                 "at most " + std::to_string(std::lround(most_planes)) + " planes where planes scatter",
                 "use a wider spacing or a smaller specimen, or leave the scatter out");
  }

  void test() {
    const TestRecipe& t = r_.test;
    if (!t.angles.empty() && !layered(r_))
      report_value({"test.angles", "bedding"}, "given", "layers to turn",
                   "add [[bedding]] or directions of the matrix, or remove test.angles");
    // Directions are the matrix's own: taking the planes away leaves them.
    if (t.intact && r_.matrix.directional())
      report_problem(with({"test.intact"}, ratios), "false with a matrix that has directions",
                     "no specimen of it is intact: leave the key out, or set the ratios to 1");
    // The same angle twice would be the same specimen twice, to the last bit.
    std::vector<double> sorted = t.angles;
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end())
      report_value({"test.angles"}, print_quantity(*twice, Dimension::angle), "every angle once",
                   "remove the second one; for another specimen change a seed");
    test_of_kind();
    cut_specimen(t.kind->cut != nullptr ? t.kind->cut(r_) : SpecimenCut{});
    approach();
    for (const auto& [path, strain] :
         {std::pair{"test.ramp_strain", t.ramp_strain}, std::pair{"test.pre_strain", t.pre_strain},
          std::pair{"test.approach_strain", t.approach_strain}})
      if (strain >= t.max_strain)
        report_problem({path, "test.max_strain"}, "below max_strain = " + print_number(t.max_strain),
                       "lower it, or raise max_strain");
  }

  /// A strain of 0 switches the approach off, whatever its speed: a study varies it from there.
  void approach() {
    const TestRecipe& t = r_.test;
    if (t.approach_strain == 0.0) return;
    const double start = t.pre_strain + t.ramp_strain;
    if (t.approach_speed == 0.0)
      report_problem({"test.approach_strain", "test.approach_speed"}, "0 without an approach_speed",
                     "say how fast the platens are up to there");
    else if (t.approach_speed < t.platen_speed)
      report_problem({"test.approach_speed", "test.platen_speed"},
                     "at least platen_speed = " + print_quantity(t.platen_speed, Dimension::speed),
                     "the approach is what may be fast: raise it, or set approach_strain to 0");
    // An approach that ends before the platens have their speed would slow them down while they speed up.
    if (t.approach_strain <= start)
      report_problem({"test.approach_strain", "test.pre_strain", "test.ramp_strain"},
                     "above pre_strain + ramp_strain = " + print_number(start),
                     "the platens reach their speed there: leave the approach out, or let it go on farther");
    if (!t.kind->may_approach)
      report_problem({"test.approach_strain", "test.kind"}, "0 for this kind of test",
                     "leave approach_strain and approach_speed out");
  }

  void test_of_kind() {
    const TestRecipe& t = r_.test;
    // Two grips of a fifth leave the gauge free.
    if (5.0 * t.grip_thickness > r_.specimen.height)
      report_problem({"test.grip_thickness", "specimen.height"}, "at most a fifth of the height",
                     "strain is read over the middle 60 %, which the grips must not hold");
    if (t.kind->friction != &TestRecipe::platen_friction && t.platen_friction > 0.0)
      report_problem({"test.platen_friction", "test.kind"}, "0 for this kind of test",
                     "give test.jaw_friction");
    if (t.shear_gap > 0.5 * r_.specimen.height)
      report_problem({"test.shear_gap", "specimen.height"}, "at most half the height",
                     "the boxes have to hold something");
    // The stress grows with the dilation from a start; from none the box would lift first.
    if (t.normal_stiffness > 0.0 && t.normal_stress == 0.0)
      report_problem({"test.normal_stiffness", "test.normal_stress"}, "0 without normal_stress",
                     "give test.normal_stress, from which it grows");
    if (const KeptStress& kept = t.kind->kept_stress; kept.needed && t.*kept.value == 0.0)
      report_value({std::string("test.") + kept.key, "test.kind"}, "0", "above 0 for this kind of test",
                   "give the stress at the depth of the opening");
    if (t.pre_strain > 0.0 && !t.kind->may_pre_strain)
      report_problem({"test.pre_strain", "test.kind"}, "0 for this kind of test",
                     "only the uniaxial press can start loaded");
    if (cut().hole > 0.0) opening(cut().hole);
  }

  void opening(double diameter) {
    const TestRecipe& t = r_.test;
    const double least = min_opening * 2.0 * r_.packing.radius_max;
    if (diameter < least && has_own_grains())
      report_value(with({"test.opening_diameter"}, radii), length(diameter),
                   "at least two largest grain diameters, " + length(least),
                   "whole grains are taken out; use a larger opening, or smaller grains");
    if (2.0 * diameter > std::min(r_.specimen.width, r_.specimen.height))
      report_value(with({"test.opening_diameter"}, box), length(diameter), "at most half of the smaller side",
                   "the block is to stand for rock without an end: use a larger one");
    if (t.platen_friction > 0.0)
      report_problem({"test.platen_friction", "test.kind"}, "0 for this kind of test",
                     "walls with friction would hold the rock: leave it out");
    // Sides that follow the vertical stress by more than itself drive it: it would rise with no platen
    // moving.
    if (t.horizontal_stress > t.vertical_stress && t.vertical_stress > 0.0 && !r_.matrix.unbreakable)
      report_problem(
          {"test.horizontal_stress", "test.vertical_stress", "matrix.unbreakable"},
          "at most vertical_stress = " + print_quantity(t.vertical_stress, Dimension::pressure),
          "bottom and top load the rock until it fails: turn the block by 90 deg, that is exchange "
          "both stresses, and let layers lie at 90 deg - theta");
  }

  /// Rock that has to be left beside what is taken out of the middle [m].
  double ligament() const {
    return has_own_grains() ? min_ligament * (r_.packing.radius_min + r_.packing.radius_max) : 0.0;
  }
  std::string with_ligament(const std::string& expected) const {
    return has_own_grains()
               ? expected + ", five mean grain diameters, " + length(ligament()) + ", from its edge"
               : expected;
  }
  SpecimenCut cut() const {
    const auto of_test = r_.test.kind->cut;
    return of_test != nullptr ? of_test(r_) : SpecimenCut{};
  }
  /// What the middle of a specimen can have at all; false: there is a problem.
  bool may_be_pierced(const char* key) {
    if (cut().half || cut().hole > 0.0)
      return report_problem({key, "test.kind"}, "0 for this kind of test",
                            cut().half ? "half a disc has its notch" : "give test.opening_diameter"),
             false;
    const double least = min_opening * 2.0 * r_.packing.radius_max;
    if (find_field(recipe_fields(), key)->get(r_, 0) < least && has_own_grains())
      return report_problem(with({key}, radii),
                            "0, or at least two largest grain diameters, " + length(least),
                            "whole grains are taken out; use a larger one, or smaller grains"),
             false;
    return true;
  }
  void hole() {
    const SpecimenSize& s = r_.specimen;
    if (s.flaw_length > 0.0)
      report_problem({"specimen.flaw_length", "specimen.hole_diameter"}, "0 with a hole_diameter",
                     "a specimen has a hole or a flaw: leave one of them out");
    const char* const key = "specimen.hole_diameter";
    if (!may_be_pierced(key)) return;
    const double disc = cut().diameter, side = disc > 0.0 ? disc : std::min(s.width, s.height);
    if (s.hole_diameter >= side || s.hole_diameter > side - 2.0 * ligament())
      report_problem(
          with(with({key}, box), {"test.disc_diameter", "packing.radius_min", "packing.radius_max"}),
          with_ligament("within the specimen"), "use a smaller hole or a larger specimen");
  }
  void flaw() {
    const SpecimenSize& s = r_.specimen;
    const char* const key = "specimen.flaw_length";
    if (s.flaw_length == 0.0) {
      for (const char* of_a_flaw : {"specimen.flaw_angle", "specimen.flaw_width"})
        if (find_field(recipe_fields(), of_a_flaw)->get(r_, 0) != 0.0)
          report_problem({of_a_flaw, key}, "0 without a flaw", "give specimen.flaw_length");
      return;
    }
    flaw_width();
    if (!may_be_pierced(key)) return;
    const SinCos a = sin_cos_degrees(s.flaw_angle);
    const double L = s.flaw_length,
                 w = std::max(s.flaw_width, has_own_grains() ? 2.0 * r_.packing.radius_max : 0.0);
    // Its corners decide, of a disc by their distance from the middle.
    const double across = L * std::fabs(a.cos) + w * a.sin, up = L * a.sin + w * std::fabs(a.cos);
    const double disc = cut().diameter, least = 2.0 * ligament();
    const bool inside =
        disc > 0.0 ? std::hypot(L, w) < disc - least : across < s.width - least && up < s.height - least;
    if (!inside)
      report_problem(
          with(with({key, "specimen.flaw_angle", "specimen.flaw_width", "test.disc_diameter"}, box),
               {"packing.radius_min", "packing.radius_max"}),
          with_ligament("within the specimen"), "use a shorter flaw or a larger specimen");
  }
  void flaw_width() {
    const SpecimenSize& s = r_.specimen;
    const double grain = 2.0 * r_.packing.radius_max;
    if (s.flaw_width > 0.0 && s.flaw_width < grain && has_own_grains())
      report_problem({"specimen.flaw_width", "packing.radius_max", "packing.file"},
                     "0, or at least the largest grain diameter, " + length(grain),
                     "grains would touch across it: leave it out, or use smaller grains");
    if (s.flaw_width > s.flaw_length)
      report_problem({"specimen.flaw_width", "specimen.flaw_length"},
                     "at most flaw_length = " + length(s.flaw_length), "the longer side is its length");
  }

  /// Discs and half discs, whose notch is sawn.
  void cut_specimen(const SpecimenCut& cut) {
    const TestRecipe& t = r_.test;
    // Half a disc needs its diameter across, and only its radius in height.
    const double side = std::min(r_.specimen.width, (cut.half ? 2.0 : 1.0) * r_.specimen.height);
    const double least = min_grains_across * (r_.packing.radius_min + r_.packing.radius_max);
    if (t.disc_diameter > side)
      report_problem(with({"test.disc_diameter"}, box),
                     (cut.half ? "at most the width and twice the height, " : "at most the smaller side, ") +
                         length(side),
                     cut.half ? "half a disc is cut from the packing; use a larger specimen"
                              : "a disc is cut from the packing; use a larger specimen");
    // What holds for the sides of a specimen holds for the disc that is pressed.
    else if (t.disc_diameter > 0.0 && t.disc_diameter < least && has_own_grains())
      report_problem(with({"test.disc_diameter"}, radii),
                     "at least ten mean grain diameters, " + length(least),
                     "use a larger disc or smaller grains");
    // The notch is sawn out of grains: thinner than one it would take none out and be no notch.
    const double grain = 2.0 * r_.packing.radius_max, widest = widest_notch * cut.diameter;
    if (cut.notch_width > 0.0 && cut.notch_width < grain && has_own_grains())
      report_value({"test.notch_width", "packing.radius_max", "packing.file"}, length(cut.notch_width),
                   "0, or at least the largest grain diameter, " + length(grain),
                   "whole grains are taken out; leave it out, or use smaller grains");
    if (cut.notch_width > widest)
      report_value(with({"test.notch_width", "test.disc_diameter"}, box), length(cut.notch_width),
                   "at most a twentieth of the diameter, " + length(widest),
                   "the formula of the test holds for a crack; saw a thinner notch");
  }
};

}  // namespace

std::vector<Problem> cross_checks(const Recipe& r,
                                  const std::function<std::string(const std::string&)>& where,
                                  const std::function<bool(const std::string&)>& is_known) {
  return CrossChecks(r, where, is_known).run();
}

}  // namespace phy
