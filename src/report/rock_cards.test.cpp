// Cards of measured rocks in words: medians and ranges over calibrations by hand, and cards without a model.
#include "report/rock_cards.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "records/rock_model.hpp"

namespace phy::report {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

constexpr const char* finished = R"({
  "name": "slate", "title": "a slate", "kind": "slate", "cautions": ["Digitised."],
  "sources": [{"key": "A", "cite": "a paper", "licence": "facts"}],
  "measured": {"properties": ["UCS", "nu"], "angles": 7},
  "program": "0.2", "seeds": [1, 501, 1001], "layers": "planes with bridges", "matrix": "parallel_bond",
  "verdict": {"status": "not decided", "sentence": "Not decided.", "lines": ["Good for: E."]},
  "statuses": ["not decided", "calibrated", "not decided"], "tests": 600, "cpu_s": 1284.4,
  "errors": {"UCS": [0.09, 0.05, 0.06], "nu": [0.01, 0.03, 0.02]},
  "left_out": {"UCS": {"ratio": [0.5, 0.7]}, "BTS": {"ratio": []}},
  "cells": [
    {"property": "E", "theta [deg]": 0},
    {"property": "UCS", "theta [deg]": 0, "confining [Pa]": 0,
     "failure": {"bedding_share": 0.012, "angle [deg]": null, "planes": 0, "tests": 15}},
    {"property": "BTS", "theta [deg]": 90,
     "failure": {"bedding_share": 1, "angle [deg]": -0.4, "planes": 15, "tests": 15}},
    {"property": "sigma_1", "theta [deg]": 60, "confining [Pa]": 6e6,
     "failure": {"bedding_share": 0.82, "angle [deg]": 59.6, "planes": 14, "tests": 15}}],
  "predictions": [
    {"text": "BTS, from UCS", "yardstick": "a tenth of UCS", "rms": [0.12], "mean": [-0.05],
     "inside": 6, "of": 7, "yardstick_rms": 0.4},
    {"text": "sigma_1, from UCS", "yardstick": "N"}]})";

constexpr const char* begun = R"({
  "name": "tuff", "title": "a tuff", "kind": "tuff", "cautions": [], "sources": [],
  "measured": {"properties": ["DTS"], "angles": 0}, "verdict": {"status": "not run", "lines": ["not run"]}})";

TEST(RockCards, AListHasARowOfMediansForEveryCard) {
  const std::string list = rock_list({finished, begun}, 0);
  EXPECT_THAT(list, AllOf(HasSubstr("6.0 (5.0 - 9.0) %"), HasSubstr("0.020 (0.010 - 0.030)")));
  EXPECT_THAT(list, HasSubstr("UCS, nu; 7 angles"));
  EXPECT_THAT(list, HasSubstr("UCS 0.60"));
  EXPECT_THAT(list, Not(HasSubstr("BTS")));
  EXPECT_THAT(list, ContainsRegex("tuff .*DTS"));
}

TEST(RockCards, AListFitsANarrowTerminal) {
  const std::string list = rock_list({finished, begun}, 50);
  for (std::size_t from = 0; from < list.size();) {
    const std::size_t end = list.find('\n', from);
    EXPECT_LE(end - from, 50U) << list.substr(from, end - from);
    from = end + 1;
  }
  EXPECT_THAT(list, AllOf(HasSubstr("0.020 (0.010 - 0.030)"), HasSubstr("UCS 0.60")));
}

TEST(RockCards, ACardHasTheModesOfFailure) {
  const std::string card = rock_card(finished, 80);
  EXPECT_THAT(card, ContainsRegex("UCS 0 +1 +- +0 of 15"));
  EXPECT_THAT(card, ContainsRegex("sigma_1 at 6 MPa, 60 +82 +60 +14 of 15"));
  EXPECT_THAT(card, ContainsRegex("BTS 90 +100 +0 +15 of 15"));
  EXPECT_THAT(card, Not(HasSubstr("E 0")));
}

TEST(RockCards, ACardSaysWhatWasPredictedAndWhatWasNot) {
  const std::string card = rock_card(finished, 0);
  EXPECT_THAT(card, ContainsRegex("12\\.0 %.*-5\\.0 %.*6 of 7.*40\\.0 %"));
  EXPECT_THAT(card, ContainsRegex("sigma_1, from UCS: [a-z ]+\\.\n"));
  EXPECT_THAT(card, ContainsRegex("600 .*1284 s"));
  EXPECT_THAT(card, HasSubstr("Source: a paper (facts)"));
}

TEST(RockCards, ACardWithoutAModelHasNone) {
  EXPECT_EQ(rock_card(begun, 0), "a tuff (tuff)\nnot run\n\n");
  EXPECT_EQ(model_of_card(begun).layers, "");
  EXPECT_EQ(model_of_card(finished).layers, to_string(LayerModel::planes_with_bridges));
}

}  // namespace
}  // namespace phy::report
