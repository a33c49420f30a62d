#include "records/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/check.hpp"
#include "base/exact_math.hpp"

namespace phy {
namespace {

const BeddingRecipe& joint(const Recipe& r) { return r.bedding.front(); }

bool has_joints(const Recipe& r) { return !r.bedding.empty(); }
bool has_directions(const Recipe& r) { return r.matrix.directional(); }
/// Between joints on planes the stiffness of bonds has none: E(theta) would not tell the two apart.
bool has_directions_alone(const Recipe& r) { return has_directions(r) && !has_joints(r); }
bool has_parallel_bonds(const Recipe& r) { return r.matrix.model == MatrixModel::parallel_bond; }
bool has_flat_joints(const Recipe& r) { return r.matrix.model == MatrixModel::flat_joint; }
/// Bonds for which the program seeks a friction angle; plain parallel bonds keep the paper's constant
/// strength.
bool may_rub(const Recipe& r) { return has_directions(r) || !has_parallel_bonds(r); }

/// A pure number of the matrix that is sought as it stands.
template <double MatrixRecipe::*member>
constexpr Parameter of_matrix(const char* key, const char* symbol, Range range,
                              bool (*belongs)(const Recipe&)) {
  return {.key = key,
          .symbol = symbol,
          .unit = "1",
          .number = [](const Recipe& r) -> const double& { return r.matrix.*member; },
          .range = range,
          .set = [](Recipe& r, double v) { r.matrix.*member = v; },
          .belongs = belongs};
}

constexpr Parameter with(Parameter p, const ModulusRole& role) {
  p.modulus = role;
  return p;
}
constexpr Parameter with(Parameter p, const StrengthRole& role) {
  p.strength = role;
  return p;
}

}  // namespace

// ---- elastic

const Parameter matrix_E_c{.key = "matrix.E_c",
                           .symbol = "E_c",
                           .unit = "Pa",
                           .number = [](const Recipe& r) -> const double& { return r.matrix.E_c; },
                           .range = {0.05, 3.0, 0.5, &Scales::modulus},
                           .set =
                               [](Recipe& r, double v) {
                                 r.matrix.E_c = v;
                                 // One modulus of contacts and bonds, as in the paper: E(theta) does not tell
                                 // the two apart.
                                 if (has_parallel_bonds(r)) r.matrix.E_b = v;
                               },
                           .modulus = ModulusRole{{"matrix.E_c", "matrix.E_b"},
                                                  MacroNumber::E,
                                                  [](const FirstSight& s) { return s.E_c * s.macro_E / s.E; },
                                                  between(Property::E, 80.0, 90.0),
                                                  {Property::E}}};

/// Of contacts and bonds alike. The uniform-strain estimate nu = (1 - q)/(3 + q) falls by 4 q/(3 + q)^2 per
/// logarithm of q = k_s/k_n. E over E_c grows as q^0.22 over the whole box (data/maps/parallel-bond.csv).
const Parameter matrix_ks_over_kn{
    .key = "matrix.ks_over_kn",
    .symbol = "k_s/k_n",
    .unit = "1",
    .number = [](const Recipe& r) -> const double& { return r.matrix.ks_over_kn; },
    .range = {0.05, 1.0, 0.3},
    .set =
        [](Recipe& r, double v) {
          r.matrix.ks_over_kn = v;
          // As with the moduli: nu is one number, and would not settle two ratios.
          if (has_parallel_bonds(r)) r.matrix.bond_ks_over_kn = v;
        },
    .modulus = ModulusRole{{"matrix.ks_over_kn", "matrix.bond_ks_over_kn"},
                           MacroNumber::nu,
                           nullptr,
                           at_both_ends(Property::nu),
                           {Property::nu},
                           // That slope at the usual q = 0.3.
                           4.0 * 0.3 / (3.3 * 3.3),
                           0.15,
                           0.22}};

const Parameter joint_k_n{
    .key = "bedding[0].k_n",
    .symbol = "k_n,sj",
    .unit = "Pa/m",
    .number = [](const Recipe& r) -> const double& { return joint(r).k_n; },
    // At fifty times the rock between two planes a joint adds 2 % of compliance: stiffer ones cannot be told
    // apart.
    .range = {0.02, 50.0, 0.5, &Scales::stiffness},
    .set = [](Recipe& r, double v) { r.bedding.front().k_n = v; },
    .belongs = has_joints,
    .modulus = ModulusRole{{"bedding[0].k_n"},
                           // E(0) knows only K_n in Eq. 1: joints across the load shear not at all.
                           MacroNumber::K_n_delta,
                           [](const FirstSight& s) { return s.K_n_delta / s.joint_length; },
                           between(Property::E, 0.0, 15.0)}};

const Parameter joint_k_s{
    .key = "bedding[0].k_s",
    .symbol = "k_s,sj",
    .unit = "Pa/m",
    .number = [](const Recipe& r) -> const double& { return joint(r).k_s; },
    .range = {0.005, 50.0, 0.2, &Scales::stiffness},
    .set = [](Recipe& r, double v) { r.bedding.front().k_s = v; },
    .belongs = has_joints,
    .modulus = ModulusRole{{"bedding[0].k_s"},
                           // Shear of the joints counts most at 45 degrees, where sin^2 cos^2 is largest.
                           MacroNumber::K_s_delta,
                           [](const FirstSight& s) { return s.K_s_delta / s.joint_length; },
                           between(Property::E, 30.0, 60.0)}};

/// Acts on E(90)/E(0) as planes' normal stiffness does in Eq. 1.
const Parameter stiffness_ratio =
    with(of_matrix<&MatrixRecipe::stiffness_ratio>("matrix.stiffness_ratio", "r_E", {0.5, 6.0, 1.5},
                                                   has_directions_alone),
         ModulusRole{{"matrix.stiffness_ratio"}, MacroNumber::K_n_delta, nullptr, at_both_ends(Property::E)});

namespace {

// ---- strengths

void scale_joints(Recipe& r, double factor) {
  // sigma_n_sd is left alone: a calibrated joint has no scatter (is_ideal in rock/file.cpp).
  for (BeddingRecipe& b : r.bedding) b.cohesion *= factor, b.sigma_n *= factor;
}

LabTest compression(const Evidence& e, double from, double to) {
  return between(compression_of(e, from, to), from, to);
}
LabTest compression(const Evidence& e) { return {compression_of(e)}; }

/// Of tests that speak of others as well, more of the same would not help.
Rule rule_of(std::vector<LabTests> tests, const LabTest& next, bool held, bool shared) {
  Rule rule{held, std::move(tests), {}, shared};
  // A test that is there already, and speaks of others too, settles nothing by being repeated.
  if (!held || !shared) rule.next = {next};
  return rule;
}

/// Without bedding any UCS will do; with it, one that planes do not decide.
Rule sigma_c_rule(const Evidence& e) {
  if (!e.rock.bedded) return {true, {compression(e)}, {}};
  // UCS goes before strengths under confinement, which friction moves too.
  const bool ucs = e.has(Property::ucs, 0.0, near_0) || e.has(Property::ucs, near_90, 90.0);
  return {e.compressed(0.0, near_0) || e.compressed(near_90, 90.0),
          {at_either_end(ucs ? Property::ucs : Property::confined)},
          {at_both_ends(Property::ucs)}};
}

/// A disc splits along its load, as a core under points does: planes at 90 degrees open in it, as those at 0
/// do in direct tension.
const LabTests tension({{Property::direct_tension}, {Property::brazilian}, {Property::point_load}}),
    tension_across({between(Property::direct_tension, 0.0, 30.0), between(Property::brazilian, 60.0, 90.0),
                    between(Property::point_load, 60.0, 90.0)}),
    tension_along({between(Property::direct_tension, 60.0, 90.0), between(Property::brazilian, 0.0, 30.0),
                   between(Property::point_load, 0.0, 30.0)});

bool holds(const Evidence& e, const LabTests& any) { return !held_by(e.targets, {any}).empty(); }

Rule tau_c_rule(const Evidence& e) {
  // UCS and tension of bonds without planes tell tau_c from sigma_c; with planes only tension along them
  // does.
  if (!e.rock.bedded) return {holds(e, tension), {compression(e), tension}, {tension}};
  return {sigma_c_rule(e).held && holds(e, tension_along),
          {compression(e), tension_along},
          {LabTests({at_angle(Property::direct_tension, 90.0), at_angle(Property::brazilian, 0.0)})}};
}

/// Friction shows in how strength grows: it takes confinement, and another confinement or none at the same
/// inclination.
bool grows(const Evidence& e, double from, double to) {
  for (const Target& t : e.strengths)
    for (const Target& u : e.strengths)
      if (is_compressive(t.property) && is_compressive(u.property) && t.confining < u.confining &&
          // At two inclinations strength differs by the planes, and that is no growth with the stress.
          (!e.rock.bedded || (t.theta == u.theta && t.theta >= from && t.theta <= to)))
        return true;
  return false;
}

/// Friction of the grains shows in strengths under confinement that planes do not decide, beside that of the
/// bonds where these have one.
Rule friction_rule(const Evidence& e) {
  // At steep and flat planes alone: between them the joints slide, and show their own friction.
  const bool held = e.rock.bedded ? grows(e, 0.0, near_0) || grows(e, near_90, 90.0) : grows(e, 0.0, 90.0);
  const LabTest test = e.rock.bedded ? at_either_end(Property::confined) : LabTest{Property::confined};
  LabTest next = test;
  if (held)
    next.stress = StressAsked::higher;
  else if (e.has(Property::confined))
    next.stress = StressAsked::another;
  return {held, {test}, {next}, true};
}
Rule joint_friction_rule(const Evidence& e) {
  LabTest next = between(Property::confined, 45.0, 60.0);
  // The same stress again would repeat the strength that is known: growth needs another one.
  if (e.has(Property::confined, 30.0, 75.0)) next.stress = StressAsked::another;
  return {grows(e, 30.0, 75.0) || e.has(Property::shear_residual),
          {LabTests({between(Property::confined, 30.0, 75.0), {Property::shear_residual}})},
          {next}};
}

/// Bonded bedding rubs where its peak grows with the stress across it.
Rule bedding_friction_rule(const Evidence& e) {
  const std::vector<Target> peaks = of_property(e.targets, Property::shear_peak);  // one for each stress
  const LabTest test{Property::shear_peak};
  // One stress gives one peak, which cohesion alone explains.
  return {peaks.size() > 1, {test}, {test}};
}

void check_dilation(const Rock& rock) {
  for (const BeddingRecipe& b : rock.model.bedding)
    if (rock.bedded && tan_degrees(b.psi) > joint_mu.range.high)
      throw InputError(Problem{rock.name, "bedding.psi", fmt::format("{:g} deg", b.psi),
                               fmt::format("tan(psi) <= {:g}", joint_mu.range.high),
                               fmt::format("no joint dilates more than it rubs, and {} is sought from {:g} "
                                           "to {:g}: lower psi in the recipe",
                                           joint_mu.symbol, joint_mu.range.low, joint_mu.range.high)});
}

std::vector<const Parameter*> those_of(std::vector<const Parameter*> list, const Recipe& model) {
  std::erase_if(list, [&](const Parameter* p) { return p->belongs != nullptr && !p->belongs(model); });
  return list;
}

Estimate named(const Parameter& p, std::string key, std::string symbol, std::string unit) {
  Estimate e;
  e.key = std::move(key), e.symbol = std::move(symbol), e.unit = std::move(unit);
  e.parameter = &p;
  return e;
}

}  // namespace

const Parameter matrix_sigma_c{
    .key = "matrix.sigma_c",
    .symbol = "sigma_c",
    .unit = "Pa",
    .number = [](const Recipe& r) -> const double& { return r.matrix.sigma_c; },
    .range = {0.1, 1.5, 0.4, &Scales::strength},
    .set =
        [](Recipe& r, double v) {
          MatrixRecipe& m = r.matrix;
          const double scale = v / m.sigma_c;
          // All strengths go along: sigma_c is the scale of the model, and the ratios below it stay.
          for (double* strength : {&m.sigma_c, &m.sigma_c_sd, &m.tau_c, &m.tau_c_sd}) *strength *= scale;
          scale_joints(r, scale);
          m.sigma_c = v;
        },
    .strength = StrengthRole{sigma_c_rule}};

const Parameter matrix_tau_c{.key = "matrix.tau_c",
                             .symbol = "tau_c",
                             .unit = "Pa",
                             .number = [](const Recipe& r) -> const double& { return r.matrix.tau_c; },
                             .over = &matrix_sigma_c,
                             // Priors with a width are from literature, here and below: who has which is in
                             // docs/theory/inference.md, "Prior".
                             .range = {0.8, 5.0, 2.0, nullptr, 0.6},
                             .set =
                                 [](Recipe& r, double v) {
                                   MatrixRecipe& m = r.matrix;
                                   // Joints go along, whose cohesion is sought as a share of tau_c.
                                   const double scale = v * m.sigma_c / m.tau_c;
                                   m.tau_c *= scale, m.tau_c_sd *= scale;
                                   scale_joints(r, scale);
                                 },
                             .strength = StrengthRole{tau_c_rule}};

const Parameter matrix_mu{.key = "matrix.mu",
                          .symbol = "mu",
                          .unit = "1",
                          .number = [](const Recipe& r) -> const double& { return r.matrix.mu; },
                          // 0.8 in the paper; sliding rock has 0.6 to 0.85 (Byerlee 1978).
                          .range = {0.2, 1.2, 0.5, nullptr, 0.4},
                          .set = [](Recipe& r, double v) { r.matrix.mu = v; },
                          .strength = StrengthRole{friction_rule}};

/// A bond that bends breaks at its rim; the less the moment counts, the more UCS exceeds tension
/// (docs/theory/reach.md).
const Parameter matrix_moment =
    with(of_matrix<&MatrixRecipe::moment_contribution>("matrix.moment_contribution", "beta_bar",
                                                       {0.05, 1.0, 0.3}, has_parallel_bonds),
         StrengthRole{[](const Evidence& e) -> Rule {
                        return {e.compressed() && holds(e, tension), {compression(e), tension}, {}, true};
                      },
                      true});

/// With phi shear strength grows under pressure, which UCS feels, strength under confinement more, and
/// tension not at all.
const Parameter matrix_phi{.key = "matrix.phi",
                           .symbol = "phi",
                           .unit = "deg",
                           .number = [](const Recipe& r) -> const double& { return r.matrix.phi; },
                           .range = {4.0, 45.0, 15.0, nullptr, 0.7},
                           .set =
                               [](Recipe& r, double v) {
                                 // With the paper's constant strength an angle of friction would be without
                                 // effect.
                                 r.matrix.shear_strength = ShearStrength::cohesion_friction;
                                 r.matrix.phi = v;
                               },
                           .belongs = may_rub,
                           .strength = StrengthRole{matrix_moment.strength->rule, true}};

/// Slits open early under load, which sigma_ci feels more than UCS, and take their share of the tensile
/// strength. They soften the specimen too: that is read from tests, as all softening (read_moduli.hpp), so
/// that E of small strain, which knows no tests, does not go with them.
const Parameter matrix_slits = with(
    of_matrix<&MatrixRecipe::unbonded_fraction>("matrix.unbonded_fraction", "slits", {0.01, 0.4, 0.05},
                                                has_flat_joints),
    StrengthRole{[](const Evidence& e) -> Rule {
                   const bool held = e.has(Property::crack_initiation) &&
                                     (e.rock.E_is != ModulusReading::small_strain || !e.has(Property::E));
                   const LabTest test{Property::crack_initiation};
                   return rule_of({test, LabTest{Property::ucs}}, test, held, true);
                 },
                 true});

// ---- directions

const Parameter tension_ratio = with(
    of_matrix<&MatrixRecipe::tension_ratio>("matrix.tension_ratio", "r_t", {1.0 / 6.0, 6.0, 1.2},
                                            has_directions),
    StrengthRole{
        [](const Evidence& e) -> Rule {
          return {holds(e, tension_across) && holds(e, tension_along),
                  {tension_along, tension_across},
                  {LabTests({at_both_ends(Property::direct_tension), at_both_ends(Property::brazilian)})}};
        },
        true});

const Parameter cohesion_ratio =
    with(of_matrix<&MatrixRecipe::cohesion_ratio>("matrix.cohesion_ratio", "r_c", {1.0 / 8.0, 8.0, 1.2},
                                                  has_directions),
         StrengthRole{[](const Evidence& e) -> Rule {
           // The ratio is of two directions, and takes a strength of each.
           return {e.compressed(0.0, near_0) && e.compressed(75.0, 90.0),
                   {compression(e, 0.0, near_0), compression(e, 75.0, 90.0)},
                   {at_both_ends(Property::ucs)}};
         }});

const Parameter cohesion_oblique =
    with(of_matrix<&MatrixRecipe::cohesion_oblique>("matrix.cohesion_oblique", "q_c", {1.0, 3.0, 1.4},
                                                    has_directions),
         StrengthRole{[](const Evidence& e) -> Rule {
           return rule_of({compression(e, 30.0, 60.0)}, between(Property::ucs, 30.0, 60.0),
                          e.compressed(30.0, 60.0), has_joints(e.rock.model));
         }});

// ---- joints

const Parameter joint_cohesion{
    .key = "bedding[0].cohesion",
    .symbol = "C_sj",
    .unit = "Pa",
    .number = [](const Recipe& r) -> const double& { return joint(r).cohesion; },
    .over = &matrix_tau_c,
    .range = {0.07, 0.9, 0.25},
    .set =
        [](Recipe& r, double v) {
          for (BeddingRecipe& b : r.bedding) {
            const double before = b.cohesion;
            b.cohesion = v * r.matrix.tau_c;
            // sigma_n is sought over the cohesion, so that it goes along.
            b.sigma_n *= b.cohesion / before;
          }
        },
    .belongs = has_joints,
    .strength = StrengthRole{[](const Evidence& e) -> Rule {
      const bool held =
          e.has(Property::ucs, 30.0, 75.0) || grows(e, 30.0, 75.0) || e.has(Property::shear_peak);
      LabTests tests = compression(e, 30.0, 75.0);
      tests.any_of.push_back({Property::shear_peak});
      return rule_of({tests}, between(Property::ucs, 45.0, 60.0), held, has_directions(e.rock.model));
    }}};

const Parameter joint_sigma_n{
    .key = "bedding[0].sigma_n",
    .symbol = "sigma_n,sj",
    .unit = "Pa",
    .number = [](const Recipe& r) -> const double& { return joint(r).sigma_n; },
    .over = &joint_cohesion,
    .range = {0.07, 1.5, 0.33, nullptr, 0.7},
    .set =
        [](Recipe& r, double v) {
          for (BeddingRecipe& b : r.bedding) b.sigma_n = v * b.cohesion;
        },
    .belongs = has_joints,
    .strength = StrengthRole{[](const Evidence& e) -> Rule {
      // Compression closes joints across its load: only tension opens them.
      return {holds(e, tension_across),
              {tension_across},
              {LabTests({at_angle(Property::direct_tension, 0.0), at_angle(Property::brazilian, 90.0)})}};
    }}};

const Parameter joint_mu{
    .key = "bedding[0].mu",
    .symbol = "mu_sj",
    .unit = "1",
    .number = [](const Recipe& r) -> const double& { return joint(r).mu; },
    // 0.4 in the paper; joints of schist and slate have 20 to 34 degrees (TRB 1990).
    .range = {0.15, 1.0, 0.45, nullptr, 0.35},
    .set = [](Recipe& r, double v) { r.bedding.front().mu = v; },
    .belongs = has_joints,
    .strength = StrengthRole{joint_friction_rule, false,
                             // A joint that dilates more than it rubs makes energy. The margin is for the way
                             // through logarithms and back.
                             [](const Recipe& r) { return tan_degrees(joint(r).psi) * (1.0 + 1e-9); },
                             check_dilation}};

/// Of bonded joints: with it their shear strength grows under pressure.
const Parameter joint_phi{.key = "bedding[0].phi",
                          .symbol = "phi_sj",
                          .unit = "deg",
                          .number = [](const Recipe& r) -> const double& { return joint(r).phi; },
                          .range = {2.0, 50.0, 20.0, nullptr, 0.7},
                          .set =
                              [](Recipe& r, double v) {
                                for (BeddingRecipe& b : r.bedding) b.phi = v;
                              },
                          .belongs = has_joints,
                          .strength = StrengthRole{bedding_friction_rule, true}};

std::vector<const Parameter*> elastic_parameters(const Recipe& model) {
  return those_of({&matrix_E_c, &matrix_ks_over_kn, &joint_k_n, &joint_k_s, &stiffness_ratio}, model);
}

std::vector<const Parameter*> strength_parameters(const Recipe& model) {
  // In the order in which they are set: a strength takes along all that are sought over it.
  return those_of({&matrix_sigma_c, &matrix_tau_c, &matrix_mu, &matrix_moment, &matrix_phi, &matrix_slits,
                   &joint_cohesion, &joint_sigma_n, &joint_mu, &joint_phi, &tension_ratio, &cohesion_ratio,
                   &cohesion_oblique},
                  model);
}

std::vector<const Parameter*> strength_parameters(const Evidence& evidence) {
  std::vector<const Parameter*> list = strength_parameters(evidence.rock.model);
  std::erase_if(
      // A ratio that no value tells would keep its prior, and cost six points of the search.
      list, [&](const Parameter* p) { return p->strength->if_held && !p->strength->rule(evidence).held; });
  return list;
}

std::vector<const Parameter*> strength_ratios(const Evidence& evidence) {
  std::vector<const Parameter*> list = strength_parameters(evidence);
  std::erase(list, &matrix_sigma_c);
  return list;
}

double Parameter::get(const Recipe& recipe) const {
  return over == nullptr ? number(recipe) : number(recipe) / over->number(recipe);
}

LogBox Parameter::box(const Scales& scales) const {
  const double unity = range.of == nullptr ? 1.0 : scales.*range.of;
  return {std::log(range.low * unity), std::log(range.high * unity), std::log(range.usual * unity), range.sd};
}

/// Of a normal distribution beside a flat one of the box, whose precisions add: the truncated normal within
/// some per cent, without its error functions.
double LogBox::spread() const {
  constexpr double flat = 12.0;  // variance of a box, in squares of its width
  return 1.0 / std::sqrt(flat / ((high - low) * (high - low)) + 1.0 / (sd * sd));
}

double Parameter::normalised(double value) const {
  return 2.0 * std::log(value / range.low) / std::log(range.high / range.low) - 1.0;
}

double Parameter::from_normalised(double place) const {
  return range.low * std::pow(range.high / range.low, 0.5 * (place + 1.0));
}

Estimate sought(const Parameter& p) {
  if (p.over == nullptr) return number_of_recipe(p);
  const std::string ratio = std::string(p.symbol) + "/" + p.over->symbol;
  return named(p, ratio, ratio, "1");
}

Estimate number_of_recipe(const Parameter& p) {
  Estimate e = named(p, p.key, p.symbol, p.unit);
  e.number = p.number;
  return e;
}

}  // namespace phy
