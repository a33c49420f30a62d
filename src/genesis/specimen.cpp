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

void turn_layers(MatrixRecipe& matrix, std::vector<BeddingRecipe>& bedding, double theta) {
  const double turn = theta - inclination(matrix, bedding);
  const auto half_turns = [](double angle) { return std::floor(angle / 180.0); };
  // The first gets exactly the angle asked for: a + (b - a) need not round to b.
  if (matrix.directional()) {
    const double angle = bedding.empty() ? theta : matrix.foliation + turn;
    matrix.foliation = angle - 180.0 * half_turns(angle);
  }
  for (BeddingRecipe& set : bedding) {
    const double angle = &set == &bedding[0] ? theta : set.theta + turn;
    set.theta = angle - 180.0 * half_turns(angle);
    // A half turn changes the side that the normal points to, and the offset with it.
    if (std::fmod(std::abs(half_turns(angle)), 2.0) == 1.0) set.offset = -set.offset;
  }
}

std::vector<Specimen> make_specimens(std::shared_ptr<const Packing> packing, const Recipe& recipe) {
  if (!layered(recipe) && !recipe.test.angles.empty())
    throw InputError(Problem{"", "test.angles", std::to_string(recipe.test.angles.size()) + " angles",
                             "angles of layers", "add a [[bedding]] set or leave the angles out"});
  // Cut first: bonds and planes belong to what is left.
  packing = shaped(std::move(packing), recipe);
  std::vector<Specimen> specimens;
  std::vector<double> angles = recipe.test.angles;
  // Without a list the layers stand as they are.
  if (angles.empty() && layered(recipe)) angles.push_back(inclination(recipe));
  for (const double theta : angles) {
    MatrixRecipe matrix = recipe.matrix;
    std::vector<BeddingRecipe> bedding = recipe.bedding;
    turn_layers(matrix, bedding, theta);
    specimens.push_back(make_specimen(packing, matrix, std::move(bedding), specimen_name(theta)));
  }
  // Rock without layers is itself the intact specimen.
  if (recipe.test.intact || !layered(recipe))
    specimens.push_back(make_specimen(packing, recipe.matrix, {}, "intact"));
  // All have the same grains and contacts.
  check_in_one_piece(specimens.front(), recipe);
  return specimens;
}

}  // namespace phy::genesis
