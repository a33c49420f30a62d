// The tests of a table: what the laboratory did to its specimens, done to specimens of the model.
//
// Every test has a platen speed of its own, at which a wave crosses its specimen a hundred times until the
// peak that the laboratory's strength leads to expect (of a half disc that is bent, two hundred times): tests
// side by side then end together. How they begin,
// and what the search of the strengths may do faster, is their Loading (docs/calibration.md, "Loading").
#pragma once
#include <limits>
#include <utility>
#include <vector>

#include "calibrate/simulator.hpp"
#include "records/calibration.hpp"

namespace phy::calibrate {

/// How tests are loaded. The way to the peak may begin with a fast approach (test.approach_strain).
struct Loading {
  double speed;     ///< of the platens, over the one at which a wave crosses the specimen a hundred times
  double approach;  ///< share of the expected peak strain, of discs at most as in as_measured; 0: none
};
/// As a laboratory does: tables of twins.
inline constexpr Loading from_rest = {1.0, 0.0};
/// Verification, softening at the estimate, the sequence: E at half of the strength is read from 40 % of it
/// on, also of a rock with 0.65 of the strength expected.
inline constexpr Loading as_measured = {1.0, 0.25};
/// Verification of strengths beside which no modulus is read.
inline constexpr Loading strengths_as_measured = {1.0, 0.6};
/// The search of the strengths, where it learns from its tests how E as read softens, and where it does not.
inline constexpr Loading search_with_moduli = {1.4, 0.25}, search_of_strengths = {1.4, 0.7};

/// How the same tests are loaded on several packings.
struct Loadings {
  Loading first, others;  ///< of the first packing, of those behind it
  /// Of each target for the others, as in StrengthTests::of(); empty: what the table has.
  std::vector<double> foreseen;
  Loadings(const Loading& all) : first(all), others(all) {}
  Loadings(const Loading& a, const Loading& b, std::vector<double> strengths)
      : first(a), others(b), foreseen(std::move(strengths)) {}
};
/// Of the verification. Curves are shown of its first packing, and where no modulus of the table is read in
/// its tests, E at half of the strength is of that one alone.
Loadings of_verification(bool reads_moduli, std::vector<double> foreseen);

/// The tests for one packing each.
class StrengthTests {
 public:
  /// `recipe`: with test_settings(); the moduli on the packing `seed` say at which strain each target peaks.
  StrengthTests(const Recipe& recipe, const std::vector<Target>& targets, std::int64_t seed,
                Simulator& simulator);
  /// The same with the moduli [Pa] at the angles of the targets, where they are known.
  StrengthTests(const Recipe& recipe, const std::vector<Target>& targets, const std::vector<double>& moduli);
  /// `foreseen`: strength that the specimen may be too weak to exceed [Pa]; its approach ends earlier then.
  Recipe of(const Recipe& recipe, std::size_t target, std::int64_t seed, const Loading& loading,
            double foreseen = std::numeric_limits<double>::infinity()) const;
  /// At which a target is expected to peak, in the measure of its test.
  double peak_strain(std::size_t target) const { return strains_[target]; }

 private:
  std::vector<Target> targets_;
  std::vector<double> strains_, speeds_;
  std::vector<bool> reads_before_;  // something before UCS: no approach may jump over it
};

/// Strength of a test [Pa], K_Ic [Pa sqrt(m)]; NaN if it has none.
double strength_of(const TestResult& result, Property property);

/// E [Pa] of a test of a strength in compression as the laboratory reads it, over the stress that the platens
/// bring on, q = sigma_1 - sigma_3 under confinement; NaN without a strength.
double modulus_of(const TestResult& result, Property property, ModulusReading reading);

/// The tests of a table on packings, of which more may be taken: each is done once. A recipe that keeps
/// pictures has them of the tests of UCS on the first packing, and no others.
class TestSeries {
 public:
  TestSeries(Recipe recipe, std::vector<Target> targets, std::int64_t first_packing, Loadings loadings,
             Simulator& simulator);
  void take(const std::vector<std::int64_t>& packings);
  /// Means over the packings.
  std::vector<Comparison> strengths() const;
  /// E as `reading` has it and nu (over 40 - 60 % of the strength) of the tests in compression, of those
  /// packings that are approached no farther than the first; their targets have no values.
  std::vector<Comparison> moduli(ModulusReading reading) const;

 private:
  Recipe recipe_;
  std::vector<Target> targets_;
  std::int64_t first_packing_;
  Loadings loadings_;
  Simulator& simulator_;
  StrengthTests tests_;
  std::vector<std::vector<TestResult>> results_;  // by target, then packing
  std::vector<std::vector<double>> approach_;     // their strains

  Recipe recipe_of(std::size_t target, std::int64_t packing) const;
};

/// Mean strengths of a recipe at the targets over packings.
std::vector<Comparison> strength_response(const Recipe& recipe, const std::vector<Target>& targets,
                                          const std::vector<std::int64_t>& packings, const Loadings& loadings,
                                          Simulator& simulator);

/// Settings of the tests of a rock: single precision, grains of equal mass, no snapshots, and the slowest of
/// the platen speeds of its tests of UCS (of those under confinement where there are no others), so that one
/// recipe suits all angles. `all`: their strength over the modulus of the recipe (direct solution on the
/// packing `seed`) is the strain of the peak.
Recipe test_settings(const Recipe& recipe, const std::vector<Target>& all, std::int64_t seed,
                     Simulator& simulator);
/// The same for these targets alone, with the moduli [Pa] at their angles.
Recipe test_settings(Recipe recipe, const std::vector<Target>& targets, const std::vector<double>& moduli);

/// The same specimen with fewer, larger grains: planes, zone and joint stiffness in proportion, so that all
/// dimensionless numbers stay.
Recipe coarse(Recipe recipe);
/// What a coarse packing makes of a property at the same bonds by the size of its grains alone: K_Ic grows
/// with the root of it, strengths stay.
double coarse_growth(Property property);
/// Are there grains enough for a coarse packing?
bool has_coarse(const Recipe& recipe);

}  // namespace phy::calibrate
