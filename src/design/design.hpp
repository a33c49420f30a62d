// Constants of a calibrated rock for other codes: from the tests of the draws of its calibration, part by
// part. What stands beside them (what two dimensions cannot give, errors, the laboratory's own values) is
// findings.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "design/codes.hpp"
#include "design/draws.hpp"
#include "design/elasticity.hpp"
#include "design/strength.hpp"
#include "records/finding.hpp"
#include "records/rock.hpp"

namespace phy::design {

/// Of one draw, on its packing.
struct DrawTests {
  std::vector<ElasticPoint> elasticity;  ///< small strain, direct solution
  StrengthPoints compression;            ///< peaks
  StrengthPoints tension;                ///< direct tension [Pa] in `ucs`, across the planes and along them
  /// Standard deviation of the logarithm of a factor on all strengths in compression, which nobody knows: how
  /// far the rock may lie from them.
  double unknown_factor = 0.0;
};

struct DesignTests {
  std::string rock;
  bool weak_planes = true;       ///< the model has joints on planes
  std::vector<double> stresses;  ///< [Pa] on the sides, the range of the constants
  std::vector<DrawTests> draws;
  std::vector<DrawTests> simulated = {};               ///< of rock: as the model gave them, in the same order
  std::vector<Target> laboratory = {};                 ///< the table of the calibration
  ModulusReading E_is = ModulusReading::small_strain;  ///< what that table calls E
  ElasticReadingOf2D reading = {};
  /// Strengths are the rock's: the model's times what it misses of the table (calibrate/discrepancy.hpp).
  bool of_rock = false;
  bool strengths_sought = true;                ///< the calibration fitted strengths, so they were tested
  std::vector<std::string> undetermined = {};  ///< tests that the calibration's verdict leaves open
  std::size_t n_without_strength = 0;          ///< tests
  double dip = 0.0;                            ///< [deg] of the planes where the constants will be used
};

struct Design {
  DesignTests tests;
  std::array<Pooled, n_parts> parts;
  std::vector<Finding> findings;

  const Pooled& part(Part p) const { return parts[static_cast<std::size_t>(p)]; }
  Values values() const;
};

Design design_of(DesignTests tests);

}  // namespace phy::design
