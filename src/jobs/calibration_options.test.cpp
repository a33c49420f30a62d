// Nothing is listed by hand here: what holds for one option holds for all.
#include "jobs/calibration_options.hpp"

#include <gmock/gmock.h>

namespace phy::jobs {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// Another value than by default.
void change(const CalibrationOption& option, CalibrationRequest& request) {
  const auto set = [&](auto place) {
    auto& value = request.*place;
    using Value = std::remove_reference_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, bool>)
      value = !value;
    else if constexpr (std::is_same_v<Value, std::string>)
      value = option.words.empty() ? "elsewhere" : option.words[option.words[0] == value ? 1 : 0];
    else
      value = option.most;
  };
  std::visit(set, option.place);
}

std::vector<Problem> problems_with(const CalibrationOption& option, const std::string& value) {
  std::vector<Problem> problems;
  try {
    request_of(io::parse_toml(std::string(option.key) + " = " + value, "asked", problems), "asked");
  } catch (const InputError& e) {
    problems = e.problems();
  }
  return problems;
}

TEST(CalibrationOptions, AFolderRemembersEachThatChangesTheResult) {
  for (const CalibrationOption& option : calibration_options()) {
    KeptRequest kept{{}, "my \"rock\"", "t", "m"};
    kept.request.rock = "a \\ b.toml";
    change(option, kept.request);
    const KeptRequest read = read_kept(kept_text(kept), "request.toml");
    EXPECT_EQ(option.value(read.request) == option.value(kept.request), option.changes_result) << option.key;
    EXPECT_EQ(read.request.rock, kept.request.rock);
    EXPECT_EQ(read.name + read.table + read.model, kept.name + kept.table + kept.model);
  }
}

TEST(CalibrationOptions, EachHasAWordAndAValueAtTheCommandLine) {
  CalibrationRequest usual;
  usual.rock = "r.toml";
  EXPECT_EQ(command_line_of(usual), (std::vector<std::string>{"calibrate", "r.toml"}));
  for (const CalibrationOption& option : calibration_options()) {
    CalibrationRequest request;
    change(option, request);
    const OptionValue value = option.value(request);
    const auto words = command_line_of(request);
    EXPECT_THAT(words, Contains("--" + option.word()));
    if (!std::holds_alternative<bool>(value)) {
      EXPECT_EQ(words.back(), option_text(value));
    }
  }
}

TEST(CalibrationOptions, AnotherValueIsToldByNameAndBothValues) {
  for (const CalibrationOption& option : calibration_options()) {
    CalibrationRequest begun, now;
    change(option, now);
    const auto problems = differences(now, begun);
    ASSERT_EQ(problems.size(), option.changes_result ? 1 : 0) << option.key;
    if (problems.empty()) continue;
    EXPECT_EQ(problems[0].key, "--" + option.word());
    EXPECT_EQ(problems[0].value, option_text(option.value(now)));
    EXPECT_THAT(problems[0].expected, testing::StartsWith(option_text(option.value(begun))));
  }
}

TEST(CalibrationOptions, NoneTakesWhatItCannotBe) {
  for (const CalibrationOption& option : calibration_options()) {
    EXPECT_EQ(problems_with(option, "2020-01-01").size(), 1U) << option.key;
    EXPECT_EQ(problems_with(option, "-1").size(), 1U) << option.key;
    if (option.most > 0) {
      EXPECT_EQ(problems_with(option, std::to_string(option.most + 1)).size(), 1U);
    }
    if (!option.words.empty()) {
      EXPECT_THAT(problems_with(option, "\"no such\"").at(0).expected, HasSubstr(option.words.back()));
    }
  }
}

TEST(CalibrationOptions, WhatIsMissingOrUnknownInAFolderIsSeen) {
  EXPECT_THROW(read_kept("max_tests = 0\n", "request.toml"), InputError);
  EXPECT_THROW(read_kept("max_test = 20\n", "request.toml"), InputError);
}

}  // namespace
}  // namespace phy::jobs
