// What becomes of the moduli on the way to where a laboratory reads them.
//
// The direct solution gives E and nu of unbroken rock. A tangent or a secant of a test is another number:
// bonds, bridges and joints have broken or slipped by then. Both are taken on the same packing, so that what
// packings differ by drops out: s = E of the press / E of the direct solution, d = nu of the press - nu of
// the direct solution, one of each per inclination. s depends on the strengths, too: it is learnt from the
// tests of the search, as a linear function of the place in their box.
#pragma once
#include <map>
#include <vector>

#include "calibrate/evidence.hpp"
#include "calibrate/simulator.hpp"

namespace phy::calibrate {

struct Softening {
  double factor = 1.0, addition = 0.0;  ///< of E, to nu
};
using Softenings = std::map<double, Softening>;  ///< by the inclination [deg]
/// Between the inclinations that have one linear, beyond them as at the last; none at all: 1 and 0.
Softening softening_at(const Softenings& softenings, double theta);

class SofteningRecord {
 public:
  explicit SofteningRecord(ModulusReading reading) : reading_(reading) {}
  /// A test of UCS at an inclination and the solution of the same specimen. `z`: place in the box.
  void add(double theta, std::vector<double> z, const TestResult& test, const ElasticResult& solution);
  /// Where the search has come to. No entry where no test has said anything.
  Softenings at(const std::vector<double>& z) const;

 private:
  struct Pair {
    std::vector<double> z;
    double log_factor, addition;
  };
  ModulusReading reading_;
  std::map<double, std::vector<Pair>> pairs_;
};

/// Measured: tests of UCS of a recipe at the speed of a verification, on each of the packings.
Softenings softenings_of(const Recipe& recipe, const std::vector<Target>& strengths,
                         const std::vector<std::int64_t>& seeds, ModulusReading reading,
                         Simulator& simulator);

/// Do measured softenings differ from those that the moduli were fitted with by less than 1 % of E and 0.01
/// of nu?
bool settled(const Softenings& used, const Softenings& measured);
/// From those that were used towards those that were measured. Whole steps oscillate (each undoes half of the
/// one before), so two thirds of one are taken.
Softenings stepped(const Softenings& used, const Softenings& measured);

/// A table whose E and nu are what the direct solution must have for the press to give those of the
/// laboratory.
Evidence at_small_strain(const Evidence& evidence, const Softenings& softenings);

}  // namespace phy::calibrate
