// What a laboratory measures on a rock: the one list of properties, an object each. Readers, tables,
// pictures, tests, maps and margins are views of it; whoever has a question about a property asks its object.
//
// Only what truly speaks of one property names it: Eq. 1 reads E, a plane in Jaeger's sense is seen in UCS.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/units.hpp"

namespace phy {

/// The index of the list.
enum class Property {
  E,                   ///< modulus of deformation [Pa]
  nu,                  ///< apparent Poisson's ratio [-]
  ucs,                 ///< uniaxial compressive strength [Pa]
  direct_tension,      ///< direct tensile strength [Pa]
  brazilian,           ///< Brazilian tensile strength 2 P/(pi D t) [Pa]
  confined,            ///< strength under confining stress, sigma_1 at the peak [Pa]
  crack_initiation,    ///< axial stress in the test of UCS at which crack volumetric strain begins [Pa]
  fracture_toughness,  ///< in mode I, of a semi-circular bend test [Pa sqrt(m)]
  point_load,          ///< point load strength index I_s(50) [Pa]
  shear_peak,          ///< peak shear strength of bedding in direct shear [Pa]
  shear_residual       ///< shear stress at which it slides behind the peak [Pa]
};
constexpr int n_properties = 11;

/// What of a model a property judges: causes of a misfit are sought part by part.
enum class Part { moduli, compression, tension, initiation, toughness, bedding };
constexpr int n_parts = 6;

/// The unit in which people read a property, the factor from SI, and the digits behind the point there.
struct ShownUnit {
  double factor;
  const char* name;
  int digits;
};

/// Values that can be computed with at all, as readers say it.
struct PossibleValues {
  double low, high;
  const char* text;
};

/// How far a rock may lie from what maps expect of a strength, in units of the logarithm; slope and curvature
/// per half box (calibrate/surrogate.hpp).
struct PriorWidth {
  double constant = 0.0, slope = 0.0, curvature = 0.0;
};

/// Columns of the maps (data/maps), without the inclination; nullptr: not mapped.
struct MapColumns {
  const char* as_read = nullptr;       ///< of a test: strengths, and moduli at half of the strength
  const char* small_strain = nullptr;  ///< of moduli
  bool layered = true;                 ///< mapped of layered rock, too
};

struct MeasuredProperty {
  Property property;
  /// As people call it.
  const char* name;                                ///< of its column, and in files: "UCS"
  const char* test_name;                           ///< of what a laboratory does: "direct tension"
  const char* meaning;                             ///< for the list of columns
  std::vector<const char*> headers;                ///< what laboratories call that column
  std::vector<const char*> deviator_headers = {};  ///< the same of the value less the confining stress
  const char* axis;                                ///< in pictures (report/figure.hpp)
  /// The number.
  Dimension dimension = Dimension::pressure;
  ShownUnit shown = {1e-6, "MPa", 1};
  PossibleValues possible = {1e3, 5e9, "1 kPa <= strength <= 5 GPa"};
  bool absolute = false;  ///< misses and scatter count as they are, else relative to the value
  /// How it is judged: misses that pass whatever the scatter, the least error that matters, and the scatter
  /// of single specimens before a table is seen.
  Part part;
  double tolerance, coarsest, usual_scatter;
  /// The laboratory test that answers it, and by which number; nullptr: the direct solution.
  const char* test = nullptr;
  const char* number = nullptr;
  double share = 1.0;  ///< of that number, where an empirical relation stands in for the test itself
  /// Read in the test of another strength, at the same inclination and under the same stress.
  std::optional<Property> read_in = std::nullopt;
  bool of_discs = false;      ///< tested on discs or halves of discs, whose diameter the table may have
  bool under_stress = false;  ///< values under confining stress are fitted, not only kept
  /// Sheared along the bedding, under a stress across it: its rows have no inclination.
  bool along_bedding = false;
  /// It is pulled a quarter turn from its load: a disc splits along the load.
  bool splits = false;
  /// At the same bonds it grows with the size of the grains to this power: fitted only where that size is
  /// stated.
  double grain_exponent = 0.0;
  MapColumns map = {};
  PriorWidth prior = {};

  bool is_strength() const { return part != Part::moduli; }
  /// A stress, so that it scales with all strengths of the bonds.
  bool is_stress() const { return dimension == Dimension::pressure; }
};

/// In the order of Property.
std::span<const MeasuredProperty> measured_properties();
const MeasuredProperty& measured(Property property);
/// The property of a name, "K_Ic"; nullptr: none.
const MeasuredProperty* find_property(std::string_view name);
/// The property that a number of a test answers; nothing: no laboratory reports it.
std::optional<Property> property_of(std::string_view test, std::string_view number);

// One-line views, for the questions that are asked most.
inline const char* to_string(Property p) { return measured(p).name; }
inline ShownUnit shown_unit(Property p) { return measured(p).shown; }
inline std::string si_unit(Property p) { return inner_unit(measured(p).dimension); }
inline bool is_strength(Property p) { return measured(p).is_strength(); }
inline bool is_tensile(Property p) { return measured(p).part == Part::tension; }
inline bool is_compressive(Property p) { return measured(p).part == Part::compression; }

}  // namespace phy
