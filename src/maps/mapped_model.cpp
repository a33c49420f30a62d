#include "maps/mapped_model.hpp"

#include <algorithm>
#include <cmath>

#include "base/exact_math.hpp"

namespace phy::maps {
namespace {

BeddingRecipe& bedding(Recipe& r) { return r.bedding.front(); }
const BeddingRecipe& bedding(const Recipe& r) { return r.bedding.front(); }

/// A parameter of the calibration, in its box.
template <const Parameter* parameter>
MapVariable variable_of(const char* name) {
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
MapVariable of_matrix(MapVariable variable) {
  variable.get = [](const Recipe& r) { return r.matrix.*member; };
  variable.set = [](Recipe& r, double v) { r.matrix.*member = v; };
  return variable;
}

const MapVariable contact_ratio = {
    "k_s/k_n",
    0.15,
    0.7,
    true,
    [](const Recipe& r) { return r.matrix.ks_over_kn; },
    [](Recipe& r, double v) { r.matrix.ks_over_kn = r.matrix.bond_ks_over_kn = v; },
    &matrix_ks_over_kn};
const MapVariable moment = of_matrix<&MatrixRecipe::moment_contribution>({.name = "moment contribution",
                                                                          .low = 0.0,
                                                                          .high = 1.0,
                                                                          .logarithmic = false,
                                                                          .parameter = &matrix_moment,
                                                                          .at_base = true});
/// Of cohesion_friction bonds; a constant strength is friction angle 0.
const MapVariable bond_friction = {
    "phi [deg]",
    0.0,
    45.0,
    false,
    [](const Recipe& r) { return r.matrix.shear_strength == ShearStrength::constant ? 0.0 : r.matrix.phi; },
    [](Recipe& r, double v) { r.matrix.shear_strength = ShearStrength::cohesion_friction, r.matrix.phi = v; },
    &matrix_phi,
    true};
const MapVariable strength_scatter = {
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
const MapVariable slits = of_matrix<&MatrixRecipe::unbonded_fraction>({.name = "unbonded fraction",
                                                                       .low = 0.0,
                                                                       .high = 0.3,
                                                                       .logarithmic = false,
                                                                       .parameter = &matrix_slits,
                                                                       .at_base = true});

const MapVariable plane_spacing = {"spacing/diameter",
                                   4.0,
                                   12.0,
                                   true,
                                   [](const Recipe& r) { return bedding(r).spacing / grain_size(r); },
                                   [](Recipe& r, double v) { bedding(r).spacing = v * grain_size(r); },
                                   nullptr,
                                   true};
const MapVariable joint_normal = {
    "k_n spacing/E_c",
    0.1,
    4.0,
    true,
    [](const Recipe& r) { return bedding(r).k_n * bedding(r).spacing / r.matrix.E_c; },
    [](Recipe& r, double v) { bedding(r).k_n = v * r.matrix.E_c / bedding(r).spacing; },
    &joint_k_n};
const MapVariable joint_shear = {
    "k_s spacing/E_c",
    0.03,
    1.5,
    true,
    [](const Recipe& r) { return bedding(r).k_s * bedding(r).spacing / r.matrix.E_c; },
    [](Recipe& r, double v) { bedding(r).k_s = v * r.matrix.E_c / bedding(r).spacing; },
    &joint_k_s};

const MapVariable persistence = {"persistence",
                                 0.2,
                                 0.95,
                                 true,
                                 [](const Recipe& r) { return bedding(r).persistence; },
                                 [](Recipe& r, double v) { bedding(r).persistence = v; }};
bool share_was_mapped(const Recipe& bridged) {
  return std::fabs(persistence.normalised(persistence.get(bridged))) <= 1.0 + 1e-9;
}
/// Contact by contact is a patch as long as a grain.
const MapVariable patch_length = {
    "patch/diameter",
    1.0,
    12.0,
    true,
    [](const Recipe& r) { return std::max(1.0, bedding(r).patch_length / grain_size(r)); },
    [](Recipe& r, double v) { bedding(r).patch_length = v * grain_size(r); },
    nullptr,
    true};

const MapVariable stiffness_along = of_matrix<&MatrixRecipe::stiffness_ratio>({.name = "stiffness ratio",
                                                                               .low = 1.0,
                                                                               .high = 4.0,
                                                                               .logarithmic = true,
                                                                               .parameter = &stiffness_ratio,
                                                                               .at_base = false});
std::vector<MapVariable> operator+(std::vector<MapVariable> list, const std::vector<MapVariable>& more) {
  list.insert(list.end(), more.begin(), more.end());
  return list;
}
// In the order in which they are set: what is a ratio to another comes behind it.
std::vector<MapVariable> matrix_strength() {
  return {variable_of<&matrix_tau_c>("tau_c/sigma_c"), variable_of<&matrix_mu>("mu")};
}
std::vector<MapVariable> parallel_bond() { return {contact_ratio, moment, bond_friction, strength_scatter}; }
std::vector<MapVariable> flat_joint() { return {contact_ratio, bond_friction, strength_scatter, slits}; }
std::vector<MapVariable> planes() {
  return {variable_of<&joint_cohesion>("C/tau_c"),
          variable_of<&joint_sigma_n>("sigma_n/C"),
          variable_of<&joint_mu>("mu_sj"),
          plane_spacing,
          joint_normal,
          joint_shear};
}
std::vector<MapVariable> bridges() { return {persistence, patch_length}; }
std::vector<MapVariable> directed_strength() {
  // a calibration seeks the two ratios in wider boxes, where the regressions extrapolate
  return {of_matrix<&MatrixRecipe::tension_ratio>({.name = "tension ratio",
                                                   .low = 1.0 / 3.0,
                                                   .high = 3.0,
                                                   .logarithmic = true,
                                                   .parameter = &tension_ratio,
                                                   .at_base = false}),
          of_matrix<&MatrixRecipe::cohesion_ratio>({.name = "cohesion ratio",
                                                    .low = 0.2,
                                                    .high = 5.0,
                                                    .logarithmic = true,
                                                    .parameter = &cohesion_ratio,
                                                    .at_base = false}),
          variable_of<&cohesion_oblique>("cohesion oblique")};
}
std::vector<MapVariable> directions() {
  return std::vector<MapVariable>{stiffness_along} + directed_strength();
}

/// 16 x 32 mm of 1,321 discs: porosity 0.08, the density of the paper's packing.
Recipe sound_rock(MatrixModel model) {
  Recipe r;
  r.specimen.width = 16e-3, r.specimen.height = 32e-3;
  r.packing.n_grains = 1321;
  r.matrix.model = model;
  // the scale is free: all answers are in units of sigma_c and E_c
  r.matrix.sigma_c = r.matrix.tau_c = 50e6;
  r.matrix.sigma_c_sd = r.matrix.tau_c_sd = 5e6;
  return r;
}

Recipe bedded_rock(MatrixModel model, BeddingRule rule) {
  Recipe r = sound_rock(model);
  r.bedding.resize(1);
  r.bedding[0].rule = rule, r.bedding[0].zone_thickness = 0.9 * grain_size(r);
  return r;
}

Recipe bridged_rock() {
  Recipe r = bedded_rock(MatrixModel::parallel_bond, BeddingRule::crossing);
  r.bedding[0].persistence = usual_persistence;
  return r;
}

}  // namespace

double MapVariable::normalised(double value) const {
  const double share =
      logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return 2.0 * share - 1.0;
}

double MapVariable::from_normalised(double place) const {
  const double share = 0.5 * (place + 1.0);  // of the range
  return logarithmic ? low * std::pow(high / low, share) : low + share * (high - low);
}

bool MappedModel::has(const Recipe& r) const {
  // the rules lay joints on other contacts, and shares beyond the mapped ones are other rocks
  if (!model->has(r)) return false;
  return r.bedding.empty() ||
         (bedding(r).rule == bedding(base).rule && (!has_bridges(r) || share_was_mapped(r)));
}

const std::vector<MappedModel>& mapped_models() {
  constexpr auto parallel = MatrixModel::parallel_bond, flat = MatrixModel::flat_joint;
  constexpr auto crossing = BeddingRule::crossing, zone = BeddingRule::zone;
  using L = LayerModel;
  // names and variables are those of the tables: whoever changes one runs the maps again
  static const std::vector<MappedModel> all = {
      {"parallel-bond-crossing", "parallel bonds, planes by crossing", find_model(true, L::planes, parallel),
       bedded_rock(parallel, crossing), matrix_strength() + parallel_bond() + planes(), 320, 320},
      {"parallel-bond", "parallel bonds", find_model(false, L::planes, parallel), sound_rock(parallel),
       matrix_strength() + parallel_bond(), 48, 32},
      {"parallel-bond-directions", "parallel bonds with directions",
       find_model(true, L::directions, parallel), sound_rock(parallel),
       matrix_strength() + parallel_bond() + directions(), 384, 0},
      {"parallel-bond-zone", "parallel bonds, planes by zone", find_model(true, L::planes, parallel),
       bedded_rock(parallel, zone), matrix_strength() + parallel_bond() + planes(), 208, 320},
      {"parallel-bond-directions-crossing", "parallel bonds with directions of strength, planes by crossing",
       find_model(true, L::planes_and_directions, parallel), bedded_rock(parallel, crossing),
       matrix_strength() + parallel_bond() + planes() + directed_strength(), 640, 0},
      {"parallel-bond-bridges-crossing", "parallel bonds, planes with bridges by crossing",
       find_model(true, L::planes_with_bridges, parallel), bridged_rock(),
       matrix_strength() + parallel_bond() + planes() + bridges(), 320, 256},
      {"flat-joint", "flat joints", find_model(false, L::planes, flat), sound_rock(flat),
       matrix_strength() + flat_joint(), 32, 0},
      {"flat-joint-crossing", "flat joints, planes by crossing", find_model(true, L::planes, flat),
       bedded_rock(flat, crossing), matrix_strength() + flat_joint() + planes(), 208, 0},
      {"flat-joint-zone", "flat joints, planes by zone", find_model(true, L::planes, flat),
       bedded_rock(flat, zone), matrix_strength() + flat_joint() + planes(), 208, 0}};
  return all;
}

const MappedModel* mapped_model_of(const Recipe& recipe) {
  for (const MappedModel& m : mapped_models())
    if (m.has(recipe)) return &m;
  return nullptr;
}

}  // namespace phy::maps
