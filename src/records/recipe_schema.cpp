#include "records/recipe_schema.hpp"

#include <algorithm>
#include <utility>

#include "base/quote.hpp"
#include "records/test_description.hpp"

namespace phy {
namespace {

// Laws have no length of their own but the grain's: specimens are as large as anybody tests, or models.
constexpr double longest = 1000.0;       // [m]
constexpr double largest_grain = 100.0;  // [m]

/// The part of a recipe that a table of the file stands for; for reading and for writing.
constexpr auto specimen_of = [](auto& r, std::size_t) -> auto& { return r.specimen; };
constexpr auto packing_of = [](auto& r, std::size_t) -> auto& { return r.packing; };
constexpr auto matrix_of = [](auto& r, std::size_t) -> auto& { return r.matrix; };
constexpr auto bedding_of = [](auto& r, std::size_t i) -> auto& { return r.bedding[i]; };
constexpr auto test_of = [](auto& r, std::size_t) -> auto& { return r.test; };
constexpr auto engine_of = [](auto& r, std::size_t) -> auto& { return r.engine; };

template <class T>
double as_number(const T& value) {
  return static_cast<double>(value);
}
/// The laboratory test, as its place in the list.
double as_number(const TestKind& kind) {
  // All numbers of a field travel as double, so a kind of test is its place in the list.
  const auto tests = laboratory_tests();
  return static_cast<double>(std::find(tests.begin(), tests.end(), &*kind) - tests.begin());
}
template <class T>
void assign(T& to, double value) {
  to = static_cast<T>(value);
}
void assign(TestKind& to, double value) { to = *laboratory_tests()[static_cast<std::size_t>(value)]; }

struct Range {
  double min, max;
  Dimension dimension = Dimension::none;
};

/// One table of the file; one call per key.
template <class Part>
class Table {
 public:
  Table(Fields& fields, const char* name, Part part) : fields_(fields), name_(name), part_(part) {}

  template <class Member>
  Field& quantity(const char* key, Range range, const char* pfc, const char* meaning, Member member) {
    Field& f = add(FieldKind::quantity, key, range, meaning, member);
    f.pfc_name = pfc;
    return f;
  }
  template <class Member>
  Field& number(const char* key, Range range, const char* pfc, const char* meaning, Member member) {
    Field& f = add(FieldKind::number, key, range, meaning, member);
    f.pfc_name = pfc;
    return f;
  }
  template <class Member>
  Field& integer(const char* key, Range range, const char* meaning, Member member) {
    return add(FieldKind::integer, key, range, meaning, member);
  }
  template <class Member>
  Field& boolean(const char* key, const char* meaning, Member member) {
    return add(FieldKind::boolean, key, {0, 1}, meaning, member);
  }
  template <class Member>
  Field& choice(const char* key, std::vector<std::string> names, const char* meaning, Member member) {
    Field& f = add(FieldKind::choice, key, {0, unbounded}, meaning, member);
    f.choices = std::move(names);
    return f;
  }

 private:
  Fields& fields_;
  const char* name_;
  Part part_;

  template <class Member>
  Field& add(FieldKind kind, const char* key, Range range, const char* meaning, Member member) {
    Field f = make_field(kind, name_, key, meaning);
    f.dimension = range.dimension, f.min = range.min, f.max = range.max;
    // One pair of functions from one pointer to member: a key cannot be read from one number and written to
    // another.
    f.get = [part = part_, member](const Recipe& r, std::size_t i) { return as_number(part(r, i).*member); };
    f.set = [part = part_, member](Recipe& r, std::size_t i, double v) { assign(part(r, i).*member, v); };
    fields_.push_back(std::move(f));
    return fields_.back();
  }
};

void add_specimen(Fields& fields) {
  Table t(fields, "specimen", specimen_of);
  t.quantity("width", {1e-4, longest, Dimension::length}, "", "width of the specimen", &SpecimenSize::width);
  t.quantity("height", {1e-4, longest, Dimension::length}, "", "height of the specimen, along the load",
             &SpecimenSize::height);
  t.quantity("hole_diameter", {0, longest, Dimension::length}, "",
             "circular hole in the middle; 0: none; not of semi_circular_bend and opening",
             &SpecimenSize::hole_diameter)
      .omit_default = true;
  t.quantity("flaw_length", {0, longest, Dimension::length}, "",
             "open flaw in the middle, in place of a hole; 0: none; not of semi_circular_bend and opening",
             &SpecimenSize::flaw_length)
      .omit_default = true;
  Field& angle =
      t.quantity("flaw_angle", {0, 180, Dimension::angle}, "",
                 "flaw from +x, anticlockwise; it does not turn with test.angles", &SpecimenSize::flaw_angle);
  angle.below_max = angle.omit_default = true;
  t.quantity("flaw_width", {0, largest_grain, Dimension::length}, "",
             "width of the flaw; 0: the largest grain diameter", &SpecimenSize::flaw_width)
      .omit_default = true;
}

void add_packing(Fields& fields) {
  Table t(fields, "packing", packing_of);
  using P = PackingRecipe;
  t.quantity("radius_min", {1e-6, largest_grain, Dimension::length}, "ball radius", "smallest grain radius",
             &P::radius_min);
  t.quantity("radius_max", {1e-6, largest_grain, Dimension::length}, "ball radius", "largest grain radius",
             &P::radius_max);
  t.choice("distribution", {"number", "area"}, "radii uniform by number of grains, or by area fraction",
           &P::distribution);
  t.integer("n_grains", {0, static_cast<double>(max_recipe_grains)},
            "number of grains, at least 16; 0: follows from porosity", &P::n_grains);
  t.number("porosity", {0, 0.4}, "", "area not covered by grains at generation; 0: follows from n_grains",
           &P::porosity)
      .below_max = true;
  t.choice("initial_stress", {"stress_free", "isotropic"},
           "present overlaps count as stress-free, or a small isotropic stress is locked in",
           &P::initial_stress);
  t.quantity("isotropic_stress", {0, 1e9, Dimension::pressure}, "", "the locked-in stress, with isotropic",
             &P::isotropic_stress);
  t.integer("seed", {0, 4294967295.0}, "seed of radii and positions", &P::seed);
  Field f;
  f.kind = FieldKind::text, f.table = "packing", f.key = "file";
  f.meaning =
      "CSV of discs to import instead of making a packing (from the recipe's folder); empty: make one";
  f.get_text = [](const Recipe& r) { return r.packing.file; };
  f.set_text = [](Recipe& r, const std::string& s) { r.packing.file = s; };
  fields.push_back(f);
}

void add_matrix(Fields& fields) {
  Table t(fields, "matrix", matrix_of);
  using M = MatrixRecipe;
  const auto stress = Dimension::pressure;
  t.choice("model", {"parallel_bond", "flat_joint"},
           "what holds grains together: linear contact and parallel bond, or an interface of elements",
           &M::model)
      .omit_default = true;
  t.quantity("density", {1, 1e5, Dimension::density}, "density", "density of the grains", &M::density);
  t.choice("stiffness_convention", {"pfc31", "pfc5"},
           "contact stiffness from E_c: pfc31: k_n = E_c t; pfc5: k_n = 2 r_min t E_c/(R1 + R2)",
           &M::stiffness_convention);
  t.quantity("E_c", {1e3, 1e13, stress}, "emod, E_c, fj_emod",
             "contact modulus of the grains; of flat joints", &M::E_c);
  t.number("ks_over_kn", {1e-3, 10}, "1/kratio, 1/fj_kratio", "shear over normal stiffness of contacts",
           &M::ks_over_kn);
  t.number("mu", {0, 10}, "fric, fj_fric", "friction coefficient of contacts", &M::mu);
  t.quantity("E_b", {1e3, 1e13, stress}, "pb_emod", "modulus of the parallel bonds", &M::E_b);
  t.number("bond_ks_over_kn", {1e-3, 10}, "1/pb_kratio", "shear over normal stiffness of bonds",
           &M::bond_ks_over_kn);
  t.number("radius_multiplier", {0.01, 1}, "pb_rmul, fj_rmul", "bond radius over the smaller grain radius",
           &M::radius_multiplier);
  t.number("moment_contribution", {0, 1}, "pb_mcf", "share of the moment in the bond's largest tension",
           &M::moment_contribution);
  t.choice("shear_strength", {"constant", "cohesion_friction"},
           "constant tau_c (Potyondy & Cundall 2004), or tau_c + sigma tan(phi)", &M::shear_strength);
  t.quantity("sigma_c", {1, 1e13, stress}, "pb_ten, fj_ten", "tensile strength of bonds, mean", &M::sigma_c);
  t.quantity("sigma_c_sd", {0, 1e13, stress}, "", "standard deviation of sigma_c", &M::sigma_c_sd);
  t.quantity("tau_c", {1, 1e13, stress}, "pb_coh, fj_coh", "shear strength (cohesion) of bonds, mean",
             &M::tau_c);
  t.quantity("tau_c_sd", {0, 1e13, stress}, "", "standard deviation of tau_c", &M::tau_c_sd);
  t.quantity("phi", {0, 80, Dimension::angle}, "pb_fa, fj_fa",
             "friction angle of bonds, with cohesion_friction", &M::phi);
  t.quantity("bond_gap", {0, largest_grain, Dimension::length}, "gap",
             "bonds at gaps up to this length; 0: where discs touch (gaps below 1e-6 of their mean radius)",
             &M::bond_gap);
  t.number("unbonded_fraction", {0, 0.9}, "",
           "share of these contacts that get no bond (linear contact only; of flat joints: a slit)",
           &M::unbonded_fraction)
      .omit_default = true;
  t.integer("bond_seed", {0, 4294967295.0}, "seed of the bond strengths", &M::bond_seed);
  t.boolean("unbreakable", "true: nothing breaks and nothing slips (elastic comparison)", &M::unbreakable);
}

/// Directions of the matrix.
void add_directions(Fields& fields) {
  Table t(fields, "matrix", matrix_of);
  using M = MatrixRecipe;
  const auto ratio = [&](const char* key, const char* meaning, double M::*member) {
    t.number(key, {0.05, 20}, "", meaning, member).omit_default = true;
  };
  Field& foliation =
      t.quantity("foliation", {0, 180, Dimension::angle}, "180 - dip",
                 "inclination of the matrix's own layers, which the ratios below refer to", &M::foliation);
  foliation.below_max = foliation.omit_default = true;
  ratio("stiffness_ratio",
        "E_c and E_b of contacts with the normal along the foliation over those across it; the mean stays",
        &M::stiffness_ratio);
  ratio("tension_ratio", "the same of sigma_c; above 1 the layers part easily", &M::tension_ratio);
  ratio("cohesion_ratio", "the same of tau_c", &M::cohesion_ratio);
  ratio("cohesion_oblique",
        "tau_c of contacts at 45 deg to the foliation over those along and across it; the mean stays",
        &M::cohesion_oblique);
}

void add_flat_joint(Fields& fields) {
  Table t(fields, "matrix", matrix_of);
  using M = MatrixRecipe;
  Field& elements =
      t.integer("elements", {1, 4}, "flat_joint: elements that an interface breaks in; a strength parameter",
                &M::elements);
  elements.pfc_name = "fj_nr", elements.omit_default = true;
  t.choice("break_at", {"centroid", "edge"},
           "flat_joint: where in an element the tension is compared with sigma_c (PFC: centroid)",
           &M::break_at)
      .omit_default = true;
  t.number("gapped_fraction", {0, 0.9}, "",
           "flat_joint: share of contacts that get no bond and start initial_gap apart", &M::gapped_fraction)
      .omit_default = true;
  t.quantity("initial_gap", {0, largest_grain, Dimension::length}, "fj_gap0",
             "flat_joint: gap of these interfaces at the start", &M::initial_gap)
      .omit_default = true;
}

/// Where the planes of a set are.
void add_planes(Fields& fields) {
  Table t(fields, "bedding", bedding_of);
  using B = BeddingRecipe;
  t.quantity("theta", {0, 180, Dimension::angle}, "180 - dip", "plane from +x, anticlockwise; load along y",
             &B::theta)
      .below_max = true;
  t.quantity("theta_sd", {0, 10, Dimension::angle}, "",
             "standard deviation of theta from plane to plane; not with oriented", &B::theta_sd)
      .omit_default = true;
  t.quantity("spacing", {1e-6, longest, Dimension::length}, "",
             "distance of the planes of the set, mean; not with oriented", &B::spacing);
  t.number("spacing_sd", {0, 0.3}, "",
           "standard deviation of the spacing, over the spacing; not with oriented", &B::spacing_sd)
      .omit_default = true;
  t.quantity("zone_thickness", {0, longest, Dimension::length}, "",
             "thickness d of the zone, used by the zone rule", &B::zone_thickness)
      .above_min = true;
  t.quantity("offset", {-longest, longest, Dimension::length}, "",
             "distance of one plane from the specimen's centre; not with oriented", &B::offset);
}

/// Which contacts are its joints.
void add_rule(Fields& fields) {
  Table t(fields, "bedding", bedding_of);
  using B = BeddingRecipe;
  t.choice(
      "rule", {"crossing", "zone", "oriented"},
      "contacts that become joints: centres on two sides of a plane, point within the zone, or normal near "
      "the set's",
      &B::rule);
  t.boolean(
       "bridges",
       "zone rule: contacts that cross a plane outside the zone stay bonded; false: they are joints, too",
       &B::bridges)
      .omit_default = true;
  Field& range =
      t.quantity("orientation_range", {0, 90, Dimension::angle}, "",
                 "oriented rule: largest angle between the normals of a joint's contact and of the set",
                 &B::orientation_range);
  range.above_min = range.omit_default = true;
  Field& share =
      t.number("persistence", {0, 1}, "",
               "share of the planes that is jointed, the rest stays bonded (rock bridges); 0: layers without "
               "joints; not with oriented",
               &B::persistence);
  share.omit_default = true;
  t.quantity(
       "patch_length", {0, longest, Dimension::length}, "",
       "with persistence below 1: length of the patches that are jointed or bonded; 0: contact by contact; "
       "not with oriented",
       &B::patch_length)
      .omit_default = true;
  t.quantity("layer_thickness", {0, longest, Dimension::length}, "",
             "thickness of a layer about each plane whose matrix differs; 0: none; not with oriented",
             &B::layer_thickness)
      .omit_default = true;
  t.number("layer_stiffness", {0.01, 100}, "", "E_c and E_b in the layers over the matrix's",
           &B::layer_stiffness)
      .omit_default = true;
  t.number("layer_strength", {0.01, 100}, "", "sigma_c and tau_c in the layers over the matrix's",
           &B::layer_strength)
      .omit_default = true;
}

/// The joints of a set.
void add_joints(Fields& fields) {
  Table t(fields, "bedding", bedding_of);
  using B = BeddingRecipe;
  t.quantity("k_n", {1e3, 1e18, Dimension::stiffness}, "sj_kn", "normal stiffness of the joints", &B::k_n);
  t.quantity("k_s", {1e3, 1e18, Dimension::stiffness}, "sj_ks", "shear stiffness of the joints", &B::k_s);
  t.number("mu", {0, 10}, "sj_fric", "friction coefficient of broken joints", &B::mu);
  t.quantity("sigma_n", {1, 1e13, Dimension::pressure}, "sj_ten", "tensile strength of bonded joints, mean",
             &B::sigma_n);
  t.quantity("sigma_n_sd", {0, 1e13, Dimension::pressure}, "", "standard deviation of sigma_n",
             &B::sigma_n_sd)
      .omit_default = true;
  t.quantity("cohesion", {1, 1e13, Dimension::pressure}, "sj_coh", "cohesion of bonded joints", &B::cohesion);
  t.quantity("phi", {0, 80, Dimension::angle}, "sj_fa", "friction angle of bonded joints", &B::phi);
  t.quantity("psi", {0, 80, Dimension::angle}, "sj_da", "dilation angle; tan(psi) <= mu", &B::psi);
  t.number("radius_multiplier", {0.01, 1}, "sj_rmul", "joint radius over the smaller grain radius",
           &B::radius_multiplier);
}

/// Of the semi-circular bend test; ranges are those of the published factor.
void add_bend(Fields& fields) {
  Table t(fields, "test", test_of);
  using T = TestRecipe;
  const char* const bend = "semi_circular_bend";
  t.number("notch_ratio", {0.4, 0.6}, "", "semi_circular_bend: length of the notch over the radius",
           &T::notch_ratio)
      .of_tests({bend})
      .test = bend;
  t.quantity("notch_width", {0, largest_grain, Dimension::length}, "",
             "semi_circular_bend: width of the notch; 0: the largest grain diameter", &T::notch_width)
      .of_tests({bend})
      .test = bend;
  t.number("span_ratio", {0.5, 0.8}, "",
           "semi_circular_bend: distance of the support rollers over the diameter", &T::span_ratio)
      .of_tests({bend})
      .test = bend;
}

/// Of an opening under stress.
void add_opening(Fields& fields) {
  Table t(fields, "test", test_of);
  using T = TestRecipe;
  const char* const opening = "opening";
  t.quantity("opening_diameter", {0, longest, Dimension::length}, "",
             "opening: its diameter; 0: a fifth of the smaller side of the block", &T::opening_diameter)
      .of_tests({opening})
      .test = opening;
  t.quantity("vertical_stress", {0, 1e10, Dimension::pressure}, "", "opening: vertical far-field stress",
             &T::vertical_stress)
      .of_tests({opening})
      .test = opening;
  t.quantity("horizontal_stress", {0, 1e10, Dimension::pressure}, "",
             "opening: horizontal far-field stress; 0: as the vertical one", &T::horizontal_stress)
      .of_tests({opening})
      .test = opening;
  t.quantity("internal_pressure", {0, 1e10, Dimension::pressure}, "",
             "opening: pressure on its wall, of mud or of a support", &T::internal_pressure)
      .of_tests({opening})
      .test = opening;
}

std::vector<std::string> names_of_tests() {
  std::vector<std::string> names;
  for (const TestDescription* test : laboratory_tests()) names.emplace_back(test->name);
  return names;
}

void add_test(Fields& fields) {
  Table t(fields, "test", test_of);
  using T = TestRecipe;
  t.choice("kind", names_of_tests(), "laboratory test", &T::kind);
  Field f;
  f.kind = FieldKind::quantities, f.table = "test", f.key = "angles", f.dimension = Dimension::angle;
  // A plane is the same after half a turn: 180 would be 0 a second time.
  f.min = 0, f.max = 180, f.below_max = true;
  f.meaning = "one specimen per angle, turning the bedding so that the first set has it; empty: as it stands";
  f.list = [](Recipe& r) -> std::vector<double>& { return r.test.angles; };
  fields.push_back(f);
  t.boolean("intact", "also a specimen without bedding", &T::intact);
  t.quantity("platen_speed", {1e-6, 10, Dimension::speed}, "", "speed of each platen", &T::platen_speed);
  t.number("approach_strain", {0, 0.1}, "",
           "strain, as of max_strain, up to which the platens move at approach_speed; 0: none; not of "
           "direct_shear",
           &T::approach_strain);
  t.quantity("approach_speed", {0, 10, Dimension::speed}, "",
             "speed of each platen up to approach_strain, at least platen_speed", &T::approach_speed);
  t.number("ramp_strain", {0, 0.01}, "",
           "axial strain while the speed rises from 0, or falls to platen_speed (direct_shear: displacement "
           "over width)",
           &T::ramp_strain);
  t.number("platen_friction", {0, 10}, "wall fric", "friction coefficient of the platens; not of brazilian",
           &T::platen_friction);
  // Not 1: a test that ends at its peak never shows that it was one.
  t.number("stop_at", {0, 0.99}, "", "the test ends when the stress falls to this fraction of the peak",
           &T::stop_at);
  t.number("post_peak", {0, 10}, "",
           "the test ends when the strain exceeds the peak's by this fraction; 0: no such limit",
           &T::post_peak);
  t.number("max_strain", {1e-5, 0.2}, "",
           "the test ends at this axial strain at the latest (direct_shear: displacement over width)",
           &T::max_strain);
  t.integer("history_interval", {10, 10000}, "steps between history rows, and between all checks",
            &T::history_interval);
  t.integer("n_snapshots", {0, 200},
            "stored states of grains and contacts (up to twice as many); 0: only the last", &T::n_snapshots);
  t.integer("n_frames", {0, 1000},
            "stored displacement fields for the specimen viewer (up to twice as many); 0: only the last",
            &T::n_frames);
  t.boolean("events", "acoustic events: clusters of cracks with moment tensor and magnitude", &T::events)
      .omit_default = true;
  t.quantity(
       "event_thickness", {0, longest, Dimension::length}, "",
       "events: thickness of the specimen that moments and magnitudes are of; 0: the mean grain diameter",
       &T::event_thickness)
      .omit_default = true;
  t.number("pre_strain", {0, 0.05}, "", "axial strain of the affine pre-strain; 0: none", &T::pre_strain);
  t.quantity("grip_thickness", {0, longest, Dimension::length}, "",
             "direct_tension: rock held at each end; 0: four times the largest radius", &T::grip_thickness)
      .of_tests({"direct_tension"});
  t.quantity("disc_diameter", {0, longest, Dimension::length}, "",
             "brazilian: disc cut from the specimen; semi_circular_bend: half disc; 0: the largest it holds",
             &T::disc_diameter)
      .of_tests({"brazilian", "semi_circular_bend"});
  t.quantity("loading_angle", {0, 30, Dimension::angle}, "",
             "brazilian: arc of the rim that each jaw holds; 0: flat platens", &T::loading_angle)
      .of_tests({"brazilian"});
  t.number(
       "jaw_friction", {0, 10}, "wall fric",
       "brazilian: friction coefficient between disc and jaws; without it a coarse disc may roll out of them",
       &T::jaw_friction)
      .of_tests({"brazilian"})
      .test = "brazilian";
  t.quantity("confining_stress", {0, 1e10, Dimension::pressure}, "", "biaxial: lateral stress",
             &T::confining_stress)
      .of_tests({"biaxial"});
  t.choice("confinement", {"walls", "jacket"},
           "biaxial: sides are rigid walls that press with the confining stress, or a pressure on the side "
           "grains",
           &T::confinement)
      .of_tests({"biaxial"});
  t.quantity("normal_stress", {0, 1e10, Dimension::pressure}, "", "direct_shear: stress on the plane",
             &T::normal_stress)
      .of_tests({"direct_shear"});
  t.quantity("normal_stiffness", {0, 1e15, Dimension::stiffness}, "",
             "direct_shear: growth of the normal stress with dilation; 0: constant normal load",
             &T::normal_stiffness)
      .of_tests({"direct_shear"});
  t.quantity("shear_gap", {0, longest, Dimension::length}, "",
             "direct_shear: free rock between the two boxes; 0: rigid halves", &T::shear_gap)
      .of_tests({"direct_shear"});
  add_bend(fields);
  add_opening(fields);
}

void add_engine(Fields& fields) {
  Table t(fields, "engine", engine_of);
  using E = EngineRecipe;
  t.choice("precision", {"double", "float"}, "numbers of the force loop", &E::precision);
  t.number("damping", {0, 0.95}, "damp", "local damping coefficient alpha", &E::damping);
  t.number("step_safety", {0.01, 1}, "safety-factor", "fraction of the stable time step", &E::step_safety);
  t.choice("grain_inertia", {"disc", "equal"},
           "mass in the dynamics: each grain its own, or all the mean mass, whose time step is longer",
           &E::grain_inertia);
}

/// With the default of every key, as in a file.
Fields with_defaults(Fields fields) {
  // Defaults are those of the structures themselves, and are written nowhere a second time.
  Recipe usual;
  // A recipe without bedding has no defaults of bedding to read.
  usual.bedding.resize(1);
  for (Field& f : fields) f.default_text = print_field(f, usual, 0);
  return fields;
}

}  // namespace

const Fields& recipe_fields() {
  static const Fields fields = [] {
    Fields all;
    Field name;
    name.kind = FieldKind::text, name.key = "name",
    name.meaning = "name of the recipe, printed with the results";
    name.get_text = [](const Recipe& r) { return r.name; };
    name.set_text = [](Recipe& r, const std::string& s) { r.name = s; };
    all.push_back(name);
    for (const auto add : {add_specimen, add_packing, add_matrix, add_flat_joint, add_directions, add_planes,
                           add_rule, add_joints, add_test, add_engine})
      add(all);
    return with_defaults(std::move(all));
  }();
  return fields;
}

bool is_written(const Field& f, const Recipe& recipe, std::size_t index) {
  // A key of another test has no effect: recipes that differ in it alone are one test, with one fingerprint.
  if (!f.test.empty() && f.test != recipe.test.kind->name) return false;
  const bool dispersed = f.table == "bedding" && !recipe.bedding[index].has_planes();
  if (dispersed && (f.key == "spacing" || f.key == "offset")) return false;
  if (dispersed && f.key == "orientation_range") return true;  // what its joints are goes by it
  const bool of_parallel_bonds =
      f.table == "matrix" && (f.key == "stiffness_convention" || f.key == "E_b" ||
                              f.key == "bond_ks_over_kn" || f.key == "moment_contribution");
  // Flat joints have no such numbers: written, they would look as if they had an effect.
  if (of_parallel_bonds && recipe.matrix.model != MatrixModel::parallel_bond) return false;
  return !f.omit_default || print_field(f, recipe, index) != f.default_text;
}

std::string print_field(const Field& f, const Recipe& recipe, std::size_t index) {
  switch (f.kind) {
    case FieldKind::text: return toml_string(f.get_text(recipe));
    case FieldKind::boolean: return f.get(recipe, index) != 0.0 ? "true" : "false";
    case FieldKind::choice: return toml_string(f.choices[static_cast<std::size_t>(f.get(recipe, index))]);
    case FieldKind::integer: return std::to_string(static_cast<std::int64_t>(f.get(recipe, index)));
    case FieldKind::number: return print_number(f.get(recipe, index));
    case FieldKind::quantity: return toml_string(print_quantity(f.get(recipe, index), f.dimension));
    default: {
      // The list is handed out to be changed, and the recipe is not to be.
      Recipe copy = recipe;
      std::vector<std::string> values;
      for (const double v : f.list(copy))
        values.push_back(f.dimension == Dimension::none ? print_number(v)
                                                        : toml_string(print_quantity(v, f.dimension)));
      return toml_list(values);
    }
  }
}

std::string keys_not_by_default(const Recipe& r) {
  std::string text = std::to_string(r.bedding.size()) + " sets of bedding\n";
  for (const Field& f : recipe_fields()) {
    const bool of_set = f.table == "bedding";
    for (std::size_t i = 0; i < (of_set ? r.bedding.size() : 1); ++i) {
      const std::string value = print_field(f, r, i);
      // A key that comes later stands at its default in all older recipes, and leaves their fingerprints
      // alone.
      if (value == f.default_text || !is_written(f, r, i)) continue;
      text += of_set ? "bedding[" + std::to_string(i) + "]." + f.key : f.path();
      text += " = " + value + "\n";
    }
  }
  return text;
}

}  // namespace phy
