// What `phyllite rock new` writes: a rock without values, to be filled in.
#pragma once
#include <optional>
#include <string>

#include "records/recipe.hpp"

namespace phy::rock {

/// What a new rock takes from another one; what is empty stays a comment.
struct Start {
  std::string layers, matrix, E_is;           ///< as in a rock file
  std::optional<double> grain_size, spacing;  ///< [m]
  SpecimenSize size;
  bool bedded = true;
};

/// A commented rock file that names `file` as its table, and such a table.
std::string rock_template(const std::string& name, const std::string& file, const Start& start = {});
std::string rock_table_template();

}  // namespace phy::rock
