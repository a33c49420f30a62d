// What the program says of a rock that is being typed: the same as `phyllite rock check`, as JSON, each
// problem with the cell that it is about.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace phy::gui {

using Json = nlohmann::ordered_json;

/// Nothing is written, and nothing thrown of what is wrong with the input. `table`: nothing: as it is on
/// disk.
Json check_answer(const std::string& name, const std::string& toml, const std::optional<std::string>& table);

}  // namespace phy::gui
