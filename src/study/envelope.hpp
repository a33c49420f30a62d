// Strength envelope: the specimens of a recipe under several confining stresses.
//
// Every specimen (bedding angles, intact rock) goes through one biaxial test per confining stress; without
// confining stress that is the uniaxial press (lab/biaxial/biaxial.hpp). Peaks give Mohr-Coulomb and
// Hoek-Brown per specimen (theory/envelope_fit.hpp); over all angles and stresses one plane of weakness
// (Jaeger, in the strongest specimen's Mohr-Coulomb rock) and k(theta) of Saroglou & Tsiambaos, with m_i of
// the specimen whose planes lie nearest to across the load, within 15 degrees; without one there is no k. A
// test that hardens is read at its knee (analysis/strength_rule.hpp), and is named. A test with neither peak
// nor knee gives no reading, nor does an untrusted one (records/quality.hpp) unless asked for.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "analysis/strength_rule.hpp"
#include "base/nan.hpp"
#include "records/recipe.hpp"
#include "records/result.hpp"
#include "theory/envelope_fit.hpp"
#include "theory/jaeger_fit.hpp"

namespace phy::study {

/// The specimens of the recipe and their tests: results[i][k] is specimen k under confining[i] [Pa].
struct EnvelopeTests {
  std::vector<double> confining;
  std::vector<std::vector<TestResult>> results;
};

/// What gave the strength of a test; nothing where it does not say.
std::optional<analysis::StrengthRule> rule_of(const TestResult& result);

/// The recipe of the tests under one confining stress [Pa].
Recipe confined_recipe(Recipe recipe, double confining_stress);

/// One specimen over all confining stresses.
struct SpecimenEnvelope {
  std::string name;
  bool intact = false;
  double theta = 0.0;                             ///< [deg]
  std::vector<theory::EnvelopeReading> readings;  ///< of the tests with a peak or a knee
  std::vector<double> knees;                      ///< sigma_3 of those with a knee [Pa]
  theory::MohrCoulombFit mohr_coulomb;
  theory::HoekBrownFit hoek_brown;
  theory::Estimate k;  ///< Saroglou & Tsiambaos; NaN for the intact rock
};

struct Envelope {
  std::vector<SpecimenEnvelope> specimens;
  std::string matrix;  ///< name of the specimen taken as the matrix in Jaeger's theory
  theory::JaegerFit plane;
  double m_i = nan;  ///< of the specimen with k = 1
};

/// `recipe`: of the rock; without planes of weakness in it (records/jointed.hpp) none is fitted.
Envelope fit_envelope(const EnvelopeTests& tests, const Recipe& recipe);

/// Untrusted tests as if they had peaked and nothing more: for those who ask for fits with them.
EnvelopeTests with_untrusted(EnvelopeTests tests);

}  // namespace phy::study
