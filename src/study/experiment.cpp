#include "study/experiment.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/check.hpp"
#include "base/hash.hpp"
#include "genesis/cache.hpp"
#include "genesis/specimen.hpp"
#include "io/file.hpp"
#include "records/recipe_schema.hpp"

namespace phy::study {
namespace {

/// Back to defaults what the rule of the set does not read.
void leave_out_unread(BeddingRecipe& set) {
  const BeddingRecipe usual;
  if (set.rule != BeddingRule::zone) set.zone_thickness = usual.zone_thickness, set.bridges = usual.bridges;
  if (set.rule != BeddingRule::oriented) set.orientation_range = usual.orientation_range;
  if (!set.has_planes() || set.persistence == 1.0) set.patch_length = usual.patch_length;
  if (!set.unjointed()) return;
  set.rule = BeddingRule::crossing, set.patch_length = usual.patch_length;
  set.zone_thickness = usual.zone_thickness, set.bridges = usual.bridges;
  set.k_n = usual.k_n, set.k_s = usual.k_s, set.mu = usual.mu;
  set.sigma_n = usual.sigma_n, set.sigma_n_sd = usual.sigma_n_sd, set.cohesion = usual.cohesion;
  set.phi = usual.phi, set.psi = usual.psi, set.radius_multiplier = usual.radius_multiplier;
}

/// What all specimens of a recipe have in common.
Recipe without_angles(Recipe r) {
  r.test.angles.clear();
  r.test.intact = false;
  // Angles of the layers differ from specimen to specimen; what is compared is the rest.
  if (layered(r)) genesis::turn_layers(r.matrix, r.bedding, 0.0);
  return r;
}

}  // namespace

std::vector<Recipe> single_recipes(const Recipe& recipe) {
  std::vector<Recipe> singles;
  Recipe one = recipe;
  one.test.angles.clear();
  one.test.intact = false;
  // test.angles turns all layers together. Without it they are one specimen as given.
  for (const double theta : recipe.test.angles) {
    singles.push_back(one);
    genesis::turn_layers(singles.back().matrix, singles.back().bedding, theta);
  }
  if (recipe.test.angles.empty() && layered(recipe)) singles.push_back(one);
  one.bedding.clear();
  if (recipe.test.intact || !layered(recipe)) singles.push_back(one);
  return singles;
}

std::string specimen_key(const Recipe& single) {
  PHY_CHECK(single.test.angles.empty() && !(single.test.intact && layered(single)),
            "a key belongs to one specimen");
  // Everything that does not change a result is taken out, so that equal specimens have equal keys.
  Recipe r = single;
  r.name.clear();
  // Pictures are taken between blocks and change nothing of what is measured.
  r.test.n_snapshots = r.test.n_frames = 0;
  r.test.intact = false;
  // Of no effect without directions.
  if (!r.matrix.directional()) r.matrix.foliation = MatrixRecipe{}.foliation;
  for (BeddingRecipe& set : r.bedding) leave_out_unread(set);
  // A new version of results gives new keys: old rows are not found.
  std::string text = fmt::format("results {}\n", results_version);
  // By content: a disc file may be moved, or changed under the same name.
  if (!r.packing.file.empty()) text += "discs " + fingerprint_of(io::read_file(r.packing.file)) + "\n";
  r.packing.file.clear();
  // Without defaults, a key that comes later with a default changes no fingerprint.
  return fingerprint_of(text + keys_not_by_default(r));
}

std::vector<RecipeDifference> differences(const Recipe& one, const Recipe& other) {
  const Recipe a = without_angles(one), b = without_angles(other);
  if (a.bedding.size() != b.bedding.size())
    return {
        {"number of [[bedding]] tables", std::to_string(a.bedding.size()), std::to_string(b.bedding.size())}};
  std::vector<RecipeDifference> all;
  for (const Field& f : recipe_fields()) {
    const bool of_set = f.table == "bedding";
    for (std::size_t i = 0; i < (of_set ? a.bedding.size() : 1); ++i) {
      const std::string in_a = print_field(f, a, i), in_b = print_field(f, b, i);
      // As they are printed: values that differ in their last bits alone would be shown as equal and called
      // different.
      if (in_a == in_b) continue;
      all.push_back({of_set ? "bedding[" + std::to_string(i) + "]." + f.key : f.path(), in_a, in_b});
    }
  }
  return all;
}

std::shared_ptr<const Packing> packing_of(const Recipe& r, const std::function<bool()>& stop) {
  return genesis::packing_of(r, genesis::default_cache_folder(), stop);
}

std::shared_ptr<const Specimen> specimen_of(std::shared_ptr<const Packing> packing, const Recipe& single) {
  std::vector<Specimen> made = genesis::make_specimens(std::move(packing), single);
  PHY_CHECK(made.size() == 1, "a single recipe makes one specimen");
  return std::make_shared<const Specimen>(std::move(made.front()));
}

}  // namespace phy::study
