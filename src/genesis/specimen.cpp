#include "genesis/specimen.hpp"

#include <cmath>
#include <utility>

#include "base/check.hpp"
#include "genesis/bedding.hpp"
#include "genesis/bond.hpp"
#include "genesis/cut.hpp"
#include "records/specimen_record.hpp"

namespace phy::genesis {
Specimen make_specimen(std::shared_ptr<const Packing> packing, const MatrixRecipe& matrix,
                       std::vector<BeddingRecipe> bedding, std::string name) {
  PHY_CHECK(packing != nullptr, "a specimen is made from a packing");
  Specimen s;
  s.name = std::move(name);
  s.packing = std::move(packing);
  s.matrix = matrix;
  s.bedding = std::move(bedding);
  s.contacts = bond(*s.packing, matrix);
  lay_bedding(s);
  return s;
}

std::vector<BeddingRecipe> turned(std::vector<BeddingRecipe> bedding, double theta) {
  if (bedding.empty()) return bedding;
  const double turn = theta - bedding[0].theta;
  for (BeddingRecipe& set : bedding) {
    // The first set gets exactly the angle asked for: a + (b - a) need not round to b.
    const double angle = &set == &bedding[0] ? theta : set.theta + turn;
    const double half_turns = std::floor(angle / 180.0);
    set.theta = angle - 180.0 * half_turns;
    if (std::fmod(std::abs(half_turns), 2.0) == 1.0) set.offset = -set.offset;
  }
  return bedding;
}

std::vector<Specimen> make_specimens(std::shared_ptr<const Packing> packing, const Recipe& recipe) {
  const std::vector<BeddingRecipe>& bedding = recipe.bedding;
  if (bedding.empty() && !recipe.test.angles.empty())
    throw InputError(Problem{"", "test.angles", std::to_string(recipe.test.angles.size()) + " angles",
                             "angles of a bedding", "add a [[bedding]] set or leave the angles out"});
  packing = shaped(std::move(packing), recipe);
  std::vector<Specimen> specimens;
  for (const double theta : recipe.test.angles)
    specimens.push_back(make_specimen(packing, recipe.matrix, turned(bedding, theta), specimen_name(theta)));
  if (recipe.test.angles.empty() && !bedding.empty())
    specimens.push_back(make_specimen(packing, recipe.matrix, bedding, specimen_name(bedding[0].theta)));
  if (recipe.test.intact || bedding.empty())
    specimens.push_back(make_specimen(packing, recipe.matrix, {}, "intact"));
  return specimens;
}

}  // namespace phy::genesis
