// Packings are kept on disk: making one takes up to half a minute, reading one a few milliseconds.
//
// A file holds the full key (everything the discs depend on), the discs as hexadecimal floating-point
// numbers, the report and the fingerprint. It is used only if the key is the same character by character and
// the fingerprint fits the text; anything else is made anew and replaced. It is written under a temporary
// name and renamed, so that a half file cannot exist under the real name, also with several processes at
// work. The cache is a convenience: a folder that cannot be read or written is no error.
#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "records/recipe.hpp"
#include "records/specimen.hpp"

namespace phy::genesis {

/// $XDG_CACHE_HOME/phyllite, else $HOME/.cache/phyllite, else empty (no cache).
std::filesystem::path default_cache_folder();

/// Everything the discs depend on, as one line of text. E_c and its convention belong to it only for an
/// isotropic stress; a stress-free packing does not depend on them.
std::string packing_key(const SpecimenSize& size, const PackingRecipe& recipe, const MatrixRecipe& matrix);

/// File name of a key inside the folder.
std::filesystem::path cache_file(const std::filesystem::path& folder, const std::string& key);

/// Whether the folder has a file for the packing; one that is damaged counts.
bool is_cached(const Recipe& recipe, const std::filesystem::path& folder);

/// The packing from the folder, or made (make_packing) and put there. An empty folder means no cache.
std::shared_ptr<const Packing> cached_packing(const SpecimenSize& size, const PackingRecipe& recipe,
                                              const MatrixRecipe& matrix, const std::filesystem::path& folder,
                                              const std::function<bool()>& stop = {});

/// The packing of a recipe: of its file if it names one, else as cached_packing.
std::shared_ptr<const Packing> packing_of(const Recipe& recipe, const std::filesystem::path& folder,
                                          const std::function<bool()>& stop = {});

}  // namespace phy::genesis
