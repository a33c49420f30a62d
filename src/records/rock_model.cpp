#include "records/rock_model.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace phy {
namespace {

/// By what a recipe has, whatever holds its grains.
bool has_layers_of(const RockModel& m, const Recipe& r) {
  return m.joints == !r.bedding.empty() && m.directions == r.matrix.directional() &&
         m.bridges == has_bridges(r);
}

constexpr auto parallel = MatrixModel::parallel_bond, flat = MatrixModel::flat_joint;

// an array of the language, in which an entry may name another
const RockModel models[] = {
    {.layered = false, .layers = LayerModel::planes, .matrix = parallel, .words = "parallel bonds"},
    {.layered = false, .layers = LayerModel::planes, .matrix = flat, .words = "flat joints"},
    {.layered = true,
     .layers = LayerModel::planes,
     .matrix = parallel,
     .joints = true,
     .words = "joints on planes"},
    {.layered = true,
     .layers = LayerModel::directions,
     .matrix = parallel,
     .directions = true,
     .words = "directions of the bonds",
     .sentence = " The layers are represented by bonds whose stiffness and strength depend on their "
                 "direction."},
    {.layered = true,
     .layers = LayerModel::planes_and_directions,
     .matrix = parallel,
     .joints = true,
     .directions = true,
     .words = "joints on planes, directions of the bonds' strength",
     .sentence = " The layers are represented by smooth joints between bonds whose strength depends on "
                 "their direction.",
     .contains = &models[2]},
    {.layered = true,
     .layers = LayerModel::planes_with_bridges,
     .matrix = parallel,
     .joints = true,
     .bridges = true,
     .words = "joints on {} of the planes",
     .sentence = " The layers are represented by smooth joints on a share of their planes, between rock "
                 "bridges.",
     .contains = &models[2]},
    {.layered = true,
     .layers = LayerModel::planes,
     .matrix = flat,
     .joints = true,
     .words = "joints on planes between flat joints"},
    {.layered = true,
     .layers = LayerModel::planes_with_bridges,
     .matrix = flat,
     .joints = true,
     .bridges = true,
     .words = "joints on {} of the planes, between flat joints",
     .sentence = " The layers are represented by smooth joints on a share of their planes, between rock "
                 "bridges.",
     .contains = &models[6]}};

}  // namespace

std::span<const RockModel> rock_models() { return models; }

bool RockModel::has(const Recipe& r) const { return matrix == r.matrix.model && has_layers_of(*this, r); }

const RockModel* model_of(const Recipe& recipe) {
  for (const RockModel& m : rock_models())
    if (m.has(recipe)) return &m;
  return nullptr;
}

const RockModel* find_model(bool layered, LayerModel layers, MatrixModel matrix) {
  for (const RockModel& m : rock_models())
    if (m.layered == layered && m.layers == layers && m.matrix == matrix) return &m;
  return nullptr;
}

std::string text_of(const RockModel& model, std::optional<double> jointed_share) {
  // The words are in the list; only those of bridges have a place for the share.
  return fmt::format(fmt::runtime(model.words),
                     jointed_share ? fmt::format("{:g}", *jointed_share) : "a share");
}

const char* to_string(LayerModel model) {
  constexpr const char* words[] = {"choose", "planes", "directions", "planes and directions",
                                   "planes with bridges"};
  return words[static_cast<std::size_t>(model)];
}

LayerModel layers_of(const Recipe& recipe) {
  for (const RockModel& m : rock_models())
    // Whatever holds the grains: a recipe may be of a combination that no calibration knows.
    if (m.layered && has_layers_of(m, recipe)) return m.layers;
  return recipe.bedding.empty() ? LayerModel::directions : LayerModel::planes_and_directions;
}

bool is_directed(LayerModel model) {
  return std::ranges::any_of(rock_models(),
                             [&](const RockModel& m) { return m.layers == model && m.directions; });
}

std::vector<const char*> layers_of_matrix(MatrixModel matrix) {
  std::vector<const char*> words;
  for (const RockModel& m : rock_models())
    if (m.layered && m.matrix == matrix) words.push_back(to_string(m.layers));
  return words;
}

bool of_parallel_bonds(LayerModel model) {
  return model != LayerModel::choose && find_model(true, model, flat) == nullptr;
}

// Of the first set: tables know one direction of planes, and rock files refuse recipes with more.
bool has_bridges(const Recipe& r) { return !r.bedding.empty() && r.bedding.front().persistence < 1.0; }

double jointed_share(const Recipe& r) { return r.bedding.empty() ? 1.0 : r.bedding.front().persistence; }

}  // namespace phy
