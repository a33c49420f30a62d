// What becomes of the moduli on the way to where a laboratory reads them.
//
// The direct solution gives E and nu of unbroken rock. A tangent or a secant of a test is another number:
// bonds, bridges and joints have broken or slipped by then. Both are taken on the same packing, so that what
// packings differ by drops out: s = E of the press / E of the direct solution, d = nu of the press - nu of
// the direct solution, one of each per inclination and confining stress: a stress on the sides closes what
// would open and holds what would slip. They depend on the strengths, too (read_moduli.hpp).
#pragma once
#include <compare>
#include <map>
#include <optional>
#include <vector>

#include "calibrate/simulator.hpp"
#include "records/evidence.hpp"

namespace phy::calibrate {

struct Softening {
  double factor = 1.0, addition = 0.0;  ///< of E, to nu
};
/// A test in compression that moduli are read from.
struct TestRead {
  double confining = 0.0;  ///< [Pa]
  double theta = 0.0;      ///< [deg]
  auto operator<=>(const TestRead&) const = default;
};
/// The one that a modulus, or a strength in compression, belongs to.
TestRead test_of_cell(const Target& t);

using Softenings = std::map<TestRead, Softening>;
/// Of the tests under the nearest confining stress: between their inclinations linear, beyond them as at the
/// last. None at all: 1 and 0.
Softening softening_at(const Softenings& softenings, const TestRead& test);

/// The tests that moduli are read in: those of UCS, and under the confining stresses under which the table
/// has moduli, whether it has their strengths or not.
std::vector<Target> tests_to_read(const Evidence& evidence);

/// A test of `property` and the solution of the same specimen. Nothing: the test was not read there.
std::optional<Softening> softening_of(const TestResult& test, Property property,
                                      const ElasticResult& solution, ModulusReading reading);

/// The specimen as the elastic stage has it: `model` before strengths were sought. Slits that these have
/// sought are part of what tests make of the moduli.
Recipe as_for_moduli(Recipe specimen, const Recipe& model);

/// Which tests show it.
struct TestsToRead {
  const Recipe& recipe;
  const Recipe& model;        ///< of the elastic stage
  std::vector<Target> tests;  ///< strengths in compression
  std::vector<std::int64_t> packings;
  ModulusReading reading;
};
/// Measured: tests of a recipe at the speed of a verification, the mean over the packings.
Softenings softenings_of(const TestsToRead& read, Simulator& simulator);

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
