// Studies as TOML files. Keys, units and messages follow the recipe; all problems are reported at once.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/document.hpp"
#include "study/design.hpp"

namespace phy::study {

const io::Schema& study_schema();

/// Reads and checks a study, its base recipe and its list of points. Paths in the file count from its folder.
/// Throws IoError, or InputError with every problem found.
Study read_study(const std::string& path);
/// The same from keys that stand in no file; the files that they name count from the working directory.
/// `base`: in place of the file that the key `recipe` names.
Study study_of(io::TomlValue keys, const std::string& where, const std::optional<Recipe>& base);

/// The same study as files that need nothing else beside them: study.toml, recipe.toml (the completed base)
/// and, for a list, points.csv. Pairs of name and content.
std::vector<std::pair<std::string, std::string>> study_files(const Study& study);

/// Its [by_angle] as lines of such a file: "\"test.platen_speed\" = [\"0.1 m/s\", \"0.05 m/s\"]".
std::vector<std::string> by_angle_lines(const Study& study);

}  // namespace phy::study
