// Golden hashes: a small scene through every kind of test, with every contact model, in both precisions, and
// the arithmetic of calibrations. The hashes that the tests of this program have met are taken into it
// (tests/recorded.txt), so that anybody can see whether a build, a compiler or a processor gives the numbers
// that were tested.
#pragma once
#include <string>
#include <vector>

#include "records/recipe.hpp"
#include "study/work.hpp"

namespace phy::verification {

/// One specimen of the scene, and its test.
struct GoldenTest {
  std::string name;  ///< "uniaxial/flat_joint/double"
  Recipe recipe;
};

/// Every kind of the list of tests with every line of the list of contact models in every precision: what
/// comes to a list comes here. All are of one packing.
const std::vector<GoldenTest>& golden_tests();

struct GoldenHash {
  std::string name;      ///< its line in tests/recorded.txt: "golden/" and the name of the test
  std::string hash;      ///< of this program on this machine
  std::string recorded;  ///< empty: none was written down
  bool equal() const { return hash == recorded; }
};

/// The hash of the packing, those of golden_tests(), as many at a time as there are threads, and those of a
/// covariance of 150 unknowns and of quantiles. None is there if `stop` says true in between.
std::vector<GoldenHash> golden_hashes(const study::MachineOptions& machine,
                                      const std::atomic<bool>* stop = nullptr);

}  // namespace phy::verification
