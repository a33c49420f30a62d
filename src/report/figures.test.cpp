#include "report/figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/check.hpp"
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
