#include "base/units.hpp"
#include "base/nan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include "base/rng.hpp"

namespace phy {
namespace {

using testing::HasSubstr;

constexpr Dimension dimensions[] = {Dimension::length,    Dimension::pressure, Dimension::stiffness,
                                    Dimension::angle,     Dimension::speed,    Dimension::density,
                                    Dimension::toughness, Dimension::strain};

double value_of(const char* text, Dimension d) {
  const Quantity q = parse_quantity(text, d);
  EXPECT_TRUE(q.ok) << text << " " << q.problem;
  return q.value;
}

TEST(Units, AnExponentBeyondAllNumbersIsRefused) {
  for (const char* text :
       {"1e99999999999999999999 MPa", "1e-99999999999999999999 MPa", "1e9223372036854775807 MPa",
        "-1e-9223372036854775808 mm", "1e400 MPa", "1e-400 Pa"})
    for (const Dimension d : {Dimension::pressure, Dimension::length})
      EXPECT_FALSE(parse_quantity(text, d).ok) << text;
}

TEST(Units, AreReadByHandCalculation) {
  EXPECT_EQ(value_of("38 mm", Dimension::length), 0.038);
  EXPECT_EQ(value_of("3.8 cm", Dimension::length), 0.038);
  EXPECT_EQ(value_of("415 um", Dimension::length), 0.000415);
  EXPECT_EQ(value_of("3360 GPa/m", Dimension::stiffness), 3.36e12);
  EXPECT_EQ(value_of("3360 MPa/mm", Dimension::stiffness), 3.36e12);
  EXPECT_EQ(value_of("35 deg", Dimension::angle), 35.0);
  EXPECT_EQ(value_of("50 mm/s", Dimension::speed), 0.05);
  EXPECT_EQ(value_of("6.5 MPa", Dimension::pressure), 6.5e6);
  EXPECT_EQ(value_of("2.7 g/cm^3", Dimension::density), 2700.0);
  EXPECT_EQ(value_of("1.5 MPa sqrt(m)", Dimension::toughness), 1.5e6);
  EXPECT_EQ(value_of("850 kPa sqrt(m)", Dimension::toughness), 0.85e6);
  EXPECT_FALSE(parse_quantity("1.5 MPa", Dimension::toughness).ok);
  EXPECT_EQ(value_of("0.3", Dimension::none), 0.3);
}

// By definition: 1 lb = 0.45359237 kg, 1 in = 25.4 mm, g = 9.80665 m/s^2.
TEST(Units, UnitsOfLaboratoriesAreReadByDefinition) {
  const double psi = 0.45359237 * 9.80665 / (0.0254 * 0.0254), kgf_cm2 = 9.80665e4;
  EXPECT_DOUBLE_EQ(value_of("1 psi", Dimension::pressure), psi);
  EXPECT_DOUBLE_EQ(value_of("11.6 ksi", Dimension::pressure), 11600 * psi);
  EXPECT_DOUBLE_EQ(value_of("3 Mpsi", Dimension::pressure), 3e6 * psi);
  EXPECT_DOUBLE_EQ(value_of("816 kgf/cm2", Dimension::pressure), 816 * kgf_cm2);
  EXPECT_DOUBLE_EQ(value_of("8.2 kgf/mm²", Dimension::pressure), 820 * kgf_cm2);
  EXPECT_EQ(value_of("800 bar", Dimension::pressure), 80e6);
  EXPECT_EQ(value_of("3 in", Dimension::length), 0.0762);
  EXPECT_EQ(value_of("2.49 inch", Dimension::length), 0.063246);
  EXPECT_EQ(value_of("1.5e8 N/m2", Dimension::pressure), 1.5e8);
  EXPECT_EQ(value_of("1e13 N/m3", Dimension::stiffness), 1e13);
  EXPECT_DOUBLE_EQ(value_of("1 psi/in", Dimension::stiffness), psi / 0.0254);
  EXPECT_DOUBLE_EQ(value_of("0.5235987755982988 rad", Dimension::angle), 30.0);
  EXPECT_EQ(value_of("5 cm/s", Dimension::speed), 0.05);
  EXPECT_DOUBLE_EQ(value_of("6 mm/min", Dimension::speed), 1e-4);
  EXPECT_EQ(value_of("2.7 t/m3", Dimension::density), 2700.0);
  EXPECT_DOUBLE_EQ(value_of("142 pcf", Dimension::density), 142 * 0.45359237 / (0.3048 * 0.3048 * 0.3048));
  EXPECT_EQ(value_of("300 µε", Dimension::strain), 300e-6);
  EXPECT_EQ(value_of("0.3 ‰", Dimension::strain), 3e-4);
  EXPECT_EQ(value_of("2 ×10⁴ MPa", Dimension::pressure), 2e10);
}

TEST(Units, OneUnitHasManySpellings) {
  const std::pair<const char*, std::vector<const char*>> all[] = {
      {"MPa", {"mpa", "Mpa", "N/mm2", "N/mm²", "N/mm^2", "N mm⁻²", "MN/m2", "MN m^-2", "МПа", "M\xC2\xA0Pa"}},
      {"kgf/cm2", {"kg/cm²", "kgf/cm^2", "кгс/см2", "KGF/CM2"}},
      {"psi", {"PSI", "lb/in²", "lbf/in2", "p.s.i."}},
      {"deg", {"°", "º", "˚", "degrees", "deg.", "град."}},
      {"um", {"µm", "μm", "micron"}},
      {"10^4 MPa",
       {"x10^4 MPa", "×10⁴ MPa", "10^4MPa", "1e4 MPa", "x 10^4 N/mm2", "10**4 MPa", "MPa x 10^4", "MPa×10⁴"}},
      {"10^5 Pa", {"10⁵ Pa", "×10^5 Pa"}},
      {"10^-6 1", {"10^-6", "10⁻⁶", "x10^-6"}},
      {"microstrain", {"µε", "με", "um/m", "Microstrain"}},
      {"MPa sqrt(m)", {"MPa m^0.5", "MPa√m", "MN/m^1.5", "MPa·m^(1/2)", "MPa m½"}}};
  for (const auto& [name, spellings] : all)
    for (const char* text : spellings) {
      const auto unit = find_unit(text);
      ASSERT_TRUE(unit) << text;
      EXPECT_EQ(unit->name, name) << text;
      EXPECT_EQ(find_unit(unit->name)->name, name);
    }
  for (const char* none : {"", "100", "10", "kN", "E", "M", "mean", "UCS", "x", "10 MPa"})
    EXPECT_FALSE(find_unit(none)) << none;
}

TEST(Units, NoSpellingMeansTwoThings) {
  std::map<std::string, std::string> meaning;
  for (const UnitRow& row : unit_rows()) {
    std::istringstream words(row.spellings);
    for (std::string word; std::getline(words >> std::ws, word, ',');) {
      ASSERT_TRUE(find_unit(word)) << word;
      EXPECT_EQ(find_unit(word)->name, row.name) << word;
      EXPECT_TRUE(meaning.emplace(word, row.name).second) << word;
    }
    EXPECT_EQ(find_unit(row.name)->dimension, row.dimension) << row.name;
  }
}

TEST(Units, BlanksSignsAndExponentsAreAllowed) {
  EXPECT_EQ(value_of(" 38mm ", Dimension::length), 0.038);
  EXPECT_EQ(value_of("+3.8e1\tmm", Dimension::length), 0.038);
  EXPECT_EQ(value_of("-3.8E+1 mm", Dimension::length), -0.038);
}

// The text alone decides the bits: the same decimal number in another unit gives the same double. Multiplying
// by a factor would fail here for one number in four.
TEST(Units, AreRoundedOnce) {
  for (int i = 1; i < 10000; ++i) {
    const std::string number = "0." + std::to_string(i);
    const double expected = std::strtod((number + "e-3").c_str(), nullptr);
    EXPECT_EQ(parse_quantity(number + " mm", Dimension::length).value, expected) << number;
    EXPECT_EQ(parse_quantity(number + " GPa", Dimension::pressure).value,
              std::strtod((number + "e9").c_str(), nullptr));
  }
}

TEST(Units, EveryDoubleReadsBackToTheSameBits) {
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const PhiloxBlock random = philox4x32({i, 0, 0, 0}, {1, static_cast<std::uint32_t>(Stream::test)});
    const double any = std::bit_cast<double>(static_cast<std::uint64_t>(random[0]) << 32U | random[1]);
    const double usual =
        (uniform(2, Stream::test, i) - 0.5) * std::pow(10.0, static_cast<int>(random[2] % 30U) - 15);
    for (const Dimension d : dimensions)
      for (const double value : {any, usual}) {
        if (!std::isfinite(value)) continue;
        const std::string text = print_quantity(value, d);
        const Quantity back = parse_quantity(text, d);
        EXPECT_TRUE(back.ok) << text << " " << back.problem;
        EXPECT_EQ(std::bit_cast<std::uint64_t>(back.value), std::bit_cast<std::uint64_t>(value)) << text;
      }
  }
}

TEST(Units, ArePrintedAsPeopleWriteThem) {
  EXPECT_EQ(print_quantity(0.038, Dimension::length), "38 mm");
  EXPECT_EQ(print_quantity(0.000415, Dimension::length), "0.415 mm");
  EXPECT_EQ(print_quantity(10.0, Dimension::length), "10 m");
  EXPECT_EQ(print_quantity(0.0, Dimension::length), "0 mm");
  EXPECT_EQ(print_quantity(-0.0012, Dimension::length), "-1.2 mm");
  EXPECT_EQ(print_quantity(38e9, Dimension::pressure), "38 GPa");
  EXPECT_EQ(print_quantity(6.5e6, Dimension::pressure), "6.5 MPa");
  EXPECT_EQ(print_quantity(3.36e12, Dimension::stiffness), "3360 GPa/m");
  EXPECT_EQ(print_quantity(0.05, Dimension::speed), "0.05 m/s");
  EXPECT_EQ(print_quantity(2700.0, Dimension::density), "2700 kg/m^3");
  EXPECT_EQ(print_quantity(22.5, Dimension::angle), "22.5 deg");
  EXPECT_EQ(print_quantity(1e18, Dimension::stiffness), "1e9 GPa/m");
  EXPECT_EQ(print_quantity(0.3, Dimension::none), "0.3");
  EXPECT_EQ(print_number(nan), "nan");
}

struct Bad {
  const char* name;
  const char* text;
  Dimension dimension;
  const char* says;
};
void PrintTo(const Bad& bad, std::ostream* out) { *out << bad.name; }
class BadQuantity : public testing::TestWithParam<Bad> {};

TEST_P(BadQuantity, SaysWhatIsWrong) {
  const Quantity q = parse_quantity(GetParam().text, GetParam().dimension);
  EXPECT_FALSE(q.ok);
  EXPECT_THAT(q.problem, HasSubstr(GetParam().says));
}

INSTANTIATE_TEST_SUITE_P(
    Messages, BadQuantity,
    testing::Values(Bad{"bare", "38", Dimension::length, "has no unit; write for example \"38 mm\""},
                    Bad{"bare_stress", "5", Dimension::pressure, "\"5 MPa\""},
                    Bad{"bare_angle", "35.5", Dimension::angle, "\"35.5 deg\""},
                    Bad{"other_dimension", "38 mm", Dimension::pressure,
                        "wrong unit \"mm\"; known here: GPa, MPa"},
                    Bad{"one_letter", "65 M", Dimension::length, "wrong unit \"M\""},
                    Bad{"psi_is_no_angle", "30 psi", Dimension::angle, "wrong unit \"psi\""},
                    Bad{"bare_power", "80 10", Dimension::pressure, "wrong unit \"10\""},
                    Bad{"no_sign_of_a_power", "8 10 MPa", Dimension::pressure, "wrong unit \"10 MPa\""},
                    Bad{"trailing", "38 mm x", Dimension::length, "wrong unit \"mm x\""},
                    Bad{"empty", "", Dimension::length, "does not start with a number"},
                    Bad{"word", "wide", Dimension::length, "does not start with a number"},
                    Bad{"nan", "nan mm", Dimension::length, "does not start with a number"},
                    Bad{"infinite", "inf mm", Dimension::length, "does not start with a number"},
                    Bad{"huge", "1e308 GPa", Dimension::pressure, "larger or smaller than a number can be"},
                    Bad{"unit_on_pure_number", "0.3 mm", Dimension::none, "write a bare number"}),
    [](const auto& which) { return std::string(which.param.name); });

// Whoever leaves the unit out thinks in metres or in millimetres: the number tells.
TEST(Units, ABareNumberIsTakenToBeNearTheUsualValue) {
  EXPECT_THAT(parse_quantity("0.016", Dimension::length, 0.05).problem, HasSubstr("\"0.016 m\""));
  EXPECT_THAT(parse_quantity("16", Dimension::length, 0.05).problem, HasSubstr("\"16 mm\""));
  for (const char* size : {"5", "8", "10", "12", "24", "0.5"})
    EXPECT_THAT(parse_quantity(size, Dimension::length, 0.038).problem,
                HasSubstr("\"" + std::string(size) + " mm\""));
  for (const char* speed : {"0.05", "1", "2"})
    EXPECT_THAT(parse_quantity(speed, Dimension::speed, 0.05).problem,
                HasSubstr("\"" + std::string(speed) + " m/s\""));
  for (const char* stress : {"0.1", "0.5", "30", "900"})
    EXPECT_THAT(parse_quantity(stress, Dimension::pressure, 10e6).problem,
                HasSubstr("\"" + std::string(stress) + " MPa\""));
  EXPECT_THAT(parse_quantity("38e9", Dimension::pressure, 38e9).problem, HasSubstr("\"38e9 Pa\""));
  EXPECT_THAT(parse_quantity("2.7", Dimension::density, 2700.0).problem, HasSubstr("\"2.7 g/cm^3\""));
  EXPECT_THAT(parse_quantity("0", Dimension::length, 0.05).problem, HasSubstr("\"0 mm\""));
  EXPECT_THAT(parse_quantity("-40", Dimension::pressure, 65e6).problem, HasSubstr("\"-40 MPa\""));
  EXPECT_THAT(parse_quantity("40", Dimension::pressure, 38e9).problem, HasSubstr("\"40 GPa\""));
  EXPECT_THAT(parse_quantity("40", Dimension::pressure, 65e6).problem, HasSubstr("\"40 MPa\""));
}

TEST(Units, EveryDimensionHasItsInnerUnitAmongTheKnown) {
  for (const Dimension d : dimensions) {
    EXPECT_EQ(value_of(("7 " + inner_unit(d)).c_str(), d), 7.0);
    EXPECT_THAT(unit_names(d), HasSubstr(inner_unit(d)));
  }
  EXPECT_EQ(inner_unit(Dimension::none), "1");
}

}  // namespace
}  // namespace phy
