#include "records/measured_property.hpp"

#include <algorithm>
#include <array>

namespace phy {
namespace {

// Widths of prior means: points of a map that were left out are missed by 0.09 - 0.25 in UCS, by 0.2 - 0.4 in
// Brazilian strength (docs/theory/calibration.md, "Prior mean").
constexpr PriorWidth tension_width = {0.3, 0.15, 0.06};

const std::array<MeasuredProperty, n_properties> properties = {
    {{.property = Property::E,
      .name = "E",
      .test_name = "E",
      .meaning = "Young's modulus; the rock file's `E_is` says how it was read",
      .headers = {"E50", "Young", "Young modulus", "Young's modulus", "elastic modulus", "elasticity modulus",
                  "modulus of elasticity", "deformation modulus", "modulus of deformation", "RUCS_E"},
      .axis = "E",
      .shown = {1e-9, "GPa", 1},
      .possible = {1e6, 1e12, "1 MPa <= E <= 1000 GPa"},
      .part = Part::moduli,
      // Judgements, here and below: what passes and what matters (docs/tables.md), and a usual scatter that
      // is worth four degrees of freedom (docs/theory/inference.md).
      .tolerance = 0.03,
      .coarsest = 0.15,
      .usual_scatter = 0.08,
      .under_stress = true,
      .map = {"E50/E_c", "E_small/E_c"}},
     {.property = Property::nu,
      .name = "nu",
      .test_name = "nu",
      .meaning = "apparent Poisson's ratio",
      .headers = {"ν", "v", "Poisson", "Poisson ratio", "Poisson's ratio", "RUCS_MU"},
      .axis = "ν",
      .dimension = Dimension::none,
      .shown = {1.0, "", 3},
      // That of anisotropic rock may be negative or above 0.5.
      .possible = {-0.5, 1.5, "-0.5 <= apparent nu <= 1.5"},
      // Relative errors of a nu near zero would be without bound.
      .absolute = true,
      .part = Part::moduli,
      .tolerance = 0.03,
      .coarsest = 0.1,
      .usual_scatter = 0.03,
      .under_stress = true,
      .map = {"nu50"}},
     {.property = Property::ucs,
      .name = "UCS",
      .test_name = "UCS",
      .meaning = "uniaxial compressive strength; beside a `confining` above 0 it is sigma_1",
      .headers = {"sigma_c", "sigma_ucs", "q_u", "uniaxial compressive strength",
                  "unconfined compressive strength", "uniaxial strength", "compressive strength",
                  "peak strength", "RUCS_UCS"},
      .axis = "UCS",
      .part = Part::compression,
      .tolerance = 0.06,
      .coarsest = 0.15,
      .usual_scatter = 0.10,
      .test = "uniaxial",
      .number = "ucs",
      .map = {"UCS/sigma_c"},
      .prior = {0.15, 0.06, 0.04}},
     {.property = Property::direct_tension,
      .name = "DTS",
      .test_name = "direct tension",
      .meaning = "direct tensile strength",
      .headers = {"direct tensile strength", "direct tension", "uniaxial tensile strength"},
      .axis = "direct tensile strength",
      .part = Part::tension,
      .tolerance = 0.10,
      .coarsest = 0.25,
      .usual_scatter = 0.15,
      .test = "direct_tension",
      .number = "sigma_t",
      // Of layered rock the maps have discs alone, which stand in a quarter turn from their load.
      .map = {"DTS/sigma_c", nullptr, false},
      .prior = tension_width},
     {.property = Property::brazilian,
      .name = "BTS",
      .test_name = "Brazilian tension",
      .meaning = "Brazilian (splitting) tensile strength",
      .headers = {"sigma_t", "sigma_bt", "Brazilian strength", "Brazilian tensile strength",
                  "indirect tensile strength", "splitting tensile strength", "tensile strength", "ITS"},
      .axis = "Brazilian strength",
      .part = Part::tension,
      .tolerance = 0.10,
      .coarsest = 0.25,
      .usual_scatter = 0.15,
      .test = "brazilian",
      .number = "bts",
      .of_discs = true,
      .splits = true,
      .map = {"BTS/sigma_c"},
      .prior = tension_width},
     {.property = Property::confined,
      .name = "sigma_1",
      .test_name = "strength under confinement",
      .meaning = "axial stress at the peak under `confining`",
      .headers = {"s1", "major principal stress", "axial stress at failure"},
      .deviator_headers = {"q", "sigma_d", "sigma_1 - sigma_3", "deviator stress", "deviatoric stress",
                           "stress difference", "differential stress", "peak deviator stress",
                           "peak deviatoric stress"},
      .axis = "σ_1 at the peak",
      .part = Part::compression,
      .tolerance = 0.06,
      .coarsest = 0.15,
      .usual_scatter = 0.10,
      .test = "biaxial",
      .number = "sigma_1",
      .under_stress = true,
      // Wider than UCS: to its expectation comes a growth with the stress, by maps of the same bonds without
      // layers.
      .prior = {0.2, 0.1, 0.06}},
     {.property = Property::crack_initiation,
      .name = "sigma_ci",
      .test_name = "sigma_ci by crack volumetric strain",
      .meaning = "axial stress at which cracks begin, in the test of UCS",
      .headers = {"crack initiation", "crack initiation stress"},
      .axis = "crack initiation σ_ci",
      .part = Part::initiation,
      .tolerance = 0.10,
      .coarsest = 0.25,
      .usual_scatter = 0.15,
      .test = "uniaxial",
      .number = "sigma_ci_strain",
      .read_in = Property::ucs,
      .prior = tension_width},
     {.property = Property::fracture_toughness,
      .name = "K_Ic",
      .test_name = "K_Ic",
      .meaning = "fracture toughness of a semi-circular bend test, notch along the load",
      .headers = {"K_1c", "fracture toughness", "mode I fracture toughness", "mode 1 fracture toughness",
                  "fracture toughness K_Ic", "toughness"},
      .axis = "fracture toughness K_Ic",
      .dimension = Dimension::toughness,
      .shown = {1e-6, "MPa sqrt(m)", 2},
      .possible = {1e3, 1e8, "1 kPa sqrt(m) <= K_Ic <= 100 MPa sqrt(m)"},
      .part = Part::toughness,
      .tolerance = 0.10,
      .coarsest = 0.25,
      .usual_scatter = 0.15,
      .test = "semi_circular_bend",
      .number = "K_Ic_apparent",
      .of_discs = true,
      .splits = true,
      // K_Ic = sigma_t sqrt(pi alpha R) of bonded discs (Potyondy & Cundall 2004).
      .grain_exponent = 0.5,
      // Twenty-two models lie 0.33 about K_Ic/(BTS sqrt(d)) = 2.7 (docs/theory/calibration.md).
      .prior = {0.4, 0.2, 0.06}},
     // A point load has no counterpart in the plane. I_s(50) is about 0.8 of the Brazilian strength by the
     // ISRM (1985, Int. J. Rock Mech. Min. Sci. 22(2):51-60); the relation is empirical and differs from rock
     // to rock, so that its margins are twice those of a Brazilian test.
     {.property = Property::point_load,
      .name = "I_s50",
      .test_name = "point load strength",
      .meaning = "point load strength index I_s(50), load as in a Brazilian test; taken as 0.8 of BTS, an "
                 "empirical relation (ISRM 1985)",
      .headers = {"Is50", "I_s(50)", "point load strength", "point load strength index", "point load index",
                  "PLI", "PLSI", "point load", "point load test", "PLT", "I_s", "Is"},
      .axis = "point load strength I_s(50)",
      .part = Part::tension,
      .tolerance = 0.20,
      .coarsest = 0.50,
      .usual_scatter = 0.20,
      .test = "brazilian",
      .number = "bts",
      .share = 0.8,
      .of_discs = true,
      .splits = true,
      .map = {"BTS/sigma_c"},
      .prior = {0.4, 0.15, 0.06}},
     {.property = Property::shear_peak,
      .name = "tau_peak",
      .test_name = "direct shear of bedding",
      .meaning = "peak shear strength of bedding in direct shear under `sigma_n`; the row needs no angle",
      .headers = {"peak shear strength", "peak shear stress", "shear strength", "tau_p", "t_p"},
      .axis = "peak shear strength",
      .part = Part::bedding,
      .tolerance = 0.10,
      .coarsest = 0.25,
      .usual_scatter = 0.15,
      .test = "direct_shear",
      .number = "tau_peak",
      .under_stress = true,
      .along_bedding = true,
      .prior = {0.3, 0.15, 0.06}},
     {.property = Property::shear_residual,
      .name = "tau_residual",
      .test_name = "residual strength of bedding",
      .meaning = "shear stress behind the peak of `tau_peak`, in the same test",
      .headers = {"residual shear strength", "residual shear stress", "tau_r", "tau_res", "t_r"},
      .axis = "residual shear strength",
      .part = Part::bedding,
      .tolerance = 0.10,
      .coarsest = 0.25,
      .usual_scatter = 0.15,
      .test = "direct_shear",
      .number = "tau_residual",
      .read_in = Property::shear_peak,
      .under_stress = true,
      .along_bedding = true,
      // As narrow as UCS: what slides has mu sigma_n.
      .prior = {0.15, 0.06, 0.04}}}};

}  // namespace

std::span<const MeasuredProperty> measured_properties() { return properties; }

const MeasuredProperty& measured(Property property) { return properties[static_cast<std::size_t>(property)]; }

const MeasuredProperty* find_property(std::string_view name) {
  const auto it = std::find_if(properties.begin(), properties.end(),
                               [&](const MeasuredProperty& p) { return name == p.name; });
  return it == properties.end() ? nullptr : &*it;
}

std::optional<Property> property_of(std::string_view test, std::string_view number) {
  for (const MeasuredProperty& p : properties)
    // A result of the Brazilian test is BTS; the point load index is only read off the same number.
    if (p.test != nullptr && test == p.test && number == p.number && p.share == 1.0) return p.property;
  return std::nullopt;
}

}  // namespace phy
