// Which of the files that a user writes is this? Recognised by words at its top level that no other kind has,
// so that who gives a verb another kind of file is told the verb that takes it.
#pragma once
#include <string>

#include "io/toml_tree.hpp"

namespace phy::io {

/// Throws InputError if the keys are those of another kind of file than `wanted` (Schema::name).
void refuse_other_kind(const TomlValue& root, const std::string& where, const std::string& wanted);

/// The text of a file that the user wrote as `wanted`. Throws IoError, or InputError for a table of tests.
std::string read_user_file(const std::string& path, const std::string& wanted);

}  // namespace phy::io
