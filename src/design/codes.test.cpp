#include "design/codes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <pugixml.hpp>
#include <regex>
#include <sstream>

namespace phy::design {
namespace {

using enum Constant;
using testing::DoubleNear;
using testing::Pair;
using testing::UnorderedElementsAre;

/// Values that six digits hold, so that what is read back is the same.
Pooled pooled(std::initializer_list<std::pair<Constant, double>> values) {
  Pooled p;
  p.refusal = Refusal::none;
  for (const auto& [constant, value] : values)
    p.constants.push_back({{constant}, value, value, value, 0.1, 4});
  const auto n = static_cast<Eigen::Index>(p.constants.size());
  p.covariance = Eigen::MatrixXd::Identity(n, n);
  return p;
}
const Pooled elasticity = pooled({{E, 31.25e9}, {E_n, 12.5e9}, {nu, 0.27}, {nu_n, 0.16}, {G_n, 6.3e9}});
const Pooled joint = pooled({{c_j, 11.5e6}, {phi_j, 22.5}, {c, 24e6}, {phi, 45.0}});
const Pooled tension = pooled({{sigma_tj, 3.25e6}, {sigma_t, 7.5e6}});
Values all_values() { return {{&elasticity, &joint, &tension, nullptr, nullptr}, 30.0}; }

const Code& code_of(const std::string& file) {
  for (const Code& code : codes())
    if (file == code.file) return code;
  throw std::runtime_error(file);
}
std::string text_of(const std::string& file) { return file_of(code_of(file), all_values(), "shale").value(); }

using Numbers = std::map<std::string, double>;
/// Every line that matches: its name and its number.
Numbers numbers_in(const std::string& text, const char* line) {
  Numbers numbers;
  const std::regex pattern(line);
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
    numbers[(*it)[1]] = std::stod((*it)[2]);
  return numbers;
}
constexpr double sin_30 = 0.5, cos_30 = 0.866025;  // of the dip, to six digits

TEST(Codes, FlacReadsUbiquitousJoint) {
  EXPECT_THAT(
      numbers_in(text_of("flac-ubiquitous-joint.dat"), R"(\nzone property (\S+) (\S+))"),
      UnorderedElementsAre(Pair("young", 31.25e9), Pair("poisson", 0.27), Pair("cohesion", 24e6),
                           Pair("friction", 45.0), Pair("dilation", 0.0), Pair("tension", 7.5e6),
                           Pair("joint-cohesion", 11.5e6), Pair("joint-friction", 22.5),
                           Pair("joint-dilation", 0.0), Pair("joint-tension", 3.25e6),
                           Pair("normal-x", -sin_30), Pair("normal-y", 0.0), Pair("normal-z", cos_30)));
}

TEST(Codes, FlacReadsUbiquitousAnisotropic) {
  EXPECT_THAT(numbers_in(text_of("flac-ubiquitous-anisotropic.dat"), R"(\nzone property (\S+) (\S+))"),
              UnorderedElementsAre(
                  Pair("young-plane", 31.25e9), Pair("young-normal", 12.5e9), Pair("poisson-plane", 0.27),
                  Pair("poisson-normal", 0.16), Pair("shear-normal", 6.3e9), Pair("joint-cohesion", 11.5e6),
                  Pair("joint-friction", 22.5), Pair("joint-dilation", 0.0), Pair("joint-tension", 3.25e6),
                  Pair("normal-x", -sin_30), Pair("normal-y", 0.0), Pair("normal-z", cos_30)));
}

TEST(Codes, Rs2RunsTheScript) {
  // v12 = nu' E/E' = 0.16 * 2.5.
  EXPECT_THAT(
      numbers_in(text_of("rs2-jointed-mohr-coulomb.py"), R"(\n(\w+\.set\w+)\((?:0, )?([-+.e\d]+)\)  #)"),
      UnorderedElementsAre(
          Pair("elastic.setYoungsModulusE1AndEz", 31250.0), Pair("elastic.setYoungsModulusE2", 12500.0),
          Pair("elastic.setPoissonsRatioV12", 0.4), Pair("elastic.setPoissonsRatioVAndV1z", 0.27),
          Pair("elastic.setShearModulus", 6300.0),
          Pair("elastic.setAngleCounterclockwiseFromHorizontalToE1", 30.0),
          Pair("rock.setPeakCohesion", 24.0), Pair("rock.setPeakFrictionAngle", 45.0),
          Pair("rock.setPeakTensileStrength", 7.5), Pair("options.setInclination", 30.0),
          Pair("planes.setPeakCohesion", 11.5), Pair("planes.setPeakFrictionAngle", 22.5),
          Pair("planes.setTensileStrength", 3.25)));
}

TEST(Codes, PlaxisHasTheTable) {
  std::vector<double> values;
  const std::string text = text_of("plaxis-jointed-rock.csv");
  const std::regex row(R"(\n([-+.e\d]+),(kN/m\^2|1|deg),)");
  for (std::sregex_iterator it(text.begin(), text.end(), row), end; it != end; ++it)
    values.push_back(std::stod((*it)[1]));
  EXPECT_THAT(values,
              testing::ElementsAre(31.25e6, 0.27, 12.5e6, 0.16, 6.3e6, 11500.0, 22.5, 0.0, 3250.0, 30.0));
}

/// Parameters of a project, and the words by which its constitutive relation asks for them.
struct Project {
  std::map<std::string, std::string> parameters;
  std::vector<std::string> asked;
};
Project project_in(const std::string& text, const char* asks) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(text.c_str()));
  Project p;
  for (const auto& node : document.select_nodes("/OpenGeoSysProject/parameters/parameter"))
    p.parameters[node.node().child_value("name")] = node.node().child_value("values");
  for (const auto& node : document.select_nodes(asks))
    p.asked.emplace_back(node.attribute() ? node.attribute().value() : node.node().child_value());
  return p;
}
Project project_of(const std::string& file, const char* asks) { return project_in(text_of(file), asks); }
double number(const Project& p, const char* name) { return std::stod(p.parameters.at(name)); }
std::pair<double, double> axis(const Project& p, const char* name) {
  std::istringstream text(p.parameters.at(name));
  std::pair<double, double> xy;
  text >> xy.first >> xy.second;
  return xy;
}

TEST(Codes, OpenGeoSysReadsTheElasticity) {
  const Project p = project_of("ogs-elastic.xml", "//constitutive_relation/*[not(self::type)]");
  EXPECT_EQ(p.asked.size(), 5u);
  for (const std::string& name : p.asked) EXPECT_TRUE(p.parameters.contains(name)) << name;
  EXPECT_EQ(number(p, "youngs_modulus_i"), 31.25e9);
  EXPECT_EQ(number(p, "youngs_modulus_a"), 12.5e9);
  EXPECT_EQ(number(p, "poissons_ratio_ii"), 0.27);
  EXPECT_EQ(number(p, "poissons_ratio_ia"), 0.4);
  EXPECT_EQ(number(p, "shear_modulus_ia"), 6.3e9);
  EXPECT_NEAR(axis(p, "e0").first, cos_30, 1e-6);
  EXPECT_NEAR(axis(p, "e1").first, -sin_30, 1e-6);
}

// ParameterLib/CoordinateSystem.cpp of OpenGeoSys ends the program where it is not.
TEST(Codes, AxesOfOpenGeoSysHaveADeterminantOfOne) {
  Values values = all_values();
  for (const double dip : {0.0, 30.0, -37.5, 11.1, 90.0, -90.0})
    for (const char* file : {"ogs-elastic.xml", "ogs-ubiquitous-joint.xml"}) {
      values.dip = dip;
      const Project p = project_in(file_of(code_of(file), values, "shale").value(), "//type");
      const auto [a, b] = axis(p, "e0");
      const auto [c, d] = axis(p, "e1");
      EXPECT_LE(std::fabs(a * d - b * c - 1.0), std::numeric_limits<double>::epsilon()) << file << dip;
    }
}

/// The yield function of MohrCoulombAbboSloanUBIOrtho.mfront under uniaxial tension, whose Lode angle is -30
/// degrees: beyond the transition angle, where its corners are rounded.
double yield_in_tension(double c, double phi, double a, double transition, double pull) {
  const double rad = std::numbers::pi / 180.0, t = transition * rad, third = 3.0 * t, s = std::sin(phi * rad);
  const double i = 1.0 / std::sqrt(3.0), one = std::cos(t) - i * s * std::sin(t),
               two = -std::sin(t) + i * s * std::cos(t), three = 18.0 * std::pow(std::cos(third), 3);
  const double B = (-std::sin(6.0 * t) * one - 6.0 * std::cos(6.0 * t) * two) / three,
               C = (-std::cos(third) * one + 3.0 * std::sin(third) * two) / three,
               A = i * s * std::sin(t) + B * std::sin(third) - C * std::pow(std::sin(third), 2) + std::cos(t);
  const double K = A - B + C, J2 = pull * pull / 3.0;
  return pull / 3.0 * s + std::sqrt(J2 * K * K + a * a * s * s) - c * std::cos(phi * rad);
}

TEST(Codes, OpenGeoSysFailsInTensionAtTheTensileStrength) {
  const Project p = project_of("ogs-ubiquitous-joint.xml", "//type");
  const double a = number(p, "TensionCutOffParameter"), transition = number(p, "TransitionAngle");
  EXPECT_GT(a, 0.0);
  EXPECT_NEAR(yield_in_tension(24e6, 45.0, a, transition, 7.5e6), 0.0, 1e-3 * 24e6);
}

TEST(Codes, ATensionAboveTheOtherLawIsStated) {
  const Pooled strong = pooled({{sigma_tj, 3.25e6}, {sigma_t, 27e6}});
  const Values values{{&elasticity, &joint, &strong, nullptr, nullptr}, 30.0};
  // 2 c cos 45 / (1 + sin 45)
  EXPECT_NEAR(values.tension_by_cohesion(), 19.882e6, 1e3);
  for (const Code& code : codes()) {
    const bool asks = code.file != std::string("ogs-elastic.xml") && code.name != std::string("PLAXIS") &&
                      code.file != std::string("flac-ubiquitous-anisotropic.dat");
    EXPECT_EQ(file_of(code, values, "shale").value().find("there they fail first") != std::string::npos,
              asks);
    EXPECT_EQ(text_of(code.file).find("there they fail first"), std::string::npos);
  }
}

TEST(Codes, OpenGeoSysReadsTheUbiquitousJoint) {
  const Project p = project_of("ogs-ubiquitous-joint.xml", "//material_property/@parameter");
  EXPECT_EQ(p.asked.size(), 15u);
  for (const std::string& name : p.asked) EXPECT_TRUE(p.parameters.contains(name)) << name;
  EXPECT_EQ(number(p, "YoungModulus1"), 12.5e9);
  EXPECT_EQ(number(p, "YoungModulus2"), 31.25e9);
  EXPECT_EQ(number(p, "PoissonRatio12"), 0.16);
  EXPECT_EQ(number(p, "PoissonRatio23"), 0.27);
  EXPECT_EQ(number(p, "ShearModulus12"), 6.3e9);
  EXPECT_EQ(number(p, "PlaneCohesion"), 11.5e6);
  EXPECT_EQ(number(p, "PlaneFrictionAngle"), 22.5);
  EXPECT_EQ(number(p, "Cohesion"), 24e6);
  EXPECT_EQ(number(p, "FrictionAngle"), 45.0);
  EXPECT_NEAR(axis(p, "e0").second, cos_30, 1e-6);
}

TEST(Codes, TablesHaveEveryConstant) {
  const std::string text = constants_csv(all_values());
  const Numbers values = numbers_in(text, R"(\n[^,]+,(\w+),,,([^,]+),)");
  EXPECT_THAT(values, UnorderedElementsAre(Pair("E", 31.25e9), Pair("E_n", 12.5e9), Pair("nu", 0.27),
                                           Pair("nu_n", 0.16), Pair("G_n", 6.3e9), Pair("c_j", 11.5e6),
                                           Pair("phi_j", 22.5), Pair("c", 24e6), Pair("phi", 45.0),
                                           Pair("sigma_tj", 3.25e6), Pair("sigma_t", 7.5e6)));
  // Lower triangles of five, four and two constants.
  const std::string covariances = covariance_csv(all_values());
  EXPECT_EQ(std::count(covariances.begin(), covariances.end(), '\n'), 1 + 15 + 10 + 3);
}

// k_beta of planes across the load is 1 by definition; a pair that no two draws share is not known.
TEST(Codes, CovarianceLeavesOutWhatDoesNotVary) {
  Pooled p = pooled({{sigma_ci, 90e6}, {m, 11.0}, {k_beta, 1.0}});
  p.constants[2].se = 0.0;
  p.covariance(1, 0) = p.covariance(0, 1) = -std::nan("");
  Values values;
  values.parts[static_cast<std::size_t>(Part::hoek_brown)] = &p;
  const std::string text = covariance_csv(values);
  EXPECT_THAT(text, testing::AllOf(testing::Not(testing::HasSubstr("nan")),
                                   testing::Not(testing::HasSubstr("k_beta")),
                                   testing::HasSubstr("Hoek-Brown,m,,sigma_ci,,,\n")));
}

TEST(Codes, NoFileWithoutItsConstants) {
  Values elastic;
  elastic.parts[0] = &elasticity;
  EXPECT_TRUE(file_of(code_of("ogs-elastic.xml"), elastic, "shale"));
  EXPECT_FALSE(file_of(code_of("ogs-ubiquitous-joint.xml"), elastic, "shale"));
}

// A name of somebody else goes into comments of four languages.
TEST(Codes, ANameCannotLeaveItsComment) {
  const std::string name = "shale\nzone delete -->";
  for (const Code& code : codes()) {
    const std::string text = file_of(code, all_values(), name).value();
    EXPECT_EQ(text.find("\nzone delete"), std::string::npos) << code.file;
    if (code.syntax == Syntax::xml) {
      pugi::xml_document document;
      EXPECT_TRUE(document.load_string(text.c_str())) << code.file;
    }
  }
}

TEST(Codes, EveryNameHasADocument) {
  for (const Code& code : codes()) {
    EXPECT_TRUE(std::string(code.source).starts_with("https://")) << code.file;
    EXPECT_FALSE(code.rows.empty());
  }
}

}  // namespace
}  // namespace phy::design
