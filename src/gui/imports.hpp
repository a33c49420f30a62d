// What a rock of the page may begin with: a file that somebody drops on it, or a measured rock that comes
// with the program.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace phy::gui {

using Json = nlohmann::ordered_json;

/// A workbook or another file with a table, as the text of a table. Throws InputError where it is none.
Json table_from(std::string_view bytes, const std::string& file);
/// Rock file and table of a measured rock. Throws InputError where there is none of that name.
Json rock_like(const std::string& measured);

}  // namespace phy::gui
