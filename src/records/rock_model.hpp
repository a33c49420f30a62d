// What may stand for a rock: the one list of models, an object each. What makes the layers and what holds the
// grains together are told apart by the recipe alone; readers, choices, texts and maps are views of this
// list.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "records/recipe.hpp"

namespace phy {

/// The index of what a rock file may ask for as its layers: smooth joints on planes, directions of the bonds
/// (of stiffness and strength), joints on planes between bonds whose strength has directions, joints on a
/// share of the planes, the rest bonded (rock bridges), or whichever predicts values of the table best that
/// it was not shown.
enum class LayerModel { choose, planes, directions, planes_and_directions, planes_with_bridges };
/// Its word in the rock file: "planes with bridges".
const char* to_string(LayerModel model);

struct RockModel {
  bool layered;        ///< of rock with bedding
  LayerModel layers;   ///< what a rock file asks for; planes of rock without layers
  MatrixModel matrix;  ///< what holds the grains together
  /// What its recipe has.
  bool joints = false;        ///< on planes
  bool bridges = false;       ///< of bonds between them: a share of the planes is jointed
  bool directions = false;    ///< of the bonds
  const char* words;          ///< "joints on {} of the planes", the share
  const char* sentence = "";  ///< for the methods section
  /// What it contains: with more to fit with it is often a little better by chance.
  const RockModel* contains = nullptr;

  /// Is a recipe one of this model?
  bool has(const Recipe& recipe) const;
};

/// In the order in which they are compared; the first that a rock admits is taken where nothing can be
/// compared.
std::span<const RockModel> rock_models();
/// The model of a recipe; nullptr: no calibration knows it.
const RockModel* model_of(const Recipe& recipe);
/// nullptr: there is no such combination.
const RockModel* find_model(bool layered, LayerModel layers, MatrixModel matrix);
/// "joints on 0.6 of the planes"; nullopt: of shares still to be compared, "joints on a share of the planes".
std::string text_of(const RockModel& model, std::optional<double> jointed_share);

/// What makes the layers of a recipe that has some, whatever holds its grains.
LayerModel layers_of(const Recipe& recipe);
/// Do bonds have directions?
bool is_directed(LayerModel model);
/// The words of all layers that a matrix has: "planes".
std::vector<const char*> layers_of_matrix(MatrixModel matrix);
/// Is there no such model of flat joints?
bool of_parallel_bonds(LayerModel model);

/// Are the planes jointed in part, with bridges of bonds between?
bool has_bridges(const Recipe& recipe);
/// The share of the planes that is jointed: 1 of whole planes, and where there are none.
double jointed_share(const Recipe& recipe);

}  // namespace phy
