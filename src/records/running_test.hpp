// A test that is under way, as those see it who watch: it changes nothing in the test.
#pragma once
#include <functional>
#include <vector>

#include "records/recipe.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"

namespace phy {

/// How a specimen is at one moment.
struct SpecimenNow {
  Frame moved;
  std::vector<CrackEvent> cracks;  ///< so far; without their strains, which a test knows at its end
};

/// After a block of cycles. What it refers to lives as long as the call that hands it over.
struct RunningTest {
  const Specimen& specimen;  ///< one and the same from the test's beginning to its end
  const Recipe& recipe;
  double strain = 0.0, stress = 0.0;  ///< what the stop rule watches, growing [1], [Pa]; 0 before loading
  bool over = false;                  ///< this was its last block
  std::function<SpecimenNow()> look = {};  ///< copies all grains: not to be called after every block
};

}  // namespace phy
