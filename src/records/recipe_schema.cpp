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

/// Access to a member of one of the recipe's tables.
template <class Part, class T>
void bind(Field& f, Part Recipe::*part, T Part::*member) {
  f.get = [=](const Recipe& r, std::size_t) { return static_cast<double>((r.*part).*member); };
  f.set = [=](Recipe& r, std::size_t, double v) { (r.*part).*member = static_cast<T>(v); };
}
/// The laboratory test, as its place in the list.
void bind(Field& f, TestRecipe Recipe::*part, TestKind TestRecipe::*member) {
  f.get = [=](const Recipe& r, std::size_t) {
    const auto tests = laboratory_tests();
    return static_cast<double>(std::find(tests.begin(), tests.end(), &*((r.*part).*member)) - tests.begin());
  };
  f.set = [=](Recipe& r, std::size_t, double v) {
    (r.*part).*member = *laboratory_tests()[static_cast<std::size_t>(v)];
  };
}
template <class T>
void bind(Field& f, T BeddingRecipe::*member) {
  f.get = [=](const Recipe& r, std::size_t i) { return static_cast<double>(r.bedding[i].*member); };
  f.set = [=](Recipe& r, std::size_t i, double v) { r.bedding[i].*member = static_cast<T>(v); };
}

/// Builds the list; one call per key.
class List {
 public:
  Fields fields;

  template <class... Access>
  Field& quantity(const char* table, const char* key, Dimension d, double min, double max, const char* pfc,
                  const char* meaning, Access... access) {
    return add(FieldKind::quantity, table, key, d, min, max, pfc, meaning, access...);
  }
  template <class... Access>
  Field& number(const char* table, const char* key, double min, double max, const char* pfc,
                const char* meaning, Access... access) {
    return add(FieldKind::number, table, key, Dimension::none, min, max, pfc, meaning, access...);
  }
  template <class... Access>
  Field& integer(const char* table, const char* key, double min, double max, const char* meaning,
                 Access... access) {
    return add(FieldKind::integer, table, key, Dimension::none, min, max, "", meaning, access...);
  }
  template <class... Access>
  Field& boolean(const char* table, const char* key, const char* meaning, Access... access) {
    return add(FieldKind::boolean, table, key, Dimension::none, 0, 1, "", meaning, access...);
  }
  template <class... Access>
  Field& choice(const char* table, const char* key, std::vector<std::string> names, const char* meaning,
                Access... access) {
    Field& f = add(FieldKind::choice, table, key, Dimension::none, 0, unbounded, "", meaning, access...);
    f.choices = std::move(names);
    return f;
  }

 private:
  template <class... Access>
  Field& add(FieldKind kind, const char* table, const char* key, Dimension d, double min, double max,
             const char* pfc, const char* meaning, Access... access) {
    Field f;
    f.kind = kind, f.table = table, f.key = key, f.dimension = d, f.min = min, f.max = max;
    f.pfc_name = pfc, f.meaning = meaning;
    bind(f, access...);
    fields.push_back(std::move(f));
    return fields.back();
  }
};

void add_specimen(List& l) {
  l.quantity("specimen", "width", Dimension::length, 1e-4, longest, "", "width of the specimen",
             &Recipe::specimen, &SpecimenSize::width);
  l.quantity("specimen", "height", Dimension::length, 1e-4, longest, "",
             "height of the specimen, along the load", &Recipe::specimen, &SpecimenSize::height);
}

void add_packing(List& l) {
  using P = PackingRecipe;
  constexpr auto part = &Recipe::packing;
  l.quantity("packing", "radius_min", Dimension::length, 1e-6, largest_grain, "ball radius",
             "smallest grain radius", part, &P::radius_min);
  l.quantity("packing", "radius_max", Dimension::length, 1e-6, largest_grain, "ball radius",
             "largest grain radius", part, &P::radius_max);
  l.choice("packing", "distribution", {"number", "area"},
           "radii uniform by number of grains, or by area fraction", part, &P::distribution);
  l.integer("packing", "n_grains", 0, static_cast<double>(max_recipe_grains),
            "number of grains, at least 16; 0: follows from porosity", part, &P::n_grains);
  l.number("packing", "porosity", 0, 0.4, "",
           "area not covered by grains at generation; 0: follows from n_grains", part, &P::porosity)
      .below_max = true;
  l.choice("packing", "initial_stress", {"stress_free", "isotropic"},
           "present overlaps count as stress-free, or a small isotropic stress is locked in", part,
           &P::initial_stress);
  l.quantity("packing", "isotropic_stress", Dimension::pressure, 0, 1e9, "",
             "the locked-in stress, with isotropic", part, &P::isotropic_stress);
  l.integer("packing", "seed", 0, 4294967295.0, "seed of radii and positions", part, &P::seed);
  Field f;
  f.kind = FieldKind::text, f.table = "packing", f.key = "file";
  f.meaning =
      "CSV of discs to import instead of making a packing (from the recipe's folder); empty: make one";
  f.get_text = [](const Recipe& r) { return r.packing.file; };
  f.set_text = [](Recipe& r, const std::string& s) { r.packing.file = s; };
  l.fields.push_back(f);
}

void add_matrix(List& l) {
  using M = MatrixRecipe;
  constexpr auto part = &Recipe::matrix;
  const auto stress = Dimension::pressure;
  l.choice("matrix", "model", {"parallel_bond", "flat_joint"},
           "what holds grains together: linear contact and parallel bond, or an interface of elements", part,
           &M::model)
      .quiet = true;
  l.quantity("matrix", "density", Dimension::density, 1, 1e5, "density", "density of the grains", part,
             &M::density);
  l.choice("matrix", "stiffness_convention", {"pfc31", "pfc5"},
           "contact stiffness from E_c: pfc31: k_n = E_c t; pfc5: k_n = 2 r_min t E_c/(R1 + R2)", part,
           &M::stiffness_convention);
  l.quantity("matrix", "E_c", stress, 1e3, 1e13, "emod, E_c, fj_emod",
             "contact modulus of the grains; of flat joints", part, &M::E_c);
  l.number("matrix", "ks_over_kn", 1e-3, 10, "1/kratio, 1/fj_kratio",
           "shear over normal stiffness of contacts", part, &M::ks_over_kn);
  l.number("matrix", "mu", 0, 10, "fric, fj_fric", "friction coefficient of contacts", part, &M::mu);
  l.quantity("matrix", "E_b", stress, 1e3, 1e13, "pb_emod", "modulus of the parallel bonds", part, &M::E_b);
  l.number("matrix", "bond_ks_over_kn", 1e-3, 10, "1/pb_kratio", "shear over normal stiffness of bonds", part,
           &M::bond_ks_over_kn);
  l.number("matrix", "radius_multiplier", 0.01, 1, "pb_rmul, fj_rmul",
           "bond radius over the smaller grain radius", part, &M::radius_multiplier);
  l.number("matrix", "moment_contribution", 0, 1, "pb_mcf",
           "share of the moment in the bond's largest tension", part, &M::moment_contribution);
  l.choice("matrix", "shear_strength", {"constant", "cohesion_friction"},
           "constant tau_c (Potyondy & Cundall 2004), or tau_c + sigma tan(phi)", part, &M::shear_strength);
  l.quantity("matrix", "sigma_c", stress, 1, 1e13, "pb_ten, fj_ten", "tensile strength of bonds, mean", part,
             &M::sigma_c);
  l.quantity("matrix", "sigma_c_sd", stress, 0, 1e13, "", "standard deviation of sigma_c", part,
             &M::sigma_c_sd);
  l.quantity("matrix", "tau_c", stress, 1, 1e13, "pb_coh, fj_coh", "shear strength (cohesion) of bonds, mean",
             part, &M::tau_c);
  l.quantity("matrix", "tau_c_sd", stress, 0, 1e13, "", "standard deviation of tau_c", part, &M::tau_c_sd);
  l.quantity("matrix", "phi", Dimension::angle, 0, 80, "pb_fa, fj_fa",
             "friction angle of bonds, with cohesion_friction", part, &M::phi);
  l.quantity("matrix", "bond_gap", Dimension::length, 0, largest_grain, "gap",
             "bonds at gaps up to this length; 0: where discs touch (gaps below 1e-6 of their mean radius)",
             part, &M::bond_gap);
  l.number("matrix", "unbonded_fraction", 0, 0.9, "",
           "share of these contacts that get no bond (linear contact only; of flat joints: a slit)", part,
           &M::unbonded_fraction)
      .quiet = true;
  l.integer("matrix", "bond_seed", 0, 4294967295.0, "seed of the bond strengths", part, &M::bond_seed);
  l.boolean("matrix", "unbreakable", "true: nothing breaks and nothing slips (elastic comparison)", part,
            &M::unbreakable);
}

/// Directions of the matrix.
void add_directions(List& l) {
  using M = MatrixRecipe;
  constexpr auto part = &Recipe::matrix;
  const auto ratio = [&](const char* key, const char* meaning, double M::*member) {
    l.number("matrix", key, 0.05, 20, "", meaning, part, member).quiet = true;
  };
  Field& foliation = l.quantity("matrix", "foliation", Dimension::angle, 0, 180, "180 - dip",
                                "inclination of the matrix's own layers, which the ratios below refer to",
                                part, &M::foliation);
  foliation.below_max = foliation.quiet = true;
  ratio("stiffness_ratio",
        "E_c and E_b of contacts with the normal along the foliation over those across it; the mean stays",
        &M::stiffness_ratio);
  ratio("tension_ratio", "the same of sigma_c; above 1 the layers part easily", &M::tension_ratio);
  ratio("cohesion_ratio", "the same of tau_c", &M::cohesion_ratio);
  ratio("cohesion_oblique",
        "tau_c of contacts at 45 deg to the foliation over those along and across it; the mean stays",
        &M::cohesion_oblique);
}

void add_flat_joint(List& l) {
  using M = MatrixRecipe;
  constexpr auto part = &Recipe::matrix;
  Field& elements =
      l.integer("matrix", "elements", 1, 4,
                "flat_joint: elements that an interface breaks in; a strength parameter", part, &M::elements);
  elements.pfc_name = "fj_nr", elements.quiet = true;
  l.choice("matrix", "break_at", {"centroid", "edge"},
           "flat_joint: where in an element the tension is compared with sigma_c (PFC: centroid)", part,
           &M::break_at)
      .quiet = true;
  l.number("matrix", "gapped_fraction", 0, 0.9, "",
           "flat_joint: share of contacts that get no bond and start initial_gap apart", part,
           &M::gapped_fraction)
      .quiet = true;
  l.quantity("matrix", "initial_gap", Dimension::length, 0, largest_grain, "fj_gap0",
             "flat_joint: gap of these interfaces at the start", part, &M::initial_gap)
      .quiet = true;
}

/// Where the planes of a set are.
void add_planes(List& l) {
  using B = BeddingRecipe;
  l.quantity("bedding", "theta", Dimension::angle, 0, 180, "180 - dip",
             "plane from +x, anticlockwise; load along y", &B::theta)
      .below_max = true;
  l.quantity("bedding", "theta_sd", Dimension::angle, 0, 10, "",
             "standard deviation of theta from plane to plane; not with oriented", &B::theta_sd)
      .quiet = true;
  l.quantity("bedding", "spacing", Dimension::length, 1e-6, longest, "",
             "distance of the planes of the set, mean; not with oriented", &B::spacing);
  l.number("bedding", "spacing_sd", 0, 0.3, "",
           "standard deviation of the spacing, over the spacing; not with oriented", &B::spacing_sd)
      .quiet = true;
  l.quantity("bedding", "zone_thickness", Dimension::length, 0, longest, "",
             "thickness d of the zone, used by the zone rule", &B::zone_thickness)
      .above_min = true;
  l.quantity("bedding", "offset", Dimension::length, -longest, longest, "",
             "distance of one plane from the specimen's centre; not with oriented", &B::offset);
}

/// Which contacts are its joints.
void add_rule(List& l) {
  using B = BeddingRecipe;
  l.choice(
      "bedding", "rule", {"crossing", "zone", "oriented"},
      "contacts that become joints: centres on two sides of a plane, point within the zone, or normal near "
      "the set's",
      &B::rule);
  l.boolean(
       "bedding", "bridges",
       "zone rule: contacts that cross a plane outside the zone stay bonded; false: they are joints, too",
       &B::bridges)
      .quiet = true;
  Field& range =
      l.quantity("bedding", "orientation_range", Dimension::angle, 0, 90, "",
                 "oriented rule: largest angle between the normals of a joint's contact and of the set",
                 &B::orientation_range);
  range.above_min = range.quiet = true;
  Field& share =
      l.number("bedding", "persistence", 0, 1, "",
               "share of the planes that is jointed, the rest stays bonded (rock bridges); 0: layers without "
               "joints; not with oriented",
               &B::persistence);
  share.quiet = true;
  l.quantity(
       "bedding", "patch_length", Dimension::length, 0, longest, "",
       "with persistence below 1: length of the patches that are jointed or bonded; 0: contact by contact; "
       "not with oriented",
       &B::patch_length)
      .quiet = true;
  l.quantity("bedding", "layer_thickness", Dimension::length, 0, longest, "",
             "thickness of a layer about each plane whose matrix differs; 0: none; not with oriented",
             &B::layer_thickness)
      .quiet = true;
  l.number("bedding", "layer_stiffness", 0.01, 100, "", "E_c and E_b in the layers over the matrix's",
           &B::layer_stiffness)
      .quiet = true;
  l.number("bedding", "layer_strength", 0.01, 100, "", "sigma_c and tau_c in the layers over the matrix's",
           &B::layer_strength)
      .quiet = true;
}

/// The joints of a set.
void add_joints(List& l) {
  using B = BeddingRecipe;
  l.quantity("bedding", "k_n", Dimension::stiffness, 1e3, 1e18, "sj_kn", "normal stiffness of the joints",
             &B::k_n);
  l.quantity("bedding", "k_s", Dimension::stiffness, 1e3, 1e18, "sj_ks", "shear stiffness of the joints",
             &B::k_s);
  l.number("bedding", "mu", 0, 10, "sj_fric", "friction coefficient of broken joints", &B::mu);
  l.quantity("bedding", "sigma_n", Dimension::pressure, 1, 1e13, "sj_ten",
             "tensile strength of bonded joints, mean", &B::sigma_n);
  l.quantity("bedding", "sigma_n_sd", Dimension::pressure, 0, 1e13, "", "standard deviation of sigma_n",
             &B::sigma_n_sd)
      .quiet = true;
  l.quantity("bedding", "cohesion", Dimension::pressure, 1, 1e13, "sj_coh", "cohesion of bonded joints",
             &B::cohesion);
  l.quantity("bedding", "phi", Dimension::angle, 0, 80, "sj_fa", "friction angle of bonded joints", &B::phi);
  l.quantity("bedding", "psi", Dimension::angle, 0, 80, "sj_da", "dilation angle; tan(psi) <= mu", &B::psi);
  l.number("bedding", "radius_multiplier", 0.01, 1, "sj_rmul", "joint radius over the smaller grain radius",
           &B::radius_multiplier);
}

/// Of the semi-circular bend test; ranges are those of the published factor.
void add_bend(List& l) {
  using T = TestRecipe;
  constexpr auto part = &Recipe::test;
  const char* const bend = "semi_circular_bend";
  l.number("test", "notch_ratio", 0.4, 0.6, "", "semi_circular_bend: length of the notch over the radius",
           part, &T::notch_ratio)
      .only_of = bend;
  l.quantity("test", "notch_width", Dimension::length, 0, largest_grain, "",
             "semi_circular_bend: width of the notch; 0: the largest grain diameter", part, &T::notch_width)
      .only_of = bend;
  l.number("test", "span_ratio", 0.5, 0.8, "",
           "semi_circular_bend: distance of the support rollers over the diameter", part, &T::span_ratio)
      .only_of = bend;
}

void add_test(List& l) {
  using T = TestRecipe;
  constexpr auto part = &Recipe::test;
  std::vector<std::string> tests;
  for (const TestDescription* test : laboratory_tests()) tests.emplace_back(test->name);
  l.choice("test", "kind", tests, "laboratory test", part, &T::kind);
  Field f;
  f.kind = FieldKind::quantities, f.table = "test", f.key = "angles", f.dimension = Dimension::angle;
  f.min = 0, f.max = 180, f.below_max = true;
  f.meaning = "one specimen per angle, turning the bedding so that the first set has it; empty: as it stands";
  f.list = [](Recipe& r) -> std::vector<double>& { return r.test.angles; };
  l.fields.push_back(f);
  l.boolean("test", "intact", "also a specimen without bedding", part, &T::intact);
  l.quantity("test", "platen_speed", Dimension::speed, 1e-6, 10, "", "speed of each platen", part,
             &T::platen_speed);
  l.number("test", "approach_strain", 0, 0.1, "",
           "strain, as of max_strain, up to which the platens move at approach_speed; 0: none; not of "
           "direct_shear",
           part, &T::approach_strain);
  l.quantity("test", "approach_speed", Dimension::speed, 0, 10, "",
             "speed of each platen up to approach_strain, at least platen_speed", part, &T::approach_speed);
  l.number("test", "ramp_strain", 0, 0.01, "",
           "axial strain while the speed rises from 0, or falls to platen_speed (direct_shear: displacement "
           "over width)",
           part, &T::ramp_strain);
  l.number("test", "platen_friction", 0, 10, "wall fric",
           "friction coefficient of the platens; not of brazilian", part, &T::platen_friction);
  l.number("test", "stop_at", 0, 0.99, "", "the test ends when the stress falls to this fraction of the peak",
           part, &T::stop_at);
  l.number("test", "post_peak", 0, 10, "",
           "the test ends when the strain exceeds the peak's by this fraction; 0: no such limit", part,
           &T::post_peak);
  l.number("test", "max_strain", 1e-5, 0.2, "",
           "the test ends at this axial strain at the latest (direct_shear: displacement over width)", part,
           &T::max_strain);
  l.integer("test", "history_interval", 10, 10000, "steps between history rows, and between all checks", part,
            &T::history_interval);
  l.integer("test", "n_snapshots", 0, 200,
            "stored states of grains and contacts (up to twice as many); 0: only the last", part,
            &T::n_snapshots);
  l.integer("test", "n_frames", 0, 1000,
            "stored displacement fields for the specimen viewer (up to twice as many); 0: only the last",
            part, &T::n_frames);
  l.number("test", "pre_strain", 0, 0.05, "", "axial strain of the affine pre-strain; 0: none", part,
           &T::pre_strain)
      .former = "jump_strain";
  l.quantity("test", "grip_thickness", Dimension::length, 0, longest, "",
             "direct_tension: rock held at each end; 0: four times the largest radius", part,
             &T::grip_thickness);
  l.quantity("test", "disc_diameter", Dimension::length, 0, longest, "",
             "brazilian: disc cut from the specimen; semi_circular_bend: half disc; 0: the largest it holds",
             part, &T::disc_diameter);
  l.quantity("test", "loading_angle", Dimension::angle, 0, 30, "",
             "brazilian: arc of the rim that each jaw holds; 0: flat platens", part, &T::loading_angle);
  l.number(
       "test", "jaw_friction", 0, 10, "wall fric",
       "brazilian: friction coefficient between disc and jaws; without it a coarse disc may roll out of them",
       part, &T::jaw_friction)
      .only_of = "brazilian";
  l.quantity("test", "confining_stress", Dimension::pressure, 0, 1e10, "", "biaxial: lateral stress", part,
             &T::confining_stress);
  l.choice(
      "test", "confinement", {"walls", "jacket"},
      "biaxial: sides are rigid walls that press with the confining stress, or a pressure on the side grains",
      part, &T::confinement);
  l.quantity("test", "normal_stress", Dimension::pressure, 0, 1e10, "", "direct_shear: stress on the plane",
             part, &T::normal_stress);
  l.quantity("test", "normal_stiffness", Dimension::stiffness, 0, 1e15, "",
             "direct_shear: growth of the normal stress with dilation; 0: constant normal load", part,
             &T::normal_stiffness);
  l.quantity("test", "shear_gap", Dimension::length, 0, longest, "",
             "direct_shear: free rock between the two boxes; 0: rigid halves", part, &T::shear_gap);
  add_bend(l);
}

void add_engine(List& l) {
  using E = EngineRecipe;
  constexpr auto part = &Recipe::engine;
  l.choice("engine", "precision", {"double", "float"}, "numbers of the force loop", part, &E::precision);
  l.number("engine", "damping", 0, 0.95, "damp", "local damping coefficient alpha", part, &E::damping);
  l.number("engine", "step_safety", 0.01, 1, "safety-factor", "fraction of the stable time step", part,
           &E::step_safety);
  l.choice("engine", "grain_inertia", {"disc", "equal"},
           "mass in the dynamics: each grain its own, or all the mean mass, whose time step is longer", part,
           &E::grain_inertia);
}

/// With the default of every key, as in a file.
Fields with_defaults(Fields fields) {
  Recipe usual;
  usual.bedding.resize(1);
  for (Field& f : fields) f.otherwise = print_field(f, usual, 0);
  return fields;
}

}  // namespace

const Fields& recipe_fields() {
  static const Fields fields = [] {
    List l;
    Field name;
    name.kind = FieldKind::text, name.key = "name",
    name.meaning = "name of the recipe, printed with the results";
    name.get_text = [](const Recipe& r) { return r.name; };
    name.set_text = [](Recipe& r, const std::string& s) { r.name = s; };
    l.fields.push_back(name);
    add_specimen(l), add_packing(l), add_matrix(l), add_flat_joint(l), add_directions(l), add_planes(l),
        add_rule(l), add_joints(l), add_test(l), add_engine(l);
    return with_defaults(std::move(l.fields));
  }();
  return fields;
}

bool is_written(const Field& f, const Recipe& recipe, std::size_t index) {
  if (!f.only_of.empty() && f.only_of != recipe.test.kind->name) return false;
  const bool dispersed = f.table == "bedding" && !recipe.bedding[index].has_planes();
  if (dispersed && (f.key == "spacing" || f.key == "offset")) return false;
  if (dispersed && f.key == "orientation_range") return true;  // what its joints are goes by it
  const bool of_parallel_bonds =
      f.table == "matrix" && (f.key == "stiffness_convention" || f.key == "E_b" ||
                              f.key == "bond_ks_over_kn" || f.key == "moment_contribution");
  if (of_parallel_bonds && recipe.matrix.model != MatrixModel::parallel_bond) return false;
  return !f.quiet || print_field(f, recipe, index) != f.otherwise;
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
      if (value == f.otherwise || !is_written(f, r, i)) continue;
      text += of_set ? "bedding[" + std::to_string(i) + "]." + f.key : f.path();
      text += " = " + value + "\n";
    }
  }
  return text;
}

}  // namespace phy
