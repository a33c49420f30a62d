// From a recipe to the specimens that it stands for, each with a recipe of its own.
//
// A recipe may ask for several angles and for the intact rock. Here it is split into recipes of one
// specimen each, completed: the bedding turned to its final angle, nothing left to default. Such a recipe
// says everything that a result depends on, so its fingerprint is the specimen's name in the store.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "records/recipe.hpp"
#include "records/specimen.hpp"

namespace phy::study {

/// One recipe per specimen, in the order of make_specimens: the angles, then the intact rock.
std::vector<Recipe> single_recipes(const Recipe& recipe);

/// Raised whenever the program gives other numbers to the same recipe, or a key gets another default: a test
/// holds it against tests/recorded.txt.
constexpr int results_version = 2;

/// Fingerprint of everything that a result in the store depends on: results_version and the keys that are not
/// as by default, so that a key that comes to the recipe later changes no fingerprint. Left out: the recipe's
/// name and the number of snapshots (the store holds none), and keys without effect (the zone's thickness
/// under the crossing rule). With packing.file the content of the file counts, not its name. Throws IoError
/// if that file cannot be read.
std::string specimen_key(const Recipe& single);

/// A key in which two recipes differ, with its values as in a file.
struct RecipeDifference {
  std::string key, one, other;
};
/// The keys by which specimens of two recipes differ in more than their angle, in the order of the reference;
/// of another number of beddings that alone. The angles and the intact specimen do not count.
std::vector<RecipeDifference> differences(const Recipe& one, const Recipe& other);

/// The packing of a recipe: imported, from the cache, or made; `stop` as of genesis::make_packing.
std::shared_ptr<const Packing> packing_of(const Recipe& recipe, const std::function<bool()>& stop = {});

/// The specimen of a single recipe.
std::shared_ptr<const Specimen> specimen_of(std::shared_ptr<const Packing> packing, const Recipe& single);

}  // namespace phy::study
