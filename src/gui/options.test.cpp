#include "gui/options.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace phy::gui {
namespace {

TEST(PageOptions, EveryOptionIsThereAndComesBack) {
  const Json shown = options_json();
  ASSERT_EQ(shown.size(), jobs::calibration_options().size());
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const jobs::CalibrationOption& option = jobs::calibration_options()[i];
    EXPECT_EQ(shown[i]["path"], option.key);
    EXPECT_EQ(shown[i]["on_page"], option.changes_result);
    if (shown[i]["on_page"]) {
      EXPECT_NE(shown[i]["title"], "") << option.key;
    }
    const Json other = shown[i]["kind"] == "choice"    ? shown[i]["choices"].back()
                       : shown[i]["kind"] == "boolean" ? Json(true)
                       : shown[i]["kind"] == "integer" ? Json(shown[i]["most"].get<std::int64_t>())
                                                       : Json("folder");
    const jobs::CalibrationRequest request = request_from({{option.key, other}});
    const OptionValue value = option.value(request);
    std::visit([&](const auto& v) { EXPECT_EQ(other, Json(v)) << option.key; }, value);
  }
}

TEST(PageOptions, WhatIsNoValueIsRefused) {
  for (const Json& wrong : {Json(nullptr), Json::array(), Json::object(), Json(0.5)})
    for (const jobs::CalibrationOption& option : jobs::calibration_options())
      EXPECT_THROW(request_from({{option.key, wrong}}), InputError) << option.key << " " << wrong;
  EXPECT_THROW(request_from({{"no such", true}}), InputError);
}

}  // namespace
}  // namespace phy::gui
