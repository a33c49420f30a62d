// The recipe: everything that a run depends on, in SI units and degrees. A recipe is completed (every default
// filled in) before anything is computed, and the completed recipe is saved beside every result. Keys, units,
// ranges, defaults and meanings are registered once, in recipe_schema.cpp; the reader, `phyllite recipe
// --explain` and docs/reference.md come from there. Defaults are the paper's specimen (docs/conventions.md,
// "The paper's specimen").
#pragma once
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.hpp"

namespace phy {

enum class RadiusDistribution { by_number, by_area };  ///< radii uniform by number, or by area fraction
/// Overlaps declared stress-free, or a locked-in stress.
enum class InitialStress { stress_free, isotropic };
enum class StiffnessConvention { pfc31, pfc5 };            ///< laws/linear/README.md
enum class ShearStrength { constant, cohesion_friction };  ///< laws/parallel_bond/README.md
enum class MatrixModel { parallel_bond, flat_joint };      ///< what holds grains of the matrix together
enum class BreakAt { centroid, edge };                     ///< laws/flat_joint/README.md
enum class BeddingRule { crossing, zone, oriented };       ///< which contacts become smooth joints
enum class Precision { double_precision, single_precision };
enum class GrainInertia { disc, equal };
/// Sides of a biaxial test: rigid walls, or pressure on side grains.
enum class Confinement { walls, jacket };

struct SpecimenSize {
  double width = 0.038;   ///< [m]
  double height = 0.076;  ///< [m]

  // What is taken out of the middle of it, or of the disc that is cut from it: a hole or a flaw.
  double hole_diameter = 0.0;  ///< [m] circular; 0: no hole
  double flaw_length = 0.0;    ///< [m] open, with both ends in the rock; 0: no flaw
  double flaw_angle = 0.0;     ///< [deg] from +x, anticlockwise; 0 <= flaw_angle < 180
  double flaw_width = 0.0;     ///< [m] 0: the largest grain diameter

  bool pierced() const { return hole_diameter > 0.0 || flaw_length > 0.0; }
};

struct PackingRecipe {
  double radius_min = 0.00025;   ///< [m]
  double radius_max = 0.000415;  ///< [m]
  RadiusDistribution distribution = RadiusDistribution::by_number;
  std::int64_t n_grains = 7481;  ///< 0: the number follows from `porosity`
  double porosity = 0.0;         ///< 0: the porosity follows from `n_grains`
  InitialStress initial_stress = InitialStress::stress_free;
  double isotropic_stress = 0.0;  ///< [Pa] used with `isotropic`
  std::int64_t seed = 1;
  std::string file;  ///< CSV of discs to import instead of making a packing
  /// Mean of the squares of the radii [m^2].
  double mean_square_radius() const {
    const double a = radius_min, b = radius_max;
    return distribution == RadiusDistribution::by_area ? a * b : (a * a + a * b + b * b) / 3.0;
  }
};

/// Discs touch where their gap is below this fraction of their mean radius: what relaxing a packing leaves
/// open by rounding (Potyondy & Cundall's tolerance).
constexpr double touch_tolerance = 1e-6;

/// Matrix: linear contacts and parallel bonds (paper Table 1), or flat joints of the modulus E_c.
struct MatrixRecipe {
  MatrixModel model = MatrixModel::parallel_bond;
  double density = 2700.0;  ///< grain density [kg/m^3]
  StiffnessConvention stiffness_convention = StiffnessConvention::pfc31;
  double E_c = 38e9;             ///< contact modulus [Pa]
  double ks_over_kn = 0.3;       ///< contact stiffness ratio
  double mu = 0.8;               ///< friction coefficient
  double E_b = 38e9;             ///< parallel-bond modulus [Pa]
  double bond_ks_over_kn = 0.3;  ///< parallel-bond stiffness ratio
  double radius_multiplier = 1.0;
  double moment_contribution = 1.0;
  ShearStrength shear_strength = ShearStrength::constant;
  double sigma_c = 65e6;           ///< bond tensile strength, mean [Pa]
  double sigma_c_sd = 6.5e6;       ///< its standard deviation [Pa]
  double tau_c = 65e6;             ///< bond shear strength (cohesion), mean [Pa]
  double tau_c_sd = 6.5e6;         ///< its standard deviation [Pa]
  double phi = 0.0;                ///< bond friction angle [deg], only with cohesion_friction
  double bond_gap = 0.0;           ///< bonds at gaps up to this [m], and always where discs touch
  double unbonded_fraction = 0.0;  ///< of these contacts: no bond; linear contact only, or a slit
  std::int64_t bond_seed = 1;
  bool unbreakable = false;  ///< bonds and joints never break and nothing slips (elastic comparison runs)

  // Flat joints (contact/flat_joint.hpp).
  std::int64_t elements = 3;             ///< of an interface, 1 to 4
  BreakAt break_at = BreakAt::centroid;  ///< where in an element the tensile strength is compared
  double gapped_fraction = 0.0;          ///< of the contacts: no bond, `initial_gap` apart
  double initial_gap = 0.0;              ///< [m]

  // Directions (contact/direction.hpp): values of contacts whose normal lies along the foliation over those
  // across it, their mean over all directions being the value above.
  double foliation = 0.0;         ///< [deg] from +x, anticlockwise; 0 <= foliation < 180
  double stiffness_ratio = 1.0;   ///< of E_c and E_b
  double tension_ratio = 1.0;     ///< of sigma_c
  double cohesion_ratio = 1.0;    ///< of tau_c
  double cohesion_oblique = 1.0;  ///< tau_c of contacts at 45 degrees over those along and across

  /// Differs with direction, so that it has layers to be turned.
  bool directional() const {
    return stiffness_ratio != 1.0 || tension_ratio != 1.0 || cohesion_ratio != 1.0 || cohesion_oblique != 1.0;
  }
  /// The widest gap at which two discs of this mean radius are bonded [m].
  double bond_reach(double mean_radius) const { return std::max(bond_gap, touch_tolerance * mean_radius); }
  /// Of all that a bonded contact has [Pa]; rock is nearly as stiff.
  double modulus() const {
    return model == MatrixModel::flat_joint ? radius_multiplier * E_c : E_c + radius_multiplier * E_b;
  }
};

/// One set of parallel bedding planes (paper Table 2), or with the oriented rule of dispersed joints
/// (genesis/bedding.hpp).
struct BeddingRecipe {
  double theta = 0.0;              ///< [deg] plane from +x, anticlockwise, load along y; 0 <= theta < 180
  double theta_sd = 0.0;           ///< [deg] standard deviation of theta from plane to plane
  double spacing = 0.005;          ///< [m] mean
  double spacing_sd = 0.0;         ///< standard deviation of the spacing, over the spacing
  double zone_thickness = 0.0006;  ///< [m] used by the zone rule
  double offset = 0.0;             ///< [m] distance of one plane from the specimen's centre, along its normal
  BeddingRule rule = BeddingRule::zone;
  bool bridges = true;              ///< zone rule: contacts across a plane but outside the zone stay bonded
  double orientation_range = 15.0;  ///< [deg] oriented rule: of a contact's normal from that of the set
  double persistence = 1.0;         ///< share of the planes that is jointed
  double patch_length = 0.0;        ///< [m] of jointed and bonded patches; 0: every contact for itself
  double layer_thickness = 0.0;     ///< [m] of a layer about each plane whose matrix is another; 0: none
  double layer_stiffness = 1.0;     ///< its E_c and E_b over those of the matrix
  double layer_strength = 1.0;      ///< its sigma_c and tau_c over those of the matrix
  double k_n = 3360e9;              ///< normal stiffness [Pa/m]
  double k_s = 960e9;               ///< shear stiffness [Pa/m]
  double mu = 0.4;                  ///< friction coefficient of the broken joint
  double sigma_n = 10e6;            ///< bonded tensile strength, mean [Pa]
  double sigma_n_sd = 0.0;          ///< its standard deviation [Pa]
  double cohesion = 30e6;           ///< bonded cohesion [Pa]
  double phi = 0.0;                 ///< bonded friction angle [deg]
  double psi = 0.0;                 ///< dilation angle [deg]; tan psi <= mu
  double radius_multiplier = 1.0;

  /// It has planes; else its joints are dispersed, and spacing and offset mean nothing.
  bool has_planes() const { return rule != BeddingRule::oriented; }
  /// Least distance of two planes [m]: spacings are drawn within three standard deviations.
  double narrowest() const { return spacing * (1.0 - 3.0 * spacing_sd); }
  /// Planes differ from each other in distance or direction.
  bool scatters() const { return has_planes() && (spacing_sd > 0.0 || theta_sd > 0.0); }
  /// Planes are parallel and equally far from each other.
  bool is_regular() const { return has_planes() && !scatters(); }
  /// It has no joints, only layers.
  bool unjointed() const { return has_planes() && persistence == 0.0; }
  /// Some of what makes a contact a joint is drawn, with matrix.bond_seed.
  bool is_drawn() const { return has_planes() && (persistence < 1.0 || scatters()); }
};

struct TestDescription;

/// One of the laboratory's tests; what it is and does, its description tells (records/test_description.hpp).
class TestKind {
 public:
  TestKind();                                ///< uniaxial compression, the first of the list
  explicit TestKind(std::string_view name);  ///< by its word, which has to be in the list
  TestKind(const TestDescription& test) : test_(&test) {}
  const TestDescription& operator*() const { return *test_; }
  const TestDescription* operator->() const { return test_; }
  bool operator==(const TestKind&) const = default;

 private:
  const TestDescription* test_;
};

struct TestRecipe {
  TestKind kind;
  /// [deg] one specimen per angle, turning bedding[0]; empty: the bedding as it stands
  std::vector<double> angles;
  bool intact = false;         ///< also a specimen without bedding
  double platen_speed = 0.05;  ///< [m/s] of each platen
  /// [-] strain up to which the platens move at approach_speed; 0: none
  double approach_strain = 0.0;
  double approach_speed = 0.0;  ///< [m/s] of each platen, above platen_speed; 0: no approach
  double ramp_strain = 2e-5;    ///< axial strain over which the speed rises from 0
  double platen_friction = 0.0;
  double stop_at = 0.6;                 ///< stop when the stress falls to this fraction of the peak
  double post_peak = 1.0;               ///< stop when the strain exceeds that of the peak by this fraction
  double max_strain = 0.01;             ///< stop (not peaked) at this axial strain
  std::int64_t history_interval = 100;  ///< steps between history rows; also the interval of all checks
  std::int64_t n_snapshots = 5;         ///< stored states of grains and contacts through the test
  std::int64_t n_frames = 40;           ///< stored displacement fields through the test
  bool events = false;                  ///< also acoustic events
  double event_thickness = 0.0;         ///< [m] that their magnitudes are of; 0: the mean grain diameter
  double pre_strain = 0.0;        ///< [-] axial strain of the affine pre-strain; 0: no affine pre-strain
  double grip_thickness = 0.0;    ///< [m] direct tension; 0: four times the largest radius
  double disc_diameter = 0.0;     ///< [m] of the disc, or half disc, cut from the specimen; 0: the most
  double loading_angle = 10.0;    ///< [deg] Brazilian: whole arc of each jaw; 0: flat platens
  double jaw_friction = 0.3;      ///< Brazilian: between disc and jaws
  double confining_stress = 0.0;  ///< [Pa] biaxial
  Confinement confinement = Confinement::walls;
  double normal_stress = 0.0;      ///< [Pa] direct shear
  double normal_stiffness = 0.0;   ///< [Pa/m] direct shear; 0: constant normal load
  double shear_gap = 0.0;          ///< [m] direct shear: free rock between the boxes; 0: rigid halves
  double notch_ratio = 0.5;        ///< semi-circular bend: length of the notch over the radius, a/R
  double notch_width = 0.0;        ///< [m] semi-circular bend; 0: the largest grain diameter
  double opening_diameter = 0.0;   ///< [m] opening; 0: a fifth of the smaller side
  double vertical_stress = 0.0;    ///< [Pa] opening: far field
  double horizontal_stress = 0.0;  ///< [Pa] opening: far field; 0: as the vertical one
  double internal_pressure = 0.0;  ///< [Pa] opening: on its wall, once excavated
  double span_ratio = 0.8;         ///< semi-circular bend: span of the supports over the diameter, s/(2R)

  /// Of an opening: horizontal and vertical stress far away [Pa].
  Vec2 far_field() const {
    return {horizontal_stress > 0.0 ? horizontal_stress : vertical_stress, vertical_stress};
  }
};

struct EngineRecipe {
  Precision precision = Precision::double_precision;
  double damping = 0.7;       ///< local damping coefficient alpha
  double step_safety = 0.92;  ///< fraction of the stable step 2/(omega_max sqrt(1 + alpha))
  GrainInertia grain_inertia = GrainInertia::disc;  ///< equal: all of the mean mass (engine/inertia.hpp)
};

struct Recipe {
  std::string name = "paper";
  SpecimenSize specimen;
  PackingRecipe packing;
  MatrixRecipe matrix;
  std::vector<BeddingRecipe> bedding;
  TestRecipe test;
  EngineRecipe engine;
  std::vector<std::string> notes;  ///< how the file was understood, for the user to see
};

/// Bedding planes or directions of the matrix: what test.angles turns. Rock without them is intact.
inline bool layered(const MatrixRecipe& matrix, const std::vector<BeddingRecipe>& bedding) {
  return !bedding.empty() || matrix.directional();
}
/// The stiffness differs from contact to contact, by directions or layers.
inline bool uneven_stiffness(const MatrixRecipe& matrix, const std::vector<BeddingRecipe>& bedding) {
  return matrix.stiffness_ratio != 1.0 ||
         std::any_of(bedding.begin(), bedding.end(),
                     [](const BeddingRecipe& b) { return b.layer_stiffness != 1.0; });
}
/// Inclination of layered rock [deg]: that of the first set of bedding or, without bedding, of the foliation.
inline double inclination(const MatrixRecipe& matrix, const std::vector<BeddingRecipe>& bedding) {
  return bedding.empty() ? matrix.foliation : bedding.front().theta;
}
/// The same of a recipe, or of a specimen.
template <class T>
bool layered(const T& of) {
  return layered(of.matrix, of.bedding);
}
template <class T>
double inclination(const T& of) {
  return inclination(of.matrix, of.bedding);
}

}  // namespace phy
