// What a calibration has to go by: a rock and its table, read as targets once for all that follows.
#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "records/rock.hpp"

namespace phy {

/// What a rock measures its parameters by: boxes of quantities are multiples of these
/// (records/parameters.hpp).
struct Scales {
  double modulus = 0.0;    ///< largest E of the table [Pa]; 0 without E
  double stiffness = 0.0;  ///< that over the spacing of the planes [Pa/m]; 0 without bedding
  double strength =
      0.0;  ///< largest strength without confinement [Pa], expected where none was tested; 0: none
};

struct Evidence {
  Rock rock;
  std::vector<Target> targets;    ///< in the order of targets_of()
  std::vector<Target> moduli;     ///< of these, E and nu: against the direct solution
  std::vector<Target> strengths;  ///< of these, those that the program can test: against the press
  std::vector<Target> compared;   ///< K_Ic where nobody has stated the size of the grains: tested, not fitted
  /// Tests under a confining stress that the table has moduli of and no strength: done to read the moduli in,
  /// with the strength that is expected there.
  std::vector<Target> read_only;
  Scales scales;
  bool maps = true;  ///< what maps of models tell before the first test counts (maps/prior_regression.hpp)

  explicit Evidence(const Rock& of);
  /// With targets that are not the rock's own readings.
  Evidence(Rock of, std::vector<Target> read);
  /// Is there a value between two inclinations [deg], both included?
  bool has(Property property, double from = -infinity, double to = infinity) const;
  std::int64_t n_compressive() const;  ///< of the strengths: UCS, and strengths under confinement
  std::int64_t n_tests() const;        ///< behind the strengths of one packing: some are read in one test
  /// Strengths are fitted where there is one in compression: it tells sigma_c.
  bool fits_strength() const { return n_compressive() > 0; }
  /// Is there UCS, or a strength under confinement, between two inclinations [deg]?
  bool compressed(double from = -infinity, double to = infinity) const {
    return has(Property::ucs, from, to) || has(Property::confined, from, to);
  }

 private:
  void add_read_only();
  static constexpr double infinity = std::numeric_limits<double>::infinity();
};

/// Least errors with which E (relative) and nu of a table are taken.
constexpr double least_error_E = 0.005, least_error_nu = 0.005;

/// Standard error with which an E or nu counts: the laboratory's, but no less than what is taken at least.
double counted_error(const Target& modulus);

/// Is a strength expected of models before any test (maps/prior_regression.hpp), whatever the size of their
/// grains?
inline bool is_expected(const Target& t) {
  return t.confining == 0.0 && measured(t.property).grain_exponent == 0.0;
}
/// Can models of the layers be compared by these strengths? Four that are expected, UCS among them: one is
/// left out, and three others have to say something of it.
bool shows_layers(const std::vector<Target>& strengths);

/// Relative change of E from the least to the largest confining stress, where it is more than chance and than
/// twice the tolerance of E. Bonds are as stiff under any stress, so that no model without layers has it
/// before its peak.
std::optional<double> change_under_confinement(const std::vector<Target>& targets, ModulusReading reading);

/// UCS, or where a table has none between two inclinations strength under confinement.
Property compression_of(const Evidence& evidence, double from = 0.0, double to = 90.0);

}  // namespace phy
