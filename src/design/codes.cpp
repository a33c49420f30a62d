#include "design/codes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/exact_math.hpp"
#include "base/quote.hpp"
#include "base/version.hpp"

namespace phy::design {
namespace {

using enum Constant;
using V = const Values&;

// What several codes ask for beside the constants themselves.
double none(V) { return 0.0; }  // dilation: no test of the design fits it
double dip(V v) { return v.dip; }
double normal_across(V v) { return plane_normal(v.dip).x; }
double normal_up(V v) { return plane_normal(v.dip).y; }
/// Strain across the planes over that along them, under load along them.
double nu_across(V v) { return v(nu_n) * v(E) / v(E_n); }
/// a of Abbo & Sloan's hyperbola with which uniaxial tension fails at sigma_t; 0: it fails before by c and
/// phi.
double cut_off(V v) {
  const SinCos f = sin_cos_degrees(v(phi));
  const double cohesion = v(c) * f.cos, pull = v(sigma_t);
  const double square = (cohesion - pull * (1.0 + f.sin) / 2.0) * (cohesion + pull * (3.0 - f.sin) / 6.0);
  return std::sqrt(std::max(0.0, square)) / f.sin;
}

template <Constant constant>
double of(V v) {
  return v(constant);
}

constexpr const char* ubiquitous_page =
    "https://docs.itascacg.com/pfc600/common/models/ubiquit/doc/propubiquit.html";
constexpr const char* anisotropic_page =
    "https://docs.itascacg.com/pfc600/common/models/caniso/doc/propcaniso.html";
constexpr const char* plaxis_page =
    "https://bentleysystems.service-now.com/community?id=kb_article_view&sysparm_article=KB0045555";
constexpr const char* rs2_page = "https://github.com/Rocscience/rs2-scripting (src/rs2/modeler/properties)";
constexpr const char* ogs_elastic_page =
    "https://github.com/ufz/ogs/blob/master/MaterialLib/SolidModels/LinearElasticTransverseIsotropic.h";
constexpr const char* ogs_joint_page =
    "https://github.com/ufz/ogs/blob/master/MaterialLib/SolidModels/MFront/"
    "MohrCoulombAbboSloanUBIOrtho.mfront";

const std::vector<CodeRow> flac_planes = {
    {"joint-cohesion", of<c_j>, 1.0, "Pa", "cohesion of the planes"},
    {"joint-friction", of<phi_j>, 1.0, "deg", "friction angle of the planes"},
    {"joint-dilation", none, 1.0, "deg", "not fitted"},
    {"joint-tension", of<sigma_tj>, 1.0, "Pa", "tension limit of the planes"},
    {"normal-x", normal_across, 1.0, "1", "normal of the planes; the section is x-z, z upwards"},
    {"normal-y", none, 1.0, "1", "the planes strike along y"},
    {"normal-z", normal_up, 1.0, "1", "the planes dip in the section"}};

constexpr const char* flac_axes =
    "The section is x-z, z upwards; the planes strike along y. Dilation is not fitted.";

std::vector<CodeRow> with_planes(std::vector<CodeRow> rows) {
  rows.insert(rows.end(), flac_planes.begin(), flac_planes.end());
  return rows;
}

Code flac_ubiquitous() {
  return {"FLAC",
          "ubiquitous-joint",
          "flac-ubiquitous-joint.dat",
          ubiquitous_page,
          Syntax::flac,
          with_planes({{"young", of<E>, 1.0, "Pa", "along the planes"},
                       {"poisson", of<nu>, 1.0, "1", "in the planes"},
                       {"cohesion", of<c>, 1.0, "Pa", "between the planes"},
                       {"friction", of<phi>, 1.0, "deg", "between the planes"},
                       {"dilation", none, 1.0, "deg", "not fitted"},
                       {"tension", of<sigma_t>, 1.0, "Pa", "tension limit along the planes"}}),
          {"SI units. Stresses of FLAC are negative in compression; strengths are positive.",
           "The model is isotropic until it fails. E and nu are those along the planes; "
           "flac-ubiquitous-anisotropic.dat has all five constants.",
           flac_axes, "FLAC takes the smaller of tension and c/tan(phi), of planes and of rock."},
          {"zone cmodel assign ubiquitous-joint"}};
}

Code flac_anisotropic() {
  return {"FLAC",
          "ubiquitous-anisotropic",
          "flac-ubiquitous-anisotropic.dat",
          anisotropic_page,
          Syntax::flac,
          with_planes({{"young-plane", of<E>, 1.0, "Pa", "along the planes"},
                       {"young-normal", of<E_n>, 1.0, "Pa", "normal to the planes"},
                       {"poisson-plane", of<nu>, 1.0, "1", "in the planes, under load in the planes"},
                       {"poisson-normal", of<nu_n>, 1.0, "1", "in the planes, under load normal to them"},
                       {"shear-normal", of<G_n>, 1.0, "Pa", "of planes normal to the planes of isotropy"}}),
          {"SI units. Stresses of FLAC are negative in compression; strengths are positive.", flac_axes,
           "The rock between the planes stays elastic in this model."},
          {"zone cmodel assign ubiquitous-anisotropic"}};
}

Code plaxis() {
  return {
      "PLAXIS",
      "Jointed Rock",
      "plaxis-jointed-rock.csv",
      plaxis_page,
      Syntax::table,
      {{"", of<E>, 1e-3, "kN/m^2", "Young's modulus along plane 1"},
       {"", of<nu>, 1.0, "1", "Poisson's ratio in plane 1, under load in plane 1"},
       {"", of<E_n>, 1e-3, "kN/m^2", "Young's modulus normal to plane 1"},
       {"", of<nu_n>, 1.0, "1", "strain along plane 1 over that across it, under load across it"},
       {"", of<G_n>, 1e-3, "kN/m^2", "shear modulus of sections normal to plane 1"},
       {"", of<c_j>, 1e-3, "kN/m^2", "cohesion on plane 1"},
       {"", of<phi_j>, 1.0, "deg", "friction angle on plane 1"},
       {"", none, 1.0, "deg", "dilatancy angle on plane 1, not fitted"},
       {"", of<sigma_tj>, 1e-3, "kN/m^2", "tensile strength across plane 1"},
       {"", dip, 1.0, "deg", "inclination of plane 1 in the section, counter-clockwise from x"}},
      {"The article does not name the parameters: they are given by their meaning. Strengths are positive.",
       "The intact rock of this model stays elastic. Its c and phi are in design.csv, for the "
       "user-defined model of the article, which fails by Mohr-Coulomb too.",
       "Whether PLAXIS's second Poisson's ratio counts the load across plane 1 or along it: see its "
       "manual."}};
}

Code rs2() {
  return {
      "RS2",
      "Jointed Mohr-Coulomb, transversely isotropic",
      "rs2-jointed-mohr-coulomb.py",
      rs2_page,
      Syntax::python_rs2,
      {{"elastic.setYoungsModulusE1AndEz(", of<E>, 1e-6, "MPa", "along the planes"},
       {"elastic.setYoungsModulusE2(", of<E_n>, 1e-6, "MPa", "normal to the planes"},
       {"elastic.setPoissonsRatioV12(", nu_across, 1.0, "1", "strain across over along, under load along"},
       {"elastic.setPoissonsRatioVAndV1z(", of<nu>, 1.0, "1", "in the planes"},
       {"elastic.setShearModulus(", of<G_n>, 1e-6, "MPa", "of sections normal to the planes"},
       {"elastic.setAngleCounterclockwiseFromHorizontalToE1(", dip, 1.0, "deg", "of the planes"},
       {"rock.setPeakCohesion(", of<c>, 1e-6, "MPa", "between the planes"},
       {"rock.setPeakFrictionAngle(", of<phi>, 1.0, "deg", "between the planes"},
       {"rock.setPeakTensileStrength(", of<sigma_t>, 1e-6, "MPa", "along the planes"},
       {"options.setInclination(0, ", dip, 1.0, "deg", "counter-clockwise from the x axis"},
       {"planes.setPeakCohesion(", of<c_j>, 1e-6, "MPa", "of the planes"},
       {"planes.setPeakFrictionAngle(", of<phi_j>, 1.0, "deg", "of the planes"},
       {"planes.setTensileStrength(", of<sigma_tj>, 1e-6, "MPa", "across the planes"}},
      {"For a model whose unit of stress is MPa. Stresses of RS2 are positive in compression.",
       "Residual strengths and dilation are not fitted and stay as they are in the model.",
       "The library does not say how v12 counts; here it is nu' E/E'."},
      {"from rs2.modeler.RS2Modeler import RS2Modeler", "from rs2.modeler.properties.PropertyEnums import *",
       "", "model = RS2Modeler().openFile(r\"MODEL.fez\")", "material = model.getAllMaterialProperties()[0]",
       "material.Stiffness.setElasticType(MaterialElasticityTypes.TRANSVERSELY_ISOTROPIC)",
       "elastic = material.Stiffness.TransverselyIsotropic",
       "material.Strength.setFailureCriterion(StrengthCriteriaTypes.JOINTED_MOHR_COULOMB)",
       "rock = material.Strength.JointedMohrCoulomb", "options = rock.getJointOptions()",
       "options.setNumberOfJoints(1)", "joint = options.getJoint(0)",
       "joint.setSlipCriterion(JointTypes.MOHR_COULOMB)", "planes = joint.MohrCoulombMaterial"},
      {"model.save()"}};
}

Code ogs_elastic() {
  return {"OpenGeoSys",
          "LinearElasticTransverseIsotropic",
          "ogs-elastic.xml",
          ogs_elastic_page,
          Syntax::xml,
          {{"youngs_modulus_i", of<E>, 1.0, "Pa", ""},
           {"youngs_modulus_a", of<E_n>, 1.0, "Pa", ""},
           {"poissons_ratio_ii", of<nu>, 1.0, "1", ""},
           {"poissons_ratio_ia", nu_across, 1.0, "1", ""},
           {"shear_modulus_ia", of<G_n>, 1.0, "Pa", ""}},
          {"SI units; stresses of OpenGeoSys are positive in tension. For two dimensions, plane strain.",
           "basis_vector_1 is the normal of the planes. poissons_ratio_ia = nu' E/E'."}};
}

Code ogs_joint() {
  return {
      "OpenGeoSys",
      "MohrCoulombAbboSloanUBIOrtho",
      "ogs-ubiquitous-joint.xml",
      ogs_joint_page,
      Syntax::xml,
      {{"YoungModulus1", of<E_n>, 1.0, "Pa", ""},
       {"YoungModulus2", of<E>, 1.0, "Pa", ""},
       {"YoungModulus3", of<E>, 1.0, "Pa", ""},
       {"PoissonRatio12", of<nu_n>, 1.0, "1", ""},
       {"PoissonRatio23", of<nu>, 1.0, "1", ""},
       {"PoissonRatio13", of<nu_n>, 1.0, "1", ""},
       {"ShearModulus12", of<G_n>, 1.0, "Pa", ""},
       {"PlaneCohesion", of<c_j>, 1.0, "Pa", ""},
       {"PlaneFrictionAngle", of<phi_j>, 1.0, "deg", ""},
       {"PlaneDilatancyAngle", none, 1.0, "deg", ""},
       {"Cohesion", of<c>, 1.0, "Pa", ""},
       {"FrictionAngle", of<phi>, 1.0, "deg", ""},
       {"DilatancyAngle", none, 1.0, "deg", ""},
       {"TransitionAngle", [](V) { return 29.0; }, 1.0, "deg", ""},
       {"TensionCutOffParameter", cut_off, 1.0, "Pa", ""}},
      {"SI units; stresses of OpenGeoSys are positive in tension. For two dimensions, plane strain.",
       "basis_vector_0 is the normal of the planes. The planes have no tensile cut-off in this model.",
       "By TensionCutOffParameter uniaxial tension fails at sigma_t. TransitionAngle rounds corners and is "
       "no property of the rock."},
      {"<type>MFront</type>", "<behaviour>MohrCoulombAbboSloanUBIOrtho</behaviour>"}};
}

// ---- files

/// Six digits: more would be below every interval.
std::string digits(double value) { return fmt::format("{:.6g}", value == 0.0 ? 0.0 : value); }

std::string text_of(const CodeRow& row, V v) { return digits(row.factor * row.value(v)); }

/// A remark where c and phi fail before sigma_t; empty: they do not.
std::string remark_on_tension(const Code& code, V v) {
  const bool asked = std::ranges::any_of(
      code.rows, [](const CodeRow& r) { return r.value == of<sigma_t> || r.value == cut_off; });
  if (!asked || v(sigma_t) <= v.tension_by_cohesion()) return "";
  return fmt::format(
      "sigma_t is above the {} Pa at which c and phi fail in uniaxial tension: there they fail first.",
      digits(v.tension_by_cohesion()));
}

std::string head(const Code& code, V v, const std::string& rock, const char* mark) {
  std::string text =
      fmt::format("{} {}: {} for {}, by {}\n", mark, comment_text(rock), code.model, code.name, phy::program);
  text += fmt::format("{} {}: {}\n", mark, *code.rows.front().name != '\0' ? "Names" : "Model", code.source);
  for (const char* note : code.notes) text += fmt::format("{} {}\n", mark, note);
  const std::string remark = remark_on_tension(code, v);
  return remark.empty() ? text : text + fmt::format("{} {}\n", mark, remark);
}

/// Lines of a script: one statement per row.
std::string script(const Code& code, V v, const std::string& rock) {
  // Each language has its own mark of a comment.
  const bool flac = code.syntax == Syntax::flac;
  std::string text = head(code, v, rock, flac ? ";" : "#");
  for (const char* line : code.before) text += std::string(line) + "\n";
  for (const CodeRow& row : code.rows)
    text += flac ? fmt::format("zone property {} {}  ; {}, {}\n", row.name, text_of(row, v), row.unit,
                               row.meaning)
                 : fmt::format("{}{})  # {}, {}\n", row.name, text_of(row, v), row.unit, row.meaning);
  for (const char* line : code.after) text += std::string(line) + "\n";
  return text;
}

std::string table(const Code& code, V v, const std::string& rock) {
  std::string text = head(code, v, rock, "#") + "value,unit,meaning\n";
  // No document names the rows: their meaning has to do.
  for (const CodeRow& row : code.rows)
    text += fmt::format("{},{},{}\n", text_of(row, v), row.unit, csv_cell(row.meaning));
  return text;
}

std::string xml_parameter(const std::string& name, const std::string& values) {
  return fmt::format("    <parameter><name>{}</name><type>Constant</type><values>{}</values></parameter>\n",
                     name, values);
}

/// Parts of a project, to be put into one: constitutive relation, axes, parameters.
std::string xml(const Code& code, V v, const std::string& rock) {
  const bool mfront = !code.before.empty();  // its properties are listed, and its first axis is the normal
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n", relation, parameters;
  std::string comment = head(code, v, rock, " ");
  // Two hyphens would end the comment early.
  for (std::size_t at; (at = comment.find("--")) != std::string::npos;) comment.replace(at, 2, "- ");
  if (!mfront) relation = fmt::format("        <type>{}</type>\n", code.model);
  for (const char* line : code.before) relation += fmt::format("        {}\n", line);
  if (mfront) relation += "        <material_properties>\n";
  for (const CodeRow& row : code.rows) {
    relation +=
        fmt::format(fmt::runtime(mfront ? "          <material_property name=\"{0}\" parameter=\"{0}\"/>\n"
                                        : "        <{0}>{0}</{0}>\n"),
                    row.name);
    parameters += xml_parameter(row.name, text_of(row, v));
  }
  if (mfront) relation += "        </material_properties>\n";
  // A right-handed pair of axes, one of them the normal.
  const double x = normal_across(v), y = normal_up(v);
  // In all digits: OpenGeoSys refuses axes whose determinant is not 1 to the last bit but one.
  const auto axis = [](double a, double b) { return fmt::format("{} {}", a + 0.0, b + 0.0); };
  const std::string normal = axis(x, y), along = mfront ? axis(-y, x) : axis(y, -x);
  parameters += xml_parameter("e0", mfront ? normal : along) + xml_parameter("e1", mfront ? along : normal);
  return text + "<!--\n" + comment +
         "-->\n<OpenGeoSysProject>\n  <processes>\n    <process>\n"
         "      <constitutive_relation>\n" +
         relation +
         "      </constitutive_relation>\n    </process>\n"
         "  </processes>\n  <local_coordinate_system>\n    <basis_vector_0>e0</basis_vector_0>\n"
         "    <basis_vector_1>e1</basis_vector_1>\n  </local_coordinate_system>\n  <parameters>\n" +
         parameters + "  </parameters>\n</OpenGeoSysProject>\n";
}

/// Empty where nobody knows.
std::string known_cell(double value) { return std::isfinite(value) ? digits(value) : ""; }
std::string angle_cell(const Key& key) { return known_cell(key.theta); }

}  // namespace

double Values::tension_by_cohesion() const {
  const SinCos f = sin_cos_degrees((*this)(phi));
  return 2.0 * (*this)(c)*f.cos / (1.0 + f.sin);
}

double Values::operator()(Constant constant) const {
  // No constant is in two parts.
  for (const Pooled* part : parts)
    if (part != nullptr && part->ok())
      if (const ConstantEstimate* e = part->find({constant})) return e->value;
  return nan;
}

std::span<const Code> codes() {
  static const std::vector<Code> list = {flac_ubiquitous(), flac_anisotropic(), plaxis(), rs2(),
                                         ogs_elastic(),     ogs_joint()};
  return list;
}

std::optional<std::string> file_of(const Code& code, const Values& values, const std::string& rock) {
  // Half a material would run with the code's defaults in the gaps.
  for (const CodeRow& row : code.rows)
    if (!std::isfinite(row.value(values))) return {};
  switch (code.syntax) {
    case Syntax::flac:
    case Syntax::python_rs2: return script(code, values, rock);
    case Syntax::xml: return xml(code, values, rock);
    case Syntax::table: return table(code, values, rock);
  }
  return {};
}

std::string constants_csv(const Values& values) {
  std::string text =
      "part,name,theta [deg],beta [deg],value,unit,se,low,high,draws,fit_error,left_out_error,meaning\n";
  for (std::size_t p = 0; p < n_parts; ++p) {
    const Pooled* part = values.parts[p];
    if (part == nullptr || !part->ok()) continue;
    for (const ConstantEstimate& e : part->constants) {
      const ConstantInfo& c = info(e.key.constant);
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", word_of(static_cast<Part>(p)), c.name,
                          angle_cell(e.key), known_cell(90.0 - e.key.theta), digits(e.value), c.unit,
                          digits(e.se), digits(e.low), digits(e.high), e.n_draws,
                          static_cast<Part>(p) == Part::tension ? "" : known_cell(part->error),
                          known_cell(part->left_out), csv_cell(c.meaning));
    }
  }
  return text;
}

std::string covariance_csv(const Values& values) {
  std::string text = "part,one,one theta [deg],other,other theta [deg],covariance,correlation\n";
  for (std::size_t p = 0; p < n_parts; ++p) {
    const Pooled* part = values.parts[p];
    if (part == nullptr || !part->ok()) continue;
    for (std::size_t i = 0; i < part->constants.size(); ++i)
      // The matrix is symmetric: its lower triangle.
      for (std::size_t j = 0; j <= i; ++j) {
        const ConstantEstimate &a = part->constants[i], &b = part->constants[j];
        // 1 by definition, as k_beta of planes across the load, it varies with nothing.
        if (!(a.se > 0.0) || !(b.se > 0.0)) continue;
        const double covariance =
            part->covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        text +=
            fmt::format("{},{},{},{},{},{},{}\n", word_of(static_cast<Part>(p)), info(a.key.constant).name,
                        angle_cell(a.key), info(b.key.constant).name, angle_cell(b.key),
                        known_cell(covariance), known_cell(covariance / (a.se * b.se)));
      }
  }
  return text;
}

}  // namespace phy::design
