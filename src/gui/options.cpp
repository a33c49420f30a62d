#include "gui/options.hpp"

#include <nlohmann/json.hpp>

#include <utility>
#include <variant>

namespace phy::gui {
namespace {

/// A date stands for what no option can be: it is refused with the others.
io::TomlValue value_of(const Json& value) {
  io::TomlValue made;
  using Kind = io::TomlValue::Kind;
  if (value.is_string()) made.kind = Kind::text, made.text = value.get<std::string>();
  if (value.is_boolean()) made.kind = Kind::boolean, made.number = value.get<bool>() ? 1.0 : 0.0;
  if (value.is_number()) made.number = value.get<double>(), made.text = value.dump();
  // An integer with its digits as text, as the reader of TOML keeps it.
  if (value.is_number()) made.kind = value.is_number_integer() ? Kind::integer : Kind::number;
  return made;
}

}  // namespace

Json options_json() {
  Json options = Json::array();
  for (const jobs::CalibrationOption& o : jobs::calibration_options()) {
    const Field field = o.field();
    Json option = field_json(field);
    option["least"] = field.min, option["most"] = field.max;
    option["word"] = "--" + o.word(), option["title"] = o.title, option["on_page"] = o.changes_result;
    std::visit([&](const auto& value) { option["default"] = value; }, o.value(jobs::CalibrationRequest()));
    options.push_back(std::move(option));
  }
  return options;
}

jobs::CalibrationRequest request_from(const Json& options) {
  io::TomlValue keys;
  keys.kind = io::TomlValue::Kind::table;
  // The tree of the TOML reader: ranges and words are checked as in a file.
  for (const auto& [key, value] : options.items())
    keys.keys.push_back({key, 0}), keys.items.push_back(value_of(value));  // line 0: of no file
  return jobs::request_of(std::move(keys), "");
}

}  // namespace phy::gui
