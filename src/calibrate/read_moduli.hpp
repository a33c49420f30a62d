// E and nu as a laboratory reads them, over the box of the strengths.
//
// How far a test softens before E is read depends on the strengths (softening.hpp). The moduli follow: they
// are fitted anew to what the direct solution has to have. Two things they cannot follow, so these belong to
// what is wanted of the strengths:
// - a course of the softening over the inclination that stiffnesses do not have. With h of them (E_c and
//   those of layers) log E(theta) takes the shape of h harmonics of 2 theta; what is left of
//   log E_lab - log E_read beside these is missed for good.
// - cracks that spread a specimen to more than half of nu: no elastic solution with that little is left.
// Surrogates learn both from the search's own tests, per inclination and confining stress, as they learn
// strengths: over the places of the ratios and, under a confining stress, that of sigma_c beside them.
#pragma once
#include <Eigen/Core>
#include <map>
#include <span>
#include <vector>

#include "calibrate/softening.hpp"
#include "calibrate/surrogate.hpp"
#include "records/calibration.hpp"

namespace phy::calibrate {

class ReadModuli {
 public:
  /// A value of the table that strengths can miss.
  struct Miss {
    Property property;
    double error;     ///< laboratory less model: of log E, of nu
    double variance;  ///< of what is known of the model
    double scatter;   ///< squared, of the laboratory's mean, in the same units
  };

  explicit ReadModuli(const Evidence& evidence);
  /// Are moduli read from the tests of a strength?
  bool reads(const Target& strength) const;
  /// A test of a strength in compression and the solution of the same specimen. `where`: inputs of that
  /// strength's surrogate and packing; its answer is found here.
  void add(const Target& strength, const SurrogateRun& where, const TestResult& test,
           const ElasticResult& solution);
  /// From all tests so far; to be called before what follows.
  void learn();
  /// What the direct solution has for the moduli of the table, in its order, with the stiffnesses of the
  /// hour.
  void take_solution(const std::vector<Comparison>& moduli);
  /// Where the search has come to. No entry where no test has said anything. `z`, here and below: places of
  /// the ratios, then that of sigma_c.
  Softenings at(std::span<const double> z) const;
  /// Empty before the first solution; as many at every place.
  std::vector<Miss> misses(std::span<const double> z) const;

 private:
  struct Answers {
    std::vector<SurrogateRun> factors, additions;  // logarithms; of nu
    std::vector<Surrogate> learnt;                 // of both
  };
  struct Value {
    Target target;
    double solution;  // log E, nu
    double scatter;   // squared, of the laboratory's mean
  };
  ModulusReading reading_;
  std::vector<Target> moduli_, read_;  // and the strengths in whose tests they are read
  Eigen::Index n_harmonics_;
  std::map<TestRead, Answers> tests_;
  std::vector<Value> E_, nu_;     // where tests have answered
  Eigen::MatrixXd left_, known_;  // what harmonics leave of values of E; and its squares

  void find_left();
  Eigen::Index n_followed() const;
};

}  // namespace phy::calibrate
