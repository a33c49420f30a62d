// Headers as laboratories write them.
#include "rock/columns.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace phy::rock {
namespace {

struct Case {
  const char* header;
  Column kind;
  const char* name;
  const char* unit;
};

TEST(RockColumns, AreKnownByTheNamesOfLaboratories) {
  for (const Case& c : {Case{"theta [deg]", Column::theta, "theta", "deg"},
                        Case{"θ (°)", Column::theta, "theta", "deg"},
                        Case{"θ°", Column::theta, "theta", "deg"},
                        Case{"Dip angle, degrees", Column::theta, "theta", "deg"},
                        Case{"β (°)", Column::beta, "beta", "deg"},
                        Case{"E_GPa", Column::value, "E", "GPa"},
                        Case{"E50 (GPa)", Column::value, "E", "GPa"},
                        Case{"Young's modulus [MPa]", Column::value, "E", "MPa"},
                        Case{"ν", Column::value, "nu", ""},
                        Case{"Poisson's ratio (-)", Column::value, "nu", "-"},
                        Case{"σc (MPa)", Column::value, "UCS", "MPa"},
                        Case{"sigma_c_MPa", Column::value, "UCS", "MPa"},
                        Case{"Uniaxial compressive strength / MPa", Column::value, "UCS", "MPa"},
                        Case{"UCS N/mm²", Column::value, "UCS", "MPa"},
                        Case{"mean UCS (MPa)", Column::value, "UCS", "MPa"},
                        Case{"σt, MPa", Column::value, "BTS", "MPa"},
                        Case{"Brazilian Tensile Strength [MPa]", Column::value, "BTS", "MPa"},
                        Case{"direct tensile strength [kN/m2]", Column::value, "DTS", "kPa"},
                        Case{"σ₁ [MPa]", Column::value, "sigma_1", "MPa"},
                        Case{"sigma_1 - sigma_3 [MPa]", Column::value, "deviator", "MPa"},
                        Case{"sigma_1 (MPa) - sigma_3 (MPa)", Column::value, "deviator", "MPa"},
                        Case{"(σ1−σ3) [MPa]", Column::value, "deviator", "MPa"},
                        Case{"q, MPa", Column::value, "deviator", "MPa"},
                        Case{"Young’s modulus (E) [GPa]", Column::value, "E", "GPa"},
                        Case{"Uniaxial compressive strength (UCS), Mpa", Column::value, "UCS", "MPa"},
                        Case{"Bedding inclination (θ) [º]", Column::theta, "theta", "deg"},
                        Case{"Dry strength (UCS) [MPa]", Column::value, "UCS", "MPa"},
                        Case{"UCS (MPa) mean", Column::value, "UCS", "MPa"},
                        Case{"UCS (MPa) SD", Column::scatter, "UCS_sd", "MPa"},
                        Case{"E (GPa) dynamic", Column::value, "E", "GPa"},
                        Case{"σ3 (MPa)", Column::confining, "confining", "MPa"},
                        Case{"cell pressure [MPa]", Column::confining, "confining", "MPa"},
                        Case{"sigma_ci [MPa]", Column::value, "sigma_ci", "MPa"},
                        Case{"UCS_sd [MPa]", Column::scatter, "UCS_sd", "MPa"},
                        Case{"SD of UCS (MPa)", Column::scatter, "UCS_sd", "MPa"},
                        Case{"σc std. dev. (MPa)", Column::scatter, "UCS_sd", "MPa"},
                        Case{"friction angle [deg]", Column::friction, "phi", "deg"},
                        Case{"φ (°)", Column::friction, "phi", "deg"},
                        Case{"c [MPa]", Column::cohesion, "c", "MPa"},
                        Case{"E/10^4 MPa", Column::value, "E", "10^4 MPa"},
                        Case{"number of specimens", Column::n, "n", ""}}) {
    const Head h = head_of(c.header);
    EXPECT_EQ(h.kind, c.kind) << c.header;
    EXPECT_EQ(h.name, c.name) << c.header;
    EXPECT_EQ(h.unit, c.unit) << c.header;
  }
  EXPECT_TRUE(head_of("ucs [MPa]").own);
  EXPECT_TRUE(head_of("E_GPa").own);
  EXPECT_FALSE(head_of("E50 [GPa]").own);
  EXPECT_TRUE(head_of("q [MPa]").deviatoric);
  EXPECT_EQ(head_of("σc (MPa)").shown(), "σc (read as UCS)");
  EXPECT_EQ(head_of("UCS (MPa)").shown(), "UCS");
  EXPECT_FALSE(head_of("sigma_1 [MPa]").deviatoric);
}

TEST(RockColumns, WhatMeansSeveralThingsIsNotGuessed) {
  for (const char* angle : {"Foliation angle (°)", "orientation", "dip direction [deg]", "Angle to bedding",
                            "Inclination from core axis [°]"}) {
    EXPECT_EQ(head_of(angle).kind, Column::other) << angle;
    EXPECT_TRUE(head_of(angle).speaks_of.angles) << angle;
  }
  for (const char* other : {"Sample", "Specimens", "No.", "D [mm]", "Height (mm)", "Load (kN)", "c_sd [MPa]",
                            "phi_sd", "UCS (MPa) residual", "UCS (MPa) dry", "E (MPa) x 10^4", "E [GPa] ± SD",
                            "Vp (km/s)", "Porosity (n)", "Void ratio (e)", "Load at failure (q)", ""}) {
    EXPECT_EQ(head_of(other).kind, Column::other) << other;
    EXPECT_FALSE(head_of(other).speaks_of.angles) << other;
  }
  EXPECT_EQ(head_of("load (kN)").unit, "kN");
  EXPECT_EQ(head_of("density (g/cm³)").unit, "g/cm^3");
}

// 1 MN/m^1.5 = 1 MPa m^0.5: a stress times a root of length is a force over length to 3/2.
TEST(RockColumns, ToughnessIsKnownByItsNamesAndUnits) {
  for (const char* unit : {"MPa sqrt(m)", "MPa m^0.5", "MPa·m^0.5", "MPa*m^0.5", "MPa.m^0.5", "MPa m^1/2",
                           "MPa·m^(1/2)", "MPa m^{1/2}", "MPa m½", "MPa√m", "MPa √m", "MN/m^1.5", "MN m^-1.5",
                           "MN/m^(3/2)", "MN·m^-3/2", "mpa m^0.5"})
    for (const char* form : {"K_Ic [{}]", "K_Ic ({})", "K_Ic, {}", "K_Ic {}"}) {
      std::string header = form;
      header.replace(header.find("{}"), 2, unit);
      const Head h = head_of(header);
      EXPECT_EQ(h.name, "K_Ic") << header;
      EXPECT_EQ(h.unit, "MPa sqrt(m)") << header;
      EXPECT_EQ(dimension_of(h), Dimension::toughness) << header;
    }
  EXPECT_EQ(head_of("K_Ic [kPa m^0.5]").unit, "kPa sqrt(m)");
  EXPECT_EQ(head_of("K_Ic [Pa·√m]").unit, "Pa sqrt(m)");
  EXPECT_EQ(head_of("K_Ic [kN/m^1.5]").unit, "kPa sqrt(m)");
  for (const char* name :
       {"Fracture toughness KIC (MPa·m^0.5)", "Fracture toughness, K_Ic (MPa m^0.5)", "KIC/MPa m^0.5",
        "KIc_MPa_m^0.5", "KIC [MPa√m]", "K_IC (MPa√m)", "K1c [MPa√m]", "Fracture toughness (KIc) [MPa√m]",
        "Mode I fracture toughness, MPa√m", "fracture toughness [MPa m^0.5]", "toughness [MPa m^0.5]"}) {
    EXPECT_EQ(head_of(name).property, Property::fracture_toughness) << name;
    EXPECT_EQ(head_of(name).kind, Column::value) << name;
    EXPECT_EQ(head_of(name).unit, "MPa sqrt(m)") << name;
  }
  EXPECT_TRUE(head_of("K_Ic of the second series [N/mm^(3/2)]").speaks_of.values);
  EXPECT_FALSE(head_of("K_Ic [MPa√m]").speaks_of.values);
  const Head sd = head_of("K_Ic_sd [MPa m^0.5]");
  EXPECT_EQ(sd.kind, Column::scatter);
  EXPECT_EQ(sd.unit, "MPa sqrt(m)");
  EXPECT_EQ(unit_of_cell("[MPa sqrt(m)]"), "MPa sqrt(m)");
  EXPECT_EQ(unit_of_cell("MPa sqrt(m)"), "MPa sqrt(m)");
  EXPECT_EQ(head_of("UCS [MN/m^2]").unit, "MPa");
}

TEST(RockColumns, ModuliSayHowTheyWereRead) {
  EXPECT_EQ(head_of("Et50 (GPa)").E_is, ModulusReading::tangent_50);
  EXPECT_EQ(head_of("E_av [GPa]").E_is, ModulusReading::average);
  EXPECT_EQ(head_of("secant modulus, GPa").E_is, ModulusReading::secant_50);
  EXPECT_EQ(head_of("E dyn [GPa]").E_is, ModulusReading::small_strain);
  EXPECT_FALSE(head_of("E50 [GPa]").E_is);
  EXPECT_FALSE(head_of("Young's modulus [GPa]").E_is);
}

TEST(RockColumns, TheUserHasTheLastWord) {
  const Head h = head_of("Festigkeit (MPa)", "UCS");
  EXPECT_EQ(h.name, "UCS");
  EXPECT_EQ(h.unit, "MPa");
  EXPECT_EQ(h.title, "Festigkeit");
  EXPECT_EQ(head_of("UCS [MPa]", "-").kind, Column::passed);
  EXPECT_EQ(head_of("angle [deg]", "beta").kind, Column::beta);
  EXPECT_EQ(head_of("spread", "E_sd").kind, Column::scatter);
  for (const std::string& name : column_names()) {
    EXPECT_TRUE(head_of(name).own) << name;
    EXPECT_EQ(head_of(name).name, name);
  }
}

}  // namespace
}  // namespace phy::rock
