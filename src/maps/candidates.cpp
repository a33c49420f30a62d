#include "maps/candidates.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/check.hpp"
#include "maps/mapped_model.hpp"

namespace phy::maps {
namespace {

// Bridges stiffen planes as much as they strengthen them: joints are fitted anew for each of these shares,
// which no search of strengths could move.
constexpr double persistences[] = {0.8, 0.65, 0.5, 0.35, 0.2};

/// What the other matrix does not have falls back to where it says nothing.
void take_matrix(MatrixRecipe& m, MatrixModel model) {
  if (m.model == model) return;
  const MatrixRecipe usual;
  const double modulus = m.modulus();  // kept: nobody has asked for a softer rock
  m.model = model;
  m.stiffness_convention = usual.stiffness_convention;
  m.E_b = usual.E_b, m.bond_ks_over_kn = usual.bond_ks_over_kn;
  m.moment_contribution = usual.moment_contribution;
  m.elements = usual.elements, m.break_at = usual.break_at;
  m.gapped_fraction = usual.gapped_fraction, m.initial_gap = usual.initial_gap;
  if (model == MatrixModel::flat_joint) {
    m.E_c = modulus / m.radius_multiplier;
  } else {
    m.E_c = m.E_b = modulus / (1.0 + m.radius_multiplier);
    m.bond_ks_over_kn = m.ks_over_kn;
  }
}

bool shows_matrix(const Evidence& evidence) {
  const bool bedded = evidence.rock.bedded;
  return !(bedded && of_parallel_bonds(evidence.rock.layers)) && evidence.has(Property::ucs) &&
         (!bedded || shows_layers(evidence.strengths)) &&
         std::ranges::any_of(evidence.targets, [](const Target& t) { return is_tensile(t.property); });
}

/// What the rock file asks for, the matrix by itself or that of its recipe.
bool is_asked_for(const RockModel& model, const Rock& rock) {
  const bool parallel = rock.bedded && of_parallel_bonds(rock.layers);
  const MatrixModel stays =
      rock.matrix.value_or(parallel ? MatrixModel::parallel_bond : rock.model.matrix.model);
  const LayerModel layers =
      !rock.bedded || rock.layers == LayerModel::choose ? LayerModel::planes : rock.layers;
  return model.layers == layers && model.matrix == stays;
}

bool is_mapped(const RockModel& model) {
  return std::ranges::any_of(mapped_models(), [&](const MappedModel& m) { return m.model == &model; });
}

/// Is it compared beside what the file asks for?
bool is_open(const RockModel& model, const Evidence& evidence) {
  const Rock& rock = evidence.rock;
  const bool any_layers =
                 rock.bedded && rock.layers == LayerModel::choose && shows_layers(evidence.strengths),
             any_matrix = !rock.matrix && shows_matrix(evidence);
  const auto same_layers = [&](const RockModel& asked) { return asked.layers == model.layers; };
  const auto same_matrix = [&](const RockModel& asked) { return asked.matrix == model.matrix; };
  return is_mapped(model) && std::ranges::any_of(rock_models(), [&](const RockModel& asked) {
           return asked.layered == model.layered && is_asked_for(asked, rock) &&
                  (any_layers || same_layers(asked)) && (any_matrix || same_matrix(asked));
         });
}

Rock with_share(Rock bridged, double jointed) {
  bridged.model.bedding.front().persistence = jointed;
  return bridged;
}

}  // namespace

Rock with_model(Rock rock, LayerModel layers, std::optional<MatrixModel> matrix) {
  rock.layers = layers, rock.matrix = matrix;
  MatrixRecipe& m = rock.model.matrix;
  if (matrix) take_matrix(m, *matrix);
  if (layers == LayerModel::planes_with_bridges && !has_bridges(rock.model))
    rock.model.bedding.front().persistence = usual_persistence;
  if (!is_directed(layers) || rock.model.bedding.empty() || m.directional()) return rock;
  if (layers == LayerModel::directions)
    rock.model.bedding.clear();
  else
    m.foliation = rock.model.bedding.front().theta;
  // at 1 bonds break at the rim by bending, and hardly feel the directions of their shear strength
  if (m.moment_contribution == MatrixRecipe().moment_contribution) m.moment_contribution = 0.1;
  for (const Parameter* p : {&cohesion_ratio, &cohesion_oblique}) p->set(rock.model, p->range.usual);
  return rock;
}

const RockModel& model_of(const Rock& rock) {
  const RockModel* model = find_model(rock.bedded, rock.layers, rock.model.matrix.model);
  PHY_CHECK(model != nullptr, "a rock with one model");
  return *model;
}

std::vector<Rock> candidates_of(const Evidence& evidence) {
  const Rock& rock = evidence.rock;
  // a share that a recipe states is not for us to move
  const bool shares = !has_bridges(rock.model) && shows_layers(evidence.strengths);
  std::vector<Rock> all;
  for (const RockModel& model : rock_models()) {
    if (model.layered != rock.bedded || (!is_asked_for(model, rock) && !is_open(model, evidence))) continue;
    const Rock one = with_model(rock, model.layers, model.matrix);
    if (!model.bridges || !shares || !is_mapped(model))
      all.push_back(one);
    else
      for (const double share : persistences) all.push_back(with_share(one, share));
  }
  return all;
}

std::optional<Finding> assumed_share(const Rock& read, const std::vector<Rock>& candidates) {
  if (candidates.size() > 1 || has_bridges(read.model) || !has_bridges(candidates.front().model)) return {};
  return Finding{FindingKind::share_assumed, {}, {{"share", usual_persistence}}};
}

std::string model_in_words(const Rock& rock) { return text_of(model_of(rock), jointed_share(rock.model)); }

std::string models_in_words(const std::vector<Rock>& models) {
  std::vector<std::string> words, shares;
  for (const Rock& r : models)
    if (!has_bridges(r.model))
      words.push_back(model_in_words(r));
    else
      shares.push_back(fmt::format("{:g}", jointed_share(r.model)));
  if (!shares.empty()) words.push_back(fmt::format("joints on {} of the planes", fmt::join(shares, ", ")));
  return fmt::format("{}", fmt::join(words, "; "));
}

}  // namespace phy::maps
