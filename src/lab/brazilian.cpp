#include "lab/brazilian.hpp"

#include "genesis/cut.hpp"

namespace phy {

BrazilianTest::BrazilianTest(const std::shared_ptr<const Specimen>& specimen, const Recipe& recipe,
                             LaneGroup& group, int lane)
    : LabTest(specimen, recipe, group, lane) {
  begin();
}

void BrazilianTest::drive() { close_platens(disc_diameter(recipe_)); }

AnalysisOptions BrazilianTest::analysis() const {
  AnalysisOptions options;
  options.disc_diameter = disc_diameter(recipe_);
  return options;
}

}  // namespace phy
