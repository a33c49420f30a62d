#include "calibrate/family.hpp"

#include <algorithm>
#include <cmath>

#include "base/exact_math.hpp"

namespace phy::calibrate {
namespace {

double mean_diameter(const Recipe& r) { return r.packing.radius_min + r.packing.radius_max; }
BeddingRecipe& bedding(Recipe& r) { return r.bedding.front(); }
const BeddingRecipe& bedding(const Recipe& r) { return r.bedding.front(); }

/// A parameter of the calibration, in its box.
template <const StrengthParameter* parameter>
Lever lever_of(const char* name) {
  return {name,
          parameter->range.low,
          parameter->range.high,
          true,
          [](const Recipe& r) { return parameter->get(r); },
          [](Recipe& r, double v) { parameter->set(r, v); },
          parameter};
}

/// A number of the matrix as it stands.
template <double MatrixRecipe::*member>
Lever of_matrix(const char* name, double low, double high, bool logarithmic,
                const StrengthParameter* parameter, bool at_base) {
  return {name,
          low,
          high,
          logarithmic,
          [](const Recipe& r) { return r.matrix.*member; },
          [](Recipe& r, double v) { r.matrix.*member = v; },
          parameter,
          at_base};
}

const Lever contact_ratio = {"k_s/k_n",
                             0.15,
                             0.7,
                             true,
                             [](const Recipe& r) { return r.matrix.ks_over_kn; },
                             [](Recipe& r, double v) { r.matrix.ks_over_kn = r.matrix.bond_ks_over_kn = v; }};
const Lever moment = of_matrix<&MatrixRecipe::moment_contribution>("moment contribution", 0.0, 1.0, false,
                                                                   &matrix_moment, true);
/// Of cohesion_friction bonds; a constant strength is friction angle 0.
const Lever bond_friction = {
    "phi [deg]",
    0.0,
    45.0,
    false,
    [](const Recipe& r) { return r.matrix.shear_strength == ShearStrength::constant ? 0.0 : r.matrix.phi; },
    [](Recipe& r, double v) { r.matrix.shear_strength = ShearStrength::cohesion_friction, r.matrix.phi = v; },
    &matrix_phi,
    true};
const Lever strength_scatter = {
    "SD/sigma_c",
    0.05,
    0.4,
    true,
    [](const Recipe& r) { return std::max(1e-3, r.matrix.sigma_c_sd / r.matrix.sigma_c); },
    [](Recipe& r, double v) {
      r.matrix.sigma_c_sd = v * r.matrix.sigma_c;
      r.matrix.tau_c_sd = v * r.matrix.tau_c;
    },
    nullptr,
    true};
const Lever slits =
    of_matrix<&MatrixRecipe::unbonded_fraction>("unbonded fraction", 0.0, 0.3, false, &matrix_slits, true);

const Lever plane_spacing = {"spacing/diameter",
                             4.0,
                             12.0,
                             true,
                             [](const Recipe& r) { return bedding(r).spacing / mean_diameter(r); },
                             [](Recipe& r, double v) { bedding(r).spacing = v * mean_diameter(r); },
                             nullptr,
                             true};
const Lever joint_normal = {
    "k_n spacing/E_c",
    0.1,
    4.0,
    true,
    [](const Recipe& r) { return bedding(r).k_n * bedding(r).spacing / r.matrix.E_c; },
    [](Recipe& r, double v) { bedding(r).k_n = v * r.matrix.E_c / bedding(r).spacing; }};
const Lever joint_shear = {
    "k_s spacing/E_c",
    0.03,
    1.5,
    true,
    [](const Recipe& r) { return bedding(r).k_s * bedding(r).spacing / r.matrix.E_c; },
    [](Recipe& r, double v) { bedding(r).k_s = v * r.matrix.E_c / bedding(r).spacing; }};

const Lever persistence = {"persistence",
                           0.2,
                           0.95,
                           true,
                           [](const Recipe& r) { return bedding(r).persistence; },
                           [](Recipe& r, double v) { bedding(r).persistence = v; }};
bool was_mapped(const Recipe& bridged) {
  return std::fabs(persistence.place_of(persistence.get(bridged))) <= 1.0 + 1e-9;
}
/// Contact by contact is a patch as long as a grain.
const Lever patch_length = {
    "patch/diameter",
    1.0,
    12.0,
    true,
    [](const Recipe& r) { return std::max(1.0, bedding(r).patch_length / mean_diameter(r)); },
    [](Recipe& r, double v) { bedding(r).patch_length = v * mean_diameter(r); },
    nullptr,
    true};

const Lever stiffness_along =
    of_matrix<&MatrixRecipe::stiffness_ratio>("stiffness ratio", 1.0, 4.0, true, nullptr, false);
std::vector<Lever> operator+(std::vector<Lever> list, const std::vector<Lever>& more) {
  list.insert(list.end(), more.begin(), more.end());
  return list;
}
std::vector<Lever> matrix_strength() {
  return {lever_of<&matrix_tau_c>("tau_c/sigma_c"), lever_of<&matrix_mu>("mu")};
}
std::vector<Lever> parallel_bond() { return {contact_ratio, moment, bond_friction, strength_scatter}; }
std::vector<Lever> flat_joint() { return {contact_ratio, bond_friction, strength_scatter, slits}; }
std::vector<Lever> planes() {
  return {lever_of<&joint_cohesion>("C/tau_c"),
          lever_of<&joint_sigma_n>("sigma_n/C"),
          lever_of<&joint_mu>("mu_sj"),
          plane_spacing,
          joint_normal,
          joint_shear};
}
std::vector<Lever> bridges() { return {persistence, patch_length}; }
std::vector<Lever> directed_strength() {
  // a calibration seeks the two ratios in wider boxes, where the regressions extrapolate
  return {
      of_matrix<&MatrixRecipe::tension_ratio>("tension ratio", 1.0 / 3.0, 3.0, true, &tension_ratio, false),
      of_matrix<&MatrixRecipe::cohesion_ratio>("cohesion ratio", 0.2, 5.0, true, &cohesion_ratio, false),
      lever_of<&cohesion_oblique>("cohesion oblique")};
}
std::vector<Lever> directions() { return std::vector<Lever>{stiffness_along} + directed_strength(); }

/// 16 x 32 mm of 1,321 discs: porosity 0.08, the density of the paper's packing.
Recipe sound_rock(MatrixModel model) {
  Recipe r;
  r.specimen.width = 16e-3, r.specimen.height = 32e-3;
  r.packing.n_grains = 1321;
  r.matrix.model = model;
  r.matrix.sigma_c = r.matrix.tau_c = 50e6;
  r.matrix.sigma_c_sd = r.matrix.tau_c_sd = 5e6;
  return r;
}

Recipe bedded_rock(MatrixModel model, BeddingRule rule) {
  Recipe r = sound_rock(model);
  r.bedding.resize(1);
  r.bedding[0].rule = rule, r.bedding[0].zone_thickness = 0.9 * mean_diameter(r);
  return r;
}

Recipe bridged_rock() {
  Recipe r = bedded_rock(MatrixModel::parallel_bond, BeddingRule::crossing);
  r.bedding[0].persistence = usual_persistence;
  return r;
}

}  // namespace

double Lever::place_of(double value) const {
  const double share =
      logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return 2.0 * share - 1.0;
}

double Lever::at_place(double place) const {
  const double share = 0.5 * (place + 1.0);
  return logarithmic ? low * std::pow(high / low, share) : low + share * (high - low);
}

bool ModelFamily::has(const Recipe& r) const {
  if (r.matrix.model != base.matrix.model || r.bedding.empty() != base.bedding.empty()) return false;
  const bool turns =
      std::any_of(levers.begin(), levers.end(), [](const Lever& l) { return l.parameter == &tension_ratio; });
  return r.matrix.directional() == turns &&
         (r.bedding.empty() || (bedding(r).rule == bedding(base).rule &&
                                has_bridges(r) == has_bridges(base) && (!has_bridges(r) || was_mapped(r))));
}

const std::vector<ModelFamily>& model_families() {
  static const std::vector<ModelFamily> all = {
      {"parallel-bond-crossing", "parallel bonds, planes by crossing",
       bedded_rock(MatrixModel::parallel_bond, BeddingRule::crossing),
       matrix_strength() + parallel_bond() + planes(), 320, 320, true},
      {"parallel-bond", "parallel bonds", sound_rock(MatrixModel::parallel_bond),
       matrix_strength() + parallel_bond(), 48, 32, false},
      {"parallel-bond-directions", "parallel bonds with directions", sound_rock(MatrixModel::parallel_bond),
       matrix_strength() + parallel_bond() + directions(), 384, 0, true},
      {"parallel-bond-zone", "parallel bonds, planes by zone",
       bedded_rock(MatrixModel::parallel_bond, BeddingRule::zone),
       matrix_strength() + parallel_bond() + planes(), 208, 320, true},
      {"parallel-bond-directions-crossing", "parallel bonds with directions of strength, planes by crossing",
       bedded_rock(MatrixModel::parallel_bond, BeddingRule::crossing),
       matrix_strength() + parallel_bond() + planes() + directed_strength(), 640, 0, true},
      {"parallel-bond-bridges-crossing", "parallel bonds, planes with bridges by crossing", bridged_rock(),
       matrix_strength() + parallel_bond() + planes() + bridges(), 320, 256, true},
      {"flat-joint", "flat joints", sound_rock(MatrixModel::flat_joint), matrix_strength() + flat_joint(), 32,
       0, false},
      {"flat-joint-crossing", "flat joints, planes by crossing",
       bedded_rock(MatrixModel::flat_joint, BeddingRule::crossing),
       matrix_strength() + flat_joint() + planes(), 208, 0, true},
      {"flat-joint-zone", "flat joints, planes by zone",
       bedded_rock(MatrixModel::flat_joint, BeddingRule::zone), matrix_strength() + flat_joint() + planes(),
       208, 0, true}};
  return all;
}

const ModelFamily* family_of(const Recipe& recipe) {
  for (const ModelFamily& f : model_families())
    if (f.has(recipe)) return &f;
  return nullptr;
}

}  // namespace phy::calibrate
