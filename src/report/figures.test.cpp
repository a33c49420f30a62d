#include "report/figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "base/check.hpp"
#include "base/nan.hpp"
#include "report/calibration_files.hpp"
#include "report/curves.hpp"
#include "report/palette.hpp"
#include "report/specimen_picture.hpp"
#include "theory/goodman.hpp"

namespace phy::report {
namespace {

using testing::HasSubstr;

constexpr double spacing = 0.005;

/// E(theta) of Eq. 1 for every value of K_n: what a study of a perfect continuum would leave.
Variation continuum(const std::vector<double>& factors) {
  Variation v;
  v.spacing = spacing;
  VariedParameter p{"bedding.k_n", {}};
  for (const double factor : factors) {
    theory::JointedRock rock;
    rock.E = 60e9, rock.K_n_delta = factor * 7e12 * spacing, rock.K_s_delta = 1.4e12 * spacing;
    VariedSetting s;
    s.text = fmt::format("{} GPa/m", 3000.0 * factor), s.value = 3e12 * factor, s.factor = factor,
    s.base = factor == 1.0;
    for (const double theta : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0}) {
      AngleValue a;
      a.theta = theta, a.value.n = 1, a.value.mean = theory::goodman_E(rock, theta);
      s.E.push_back(a);
    }
    p.settings.push_back(s);
  }
  v.parameters.push_back(p);
  return v;
}

std::string script_of(const std::string& kind, const FigureData& data, double width = 0.0) {
  return figure_script(figure_kind(kind), data, FigureFormat::svg, width, "out.svg");
}

TEST(Figures, EveryFigureOfThePaperHasAKind) {
  for (const char* number : {"fig2", "fig3", "fig4", "fig5", "fig6"})
    EXPECT_EQ(figure_kind(number).paper, std::string(number));
}

TEST(Figures, AnUnknownKindIsToldWithTheNearest) {
  try {
    figure_kind("modulos");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("did you mean modulus?"));
    EXPECT_THAT(e.what(), testing::Not(HasSubstr("fig6"))) << "words, not the paper's numbers";
  }
  for (const char* of_table : {"ucs", "UCS", "E"}) try {
      figure_kind(of_table);
      FAIL();
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr("did you mean anisotropy?"));
    }
}

// Eq. 1 is fitted to its own values: the stiffnesses that went in come out, 7000 GPa/m times the factor.
TEST(Figures, MacroStiffnessesAreThoseOfTheContinuum) {
  FigureData data;
  data.variation = continuum({0.5, 1.0, 2.0});
  const std::string script = script_of("stiffness", data);
  for (const char* row : {"0.5 3500 ", "1 7000 ", "2 14000 ", "0.5 1400 ", "2 1400 "})
    EXPECT_THAT(script, HasSubstr(row));
}

// 2 x 3000 + 400 GPa/m at the base.
TEST(Figures, LinesOfOthersStandBesideTheirParameter) {
  FigureData data;
  data.variation = continuum({0.5, 1.0, 2.0});
  data.variation.regressions = {{"they", "K_n", "bedding.k_n", 2.0, 400e9, "Pa/m", 1.0},
                                {"nobody", "K_n", "bedding.k_s", 2.0, 400e9, "Pa/m", 1.0}};
  const std::string script = script_of("stiffness", data);
  for (const char* part : {"1 6400", "2 12400", "title 'they'"}) EXPECT_THAT(script, HasSubstr(part));
  EXPECT_EQ(script.find("nobody"), script.npos);
}

// Two packings, 10 % softer and stiffer in K_n: mean and interval of both fits, not a fit of the mean.
TEST(Figures, MacroStiffnessesAreFittedPackingByPacking) {
  Variation v = continuum({1.0});
  v.parameters[0].settings[0].E_each = {continuum({0.9}).parameters[0].settings[0].E,
                                        continuum({1.1}).parameters[0].settings[0].E};
  const std::vector<MacroPoint> points = macro_points(v, v.parameters[0]);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR(points[0].K_n.mean / 7e12, 1.0, 1e-6);
  EXPECT_NEAR(points[0].K_n.half_width / (12.7062 * 0.7e12), 1.0, 1e-4);  // Student, one degree of freedom
}

TEST(Figures, ValuesLoseTheirCommonUnitToTheTitle) {
  FigureData data;
  data.variation = continuum({0.5, 1.0});
  const std::string script = script_of("fig5", data);
  EXPECT_THAT(script, HasSubstr("{/:Italic k}_n [GPa/m]"));
  EXPECT_THAT(script, HasSubstr("title '1500'"));
  EXPECT_THAT(script, HasSubstr("title '3000 (base)'"));
}

TEST(Figures, WhatIsNotThereIsRefused) {
  FigureData data;
  data.variation = continuum({0.5, 1.0});
  EXPECT_THROW(script_of("strength", data), InputError);  // a direct solution has no strengths
  data.variation.spacing = 0.0;                           // joints without planes
  EXPECT_THROW(script_of("stiffness", data), InputError);
  EXPECT_NO_THROW(script_of("modulus", data));
  data.run.tests.emplace_back();
  for (const char* kind : {"model", "specimens", "cracks", "stress_strain", "anisotropy"})
    EXPECT_THROW(script_of(kind, data), InputError) << kind;
}

/// A test at an angle, with one number and one moment of a disc or a specimen.
SpecimenRecord test_at(double theta, const std::string& number, double aspect) {
  SpecimenRecord t;
  t.result.intact = false, t.result.theta = theta;
  t.result.numbers = {{number, 1e6, "Pa", "", ""}};
  t.scene.width = 0.01, t.scene.height = 0.01 * aspect;
  t.scene.discs = {{0.005, 0.005, 0.001}};
  t.scene.frames.resize(1);
  t.scene.frames[0].u = {{{0.0F, 0.0F}}};
  return t;
}

// A Brazilian test has a strength, but neither E nor nu.
TEST(Figures, OnlyPanelsWithNumbersAreDrawn) {
  FigureData data;
  data.run.tests = {test_at(0.0, "bts", 1.0), test_at(90.0, "bts", 1.0)};
  for (SpecimenRecord& t : data.run.tests) t.recipe.test.kind = TestKind("brazilian");
  const std::string script = script_of("anisotropy", data);
  EXPECT_THAT(script, HasSubstr("Brazilian strength [MPa]"));
  EXPECT_THAT(script, HasSubstr("layout 1,1 "));
  EXPECT_EQ(script.find("NaN"), script.npos);
}

/// Blocks of rows of a script, each with the words that draw it, in the order of the plot commands.
struct Drawn {
  std::vector<std::vector<double>> rows;
  std::string how;
};
std::vector<Drawn> drawn_in(const std::string& script) {
  std::vector<Drawn> all;
  std::istringstream lines(script);
  std::map<std::string, std::vector<std::vector<double>>> blocks;
  for (std::string line, name; std::getline(lines, line);) {
    if (line.ends_with(" << EOD")) {
      name = line.substr(0, line.find(' '));
    } else if (line == "EOD") {
      name.clear();
    } else if (!name.empty()) {
      std::istringstream cells(line);
      std::vector<double> row;
      for (std::string cell; cells >> cell;) row.push_back(cell == "NaN" ? NAN : std::stod(cell));
      blocks[name].push_back(row);
    } else if (const std::size_t at = line.find("$d"); at != line.npos) {
      const std::string block = line.substr(at, line.find(' ', at) - at);
      all.push_back({blocks[block], line.substr(at + block.size() + 1)});
    }
  }
  return all;
}

Comparison compared(Property property, double theta, double laboratory, double model) {
  Comparison c;
  c.target.property = property, c.target.theta = theta, c.target.mean = laboratory;
  c.target.sd = 0.1 * laboratory, c.target.n = 4;
  c.mean = model, c.n_packings = 5;
  return c;
}

Calibration with_ucs() {
  Calibration c;
  c.rock = "slate";
  for (const double theta : {0.0, 45.0, 90.0}) {
    Comparison row = compared(Property::ucs, theta, 1e8 + 1e6 * theta, 1.1e8);
    row.low = 9e7, row.high = 1.3e8, row.target.specimens = {9.5e7, 1.05e8};
    c.fitted.push_back(row);
    row.mean = 1.2e8 + 1e6 * theta;
    c.verification.push_back(row);
    row.mean = theta == 45.0 ? nan : 7e7;
    c.left_out.push_back(row);
  }
  return c;
}

std::string script_of_calibration(const Calibration& c) {
  FigureData data;
  data.calibration = comparisons_of(calibration_json(c, "1"), "calibration.json");
  return script_of("anisotropy", data);
}

/// The rows that are drawn so, of all panels.
std::vector<std::vector<double>> rows_with(const std::string& script, const std::string& words) {
  std::vector<std::vector<double>> rows;
  for (const Drawn& d : drawn_in(script))
    if (d.how.find(words) != d.how.npos) rows.insert(rows.end(), d.rows.begin(), d.rows.end());
  return rows;
}

// Of 4 specimens with a scatter of 10 %, the mean is known to 1.96 * 5 %.
TEST(Figures, ACalibrationIsDrawnFromTheNumbersOfItsFile) {
  const std::string script = script_of_calibration(with_ucs());
  const auto laboratory = rows_with(script, "yerrorbars pt 12"), model = rows_with(script, "pt 7 ps 0.6"),
             unseen = rows_with(script, "points pt 2"), band = rows_with(script, "boxxyerror"),
             single = rows_with(script, "pt 7 ps 0.22");
  ASSERT_EQ(laboratory.size(), 3U);
  EXPECT_EQ(laboratory[1][0], 45.0);
  EXPECT_NEAR(laboratory[1][1], 145.0, 1e-6);
  EXPECT_NEAR(laboratory[1][3] / 145.0, 1.098, 1e-4);
  ASSERT_EQ(model.size(), 3U);
  EXPECT_NEAR(model[2][1], 210.0, 1e-6) << "on unseen packings, not on those of the fit";
  ASSERT_EQ(unseen.size(), 2U) << "one had no answer";
  EXPECT_NEAR(unseen[0][1], 70.0, 1e-6);
  ASSERT_EQ(band.size(), 3U);
  EXPECT_NEAR(band[0][4], 90.0, 1e-6);
  EXPECT_NEAR(band[0][5], 130.0, 1e-6);
  EXPECT_EQ(single.size(), 6U);
  EXPECT_THAT(script, HasSubstr("UCS [MPa]"));
  EXPECT_THAT(script, HasSubstr("model, unseen packings"));
}

// Angles of two specimens, too few for a theory: nothing joins what was computed at them.
TEST(Figures, NoLineIsDrawnThroughWhatWasComputedAtSingleAngles) {
  Calibration c = with_ucs();
  for (auto* rows : {&c.fitted, &c.verification, &c.left_out}) rows->erase(rows->begin() + 1);
  EXPECT_EQ(script_of_calibration(c).find("lines"), std::string::npos);
}

TEST(Figures, ACalibrationHasAPanelForEveryTestOfItsTable) {
  Calibration c = with_ucs();
  c.method = CalibrationMethod::sequence;
  c.verification.clear(), c.left_out.clear();
  for (Comparison& row : c.fitted) row.low = row.high = nan, row.sd = 2e6;
  c.fitted.push_back(compared(Property::nu, 0.0, 0.2, 0.25));
  c.fitted.push_back(compared(Property::brazilian, 0.0, 8e6, 9e6));
  c.fitted.back().target.diameter = 0.054;
  c.fitted.push_back(compared(Property::confined, 0.0, 2e8, 2.1e8));
  c.fitted.back().target.confining = 10e6;
  const std::string script = script_of_calibration(c);
  EXPECT_THAT(script, HasSubstr("layout 2,2 "));
  for (const char* text : {"Brazilian strength [MPa]", "54 mm", "10 MPa", "(d)", "packings of the fit",
                           "standard deviation of the packings"})
    EXPECT_THAT(script, HasSubstr(text));
  EXPECT_NEAR(rows_with(script, "boxxyerror")[0][4], 108.0, 1e-6) << "one standard deviation";
}

TEST(Figures, AFileThatIsNoCalibrationIsNamed) {
  for (const char* text : {"", "{}", "[]", R"({"format": 2, "rock": "a"})",
                           R"({"format": 1, "rock": "a", "fitted": [{"property": "UCS"}]})"}) {
    try {
      comparisons_of(text, "here/calibration.json");
      FAIL() << text;
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr("here/calibration.json: expected a calibration of format 1"));
    }
  }
}

/// A test whose stress grows to `peak` [MPa] at `strain` [%] and falls.
SpecimenRecord curve_to(double theta, double strain, double peak) {
  SpecimenRecord t;
  t.result.intact = false, t.result.theta = theta;
  t.result.history.rows.resize(3);
  for (std::size_t i = 1; i < 3; ++i)
    t.result.history.rows[i].axial_strain = 0.01 * strain * static_cast<double>(i);
  t.result.history.rows[1].axial_stress = 1e6 * peak, t.result.history.rows[2].axial_stress = 5e5 * peak;
  return t;
}

/// Relative luminance of a colour "#rrggbb", 0 to 1.
double luminance(const std::string& hex) {
  const auto linear = [&](std::size_t at) {
    const double v = std::stoi(hex.substr(at, 2), nullptr, 16) / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(1) + 0.7152 * linear(3) + 0.0722 * linear(5);
}

TEST(Figures, CurvesDifferInGreyAndAreNamedAtTheirPeaks) {
  FigureData data;
  for (int k = 0; k < 7; ++k) data.run.tests.push_back(curve_to(15.0 * k, 0.1 * (k + 1), 50.0 + 10.0 * k));
  data.run.tests.push_back(curve_to(0.0, 0.9, 140.0));
  data.run.tests.back().result.intact = true;
  const std::string script = script_of("stress_strain", data);
  std::set<std::string> dashes;
  double before = 1.0;
  for (const Drawn& d : drawn_in(script)) {
    if (!d.how.starts_with("with lines")) continue;
    const std::size_t dash = d.how.find(" dt ") + 4, color = d.how.find('#');
    dashes.insert(d.how.substr(dash, d.how.find(' ', dash) - dash));
    const double now = luminance(d.how.substr(color, 7));
    EXPECT_LT(now, 0.85 * before) << d.how;
    before = now;
  }
  EXPECT_EQ(dashes.size(), 8U);
  EXPECT_THAT(script, HasSubstr("set label '45°' at first 0.4,"));
  EXPECT_THAT(script, HasSubstr("set label 'intact' at first 0.9,"));
}

TEST(Figures, NamesOfPeaksThatMeetStandAboveOneAnother) {
  FigureData data;
  for (const double theta : {0.0, 15.0, 75.0, 90.0}) data.run.tests.push_back(curve_to(theta, 0.371, 88.3));
  for (int k = 0; k < 200; ++k)  // crowded, at heights that round in every way
    data.run.tests.push_back(curve_to(45.0, 0.371, 61.7 + 0.1037 * k));
  const std::string script = script_of("stress_strain", data);
  std::vector<double> heights;
  for (std::size_t at = script.find("set label"); at != script.npos; at = script.find("set label", at + 1))
    heights.push_back(std::stod(script.substr(script.find(',', at) + 1)));
  ASSERT_EQ(heights.size(), 204U);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_GT(heights[i], heights[i - 1] + 2.0);
}

/// A study of two packings, 90 and 110 MPa at each angle; or three.
Variation packings(std::vector<double> values) {
  Variation v;
  VariedSetting s;
  s.text = "1", s.value = s.factor = 1.0, s.base = true;
  for (const double theta : {0.0, 90.0}) s.ucs.push_back({theta, summarise(values)});
  v.parameters = {{"bedding.mu", {s}}};
  return v;
}

TEST(Figures, TwoPackingsAreTwoPointsAndThreeHaveAnInterval) {
  FigureData data;
  data.variation = packings({9e7, 1.1e8});
  const std::string two = script_of("fig6", data);
  EXPECT_EQ(two.find("yerrorbars"), two.npos);
  const auto rows = drawn_in(two).front().rows;
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_NEAR(rows[0][4], 90.0, 1e-6);
  EXPECT_NEAR(rows[0][5], 110.0, 1e-6);
  EXPECT_THAT(two, testing::AllOf(HasSubstr("using 1:5 with points"), HasSubstr("using 1:6 with points")));
  data.variation = packings({9e7, 1e8, 1.1e8});
  const std::string three = script_of("fig6", data);
  EXPECT_THAT(three, HasSubstr("yerrorbars"));
  EXPECT_EQ(three.find("using 1:5"), three.npos);
}

TEST(Figures, SpecimensFillTheirFigure) {
  const auto height = [](std::size_t n, double aspect) {
    FigureData data;
    for (std::size_t i = 0; i < n; ++i)
      data.run.tests.push_back(test_at(10.0 * static_cast<double>(i), "ucs", aspect));
    const std::string script = script_of("cracks", data),
                      size = fmt::format("size {:.0f},", 190.0 / 25.4 * 96.0);
    return std::stod(script.substr(script.find(size) + size.size())) / 96.0 * 25.4;
  };
  EXPECT_NEAR(height(5, 1.0), 38.0 + 13.0, 0.5);                // squares of 38 mm, title and key
  EXPECT_NEAR(height(5, 2.0), 38.0 * 2.06 / 1.06 + 13.0, 0.5);  // 3 % of the width around each
  EXPECT_NEAR(height(1, 2.0), 60.0 * 2.06 / 1.06 + 13.0, 0.5);  // one alone is not as wide as the figure
}

TEST(Figures, SizesAreThoseOfJournals) {
  FigureData data;
  data.variation = continuum({0.5, 1.0});
  EXPECT_THAT(script_of("fig4", data), HasSubstr(fmt::format("size {:.0f},", 190.0 / 25.4 * 96.0)));
  EXPECT_THAT(script_of("fig4", data, 90.0), HasSubstr(fmt::format("size {:.0f},", 90.0 / 25.4 * 96.0)));
}

TEST(Canvas, ADiscCoversItsArea) {
  Canvas canvas(64, 64, 0xffffff);
  canvas.disc(31.3, 32.1, 20.0, 0x000000);
  double ink = 0.0;
  for (const char c : canvas.rgb()) ink += 1.0 - static_cast<unsigned char>(c) / 255.0;
  EXPECT_NEAR(ink / 3.0, M_PI * 400.0, 0.005 * M_PI * 400.0);
  canvas.disc(-5.0, 70.0, 20.0, 0xff0000);  // partly outside: no more than cut
}

// One disc moves by a tenth of the picture; the crack appears with its strain.
TEST(SpecimenPicture, FollowsTheTest) {
  SpecimenRecord t;
  t.scene.width = t.scene.height = 0.01;
  t.scene.discs = {{0.003, 0.005, 0.001}, {0.005, 0.005, 0.001}};
  for (const float u : {0.0F, 0.001F}) {
    Frame f;
    f.axial_strain = static_cast<double>(u);
    f.u = {{{u, 0.0F}}, {{u, 0.0F}}};
    t.scene.frames.push_back(f);
  }
  CrackEvent crack;
  crack.strain = 0.0008, crack.a = 0, crack.b = 1, crack.normal = {1.0, 0.0}, crack.size = 0.002;
  t.result.cracks = {crack};
  const auto drawn = [&](double strain) {
    Canvas canvas(100, 100, 0xffffff);
    draw_specimen(canvas, t, {0.0, 0.0, 1e4, 1.0, true}, strain);
    return canvas;
  };
  const auto color = [](const Canvas& c, int x, int y) {
    Color out = 0;
    for (std::size_t k = 0; k < 3; ++k)
      out = out << 8U |
            static_cast<unsigned char>(c.rgb()[static_cast<std::size_t>(3 * (y * c.width() + x)) + k]);
    return out;
  };
  EXPECT_EQ(color(drawn(0.0), 30, 50), disc_colors[0]);
  EXPECT_EQ(color(drawn(0.0), 68, 50), 0xffffffU);
  EXPECT_NE(color(drawn(0.001), 68, 50), 0xffffffU);  // arrived
  EXPECT_EQ(color(drawn(0.001), 50, 55), crack_colors[0]);
  EXPECT_NE(color(drawn(0.0005), 45, 45), crack_colors[0]);
}

}  // namespace
}  // namespace phy::report
