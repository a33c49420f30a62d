#include "report/calibration_files.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/check.hpp"
#include "base/exact_math.hpp"
#include "base/nan.hpp"
#include "base/quote.hpp"
#include "base/text_table.hpp"
#include "io/json.hpp"
#include "report/baselines.hpp"
#include "report/calibration_summary.hpp"
#include "report/calibration_tables.hpp"
#include "report/finding_json.hpp"
#include "report/methods.hpp"
#include "report/words.hpp"

namespace phy::report {
namespace {

Json failure_json(const FailureMode& f) {
  return {{"bedding_share", f.bedding_share},
          {"bedding_share_sd", f.bedding_share_sd},
          {"angle [deg]", f.angle},
          {"angle_sd [deg]", f.angle_sd},
          {"n_tests", f.n_tests},
          {"n_planes", f.n_planes}};
}

// SI units without exception: names of keys carry them, so that no reader has to know this program's tables.
Json rows_json(const std::vector<Comparison>& rows) {
  Json list = Json::array();
  for (const Comparison& c : rows) {
    const Target& t = c.target;
    list.push_back(
        {{"property", to_string(t.property)},
         {"unit", si_unit(t.property)},
         {"theta [deg]", t.theta},
         {"laboratory", {{"mean", t.mean}, {"sd", t.sd}, {"n", t.n}, {"sd_assumed", t.sd_assumed}}},
         {"model", c.mean},
         {"sd_of_packings", c.sd},
         {"n_packings", c.n_packings},
         {"low", c.low},
         {"high", c.high}});
    // Keys without content are left out: files of rocks with few tests stay readable by eye.
    if (std::isfinite(c.with_discrepancy)) list.back()["with_discrepancy"] = c.with_discrepancy;
    if (!t.specimens.empty()) list.back()["laboratory"]["specimens"] = t.specimens;
    if (t.diameter > 0.0) list.back()["diameter [m]"] = t.diameter;
    if (t.confining > 0.0) list.back()["confining [Pa]"] = t.confining;
    // Only this test can begin to fail beside the centre, where its formula does not hold.
    if (t.property == Property::brazilian) list.back()["not_from_the_centre"] = c.n_invalid;
    if (!c.missing.empty()) list.back()["missing"] = c.missing;
    if (c.failure.n_tests > 0) list.back()["failure"] = failure_json(c.failure);
  }
  return list;
}

Json verdict_json(const Calibration& c) {
  Json next = finding_json(c.verdict.next);
  // The texts are for people and may change with a version; programs read kinds and numbers.
  next["text"] = next_words(c);
  const Finding& counts = c.verdict.counts;
  return {{"status", to_string(c.verdict.status)},
          {"sentence", verdict_words(c)},
          {"lines", verdict_lines(c)},
          // Where nothing was judged, null: zeros would say that all was missed.
          {"counts", counts.has("values") ? finding_json(counts) : Json(nullptr)},
          {"good_for", findings_json(c.verdict.good_for)},
          {"not_good_for", findings_json(c.verdict.not_good_for)},
          {"findings", findings_json(c.verdict.findings)},
          {"causes", findings_json(c.verdict.causes)},
          {"next", std::move(next)}};
}

Json parameters_json(const std::vector<ParameterEstimate>& parameters) {
  Json list = Json::array();
  for (const ParameterEstimate& e : parameters) {
    Json j = {{"key", e.key},
              {"symbol", e.symbol},
              {"unit", e.unit},
              {"value", e.value},
              {"low", e.low},
              {"high", e.high},
              {"box", {e.box_low, e.box_high}},
              // null where nobody knows: false would read as "the table does not tell".
              {"determined", e.has_interval() ? Json(e.determined) : Json(nullptr)}};
    if (e.rests_on.basis != Basis::none) j["rests_on"] = support_json(e.rests_on);
    if (e.next.remedy != Remedy::none) j["next"] = next_json(e.next);
    list.push_back(std::move(j));
  }
  return list;
}

Json eq2_json(const std::vector<PlaneStiffness>& band) {
  const auto relation = [](const StiffnessRelation& r) {
    return Json{
        {"ratio", r.ratio}, {"slope", r.line.slope}, {"intercept", r.line.intercept}, {"R2", r.line.R2}};
  };
  Json list = Json::array();
  for (const PlaneStiffness& s : band)
    list.push_back({{"planes", s.planes}, {"K_n", relation(s.normal)}, {"K_s", relation(s.shear)}});
  return list;
}

/// Parameters in the order of the paper's tables, in words.
Json tables_json(const Calibration& c) {
  Json list = Json::array();
  for (const ParameterTable& t : parameter_rows(c))
    list.push_back({{"title", t.title}, {"head", t.head}, {"rows", t.rows}});
  return list;
}

Json errors_json(const Calibration& c) {
  Json list = Json::array();
  for (const ErrorRow& row : error_rows(c)) {
    Json j = {{"of", row.of}};
    for (std::size_t i = 0; i < n_properties; ++i)
      if (std::isfinite(row.rms[i])) j[to_string(static_cast<Property>(i))] = row.rms[i];
    list.push_back(std::move(j));
  }
  return list;
}

/// Values left out, by the model and by the best curve.
Json yardsticks_json(const Calibration& c) {
  Json list = Json::array();
  for (const LeftOutErrors& e : left_out_errors(c))
    list.push_back({{"property", to_string(e.property)},
                    {"cells", e.cells},
                    {"model", e.model},
                    {"with_discrepancy", e.with_discrepancy},
                    // The key, as in `left_out`; its name in words stands in `text`.
                    {"best", e.best != nullptr ? Json(e.best->key) : Json(nullptr)},
                    {"best_error", e.curve},
                    {"text", sentence(e)}});
  return list;
}

Json discrepancy_json(const std::vector<AngleFactor>& factors) {
  Json list = Json::array();
  for (const AngleFactor& f : factors)
    list.push_back({{"property", to_string(f.test.property)},
                    {"confining [Pa]", f.test.confining},
                    {"diameter [m]", f.test.diameter},
                    {"theta [deg]", f.theta},
                    {"factor", f.factor},
                    {"low", f.low},
                    {"high", f.high}});
  return list;
}

// Kept so that an ensemble of another day can be corrected without the tests of the calibration.
Json residuals_json(const std::vector<StrengthResidual>& residuals) {
  Json list = Json::array();
  for (const StrengthResidual& r : residuals)
    list.push_back({{"property", to_string(r.target.property)},
                    {"theta [deg]", r.target.theta},
                    {"confining [Pa]", r.target.confining},
                    {"laboratory", r.target.mean},
                    {"value", r.value},
                    {"noise", r.noise},
                    {"unknown", r.unknown},
                    {"draws", r.of_draws}});
  return list;
}

/// JSON has no NaN: it was written as null.
double number_of(const Json& j) { return j.is_number() ? j.get<double>() : nan; }

Property property_of(const std::string& name) {
  // By name, as numbers of an enumeration change when a property is added.
  for (int i = 0; i < n_properties; ++i)
    if (name == to_string(static_cast<Property>(i))) return static_cast<Property>(i);
  throw std::out_of_range(name + " is no property");
}

FailureMode failure_from(const Json& j) {
  return {number_of(j.at("bedding_share")),       number_of(j.at("bedding_share_sd")),
          number_of(j.at("angle [deg]")),         number_of(j.at("angle_sd [deg]")),
          io::whole_number<int>(j.at("n_tests")), io::whole_number<int>(j.at("n_planes"))};
}

// Only what pictures, predictions and designs need is read back; texts stay as they were written.
std::vector<Finding> findings_of(const Json& list) {
  std::vector<Finding> findings;
  for (const Json& j : list)
    if (const auto kind = finding_kind_of(j.at("kind").get<std::string>()))
      findings.push_back({*kind, {}, {}, j.value("names", std::vector<std::string>())});
  return findings;
}

std::vector<Comparison> rows_of(const Json& list) {
  std::vector<Comparison> rows;
  for (const Json& j : list) {
    Comparison c;
    const Json& laboratory = j.at("laboratory");
    c.target.property = property_of(j.at("property")), c.target.theta = j.at("theta [deg]");
    c.target.mean = laboratory.at("mean"), c.target.sd = laboratory.at("sd");
    // JSON numbers may be 3.5 or 1e300, which a plain conversion would take without a word.
    c.target.n = io::whole_number<int>(laboratory.at("n"));
    // Keys that are left out when empty have their default here.
    c.target.specimens = laboratory.value("specimens", std::vector<double>());
    c.target.diameter = j.value("diameter [m]", 0.0), c.target.confining = j.value("confining [Pa]", 0.0);
    c.mean = number_of(j.at("model")), c.sd = number_of(j.at("sd_of_packings"));
    c.low = number_of(j.at("low")), c.high = number_of(j.at("high"));
    c.n_packings = io::whole_number<int>(j.at("n_packings"));
    if (j.contains("with_discrepancy")) c.with_discrepancy = number_of(j.at("with_discrepancy"));
    if (j.contains("failure")) c.failure = failure_from(j.at("failure"));
    rows.push_back(std::move(c));
  }
  return rows;
}

std::vector<AngleFactor> factors_of(const Json& list) {
  std::vector<AngleFactor> all;
  for (const Json& j : list) {
    AngleFactor f;
    f.test.property = property_of(j.at("property")), f.test.confining = j.at("confining [Pa]");
    f.test.diameter = j.at("diameter [m]"), f.theta = j.at("theta [deg]");
    f.factor = number_of(j.at("factor")), f.low = number_of(j.at("low")), f.high = number_of(j.at("high"));
    all.push_back(std::move(f));
  }
  return all;
}

std::vector<StrengthResidual> residuals_of(const Json& list) {
  std::vector<StrengthResidual> all;
  for (const Json& j : list) {
    StrengthResidual r;
    r.target.property = property_of(j.at("property")), r.target.theta = j.at("theta [deg]");
    r.target.confining = j.at("confining [Pa]"), r.target.mean = j.at("laboratory");
    // Without a default: a residual that lacks a number would make a wrong band in silence.
    r.value = j.at("value"), r.noise = j.at("noise"), r.unknown = j.at("unknown");
    r.of_draws = j.at("draws").get<std::vector<double>>();
    all.push_back(std::move(r));
  }
  return all;
}

/// Lines of comments in a recipe.
std::string as_comments(const std::string& text) {
  const std::string broken = wrapped(text, 98, 4);
  std::string lines;
  for (std::size_t from = 0; from < broken.size(); from = broken.find('\n', from) + 1)
    lines += "# " + broken.substr(from, broken.find('\n', from) - from + 1);
  return lines + "\n";
}

void read_comparisons(const Json& j, Calibration& c) {
  c.rock = j.at("rock");
  if (j.value("method", "") == "sequence") c.method = CalibrationMethod::sequence;
  c.fitted = rows_of(j.at("fitted")), c.verification = rows_of(j.at("verification"));
  c.left_out = rows_of(j.at("left_out"));
  if (j.contains("discrepancy")) c.discrepancy = factors_of(j.at("discrepancy"));
  if (j.contains("residuals")) c.residuals = residuals_of(j.at("residuals"));
}

Calibration calibration_from(const std::string& json, const std::string& file,
                             void (*read)(const Json&, Calibration&)) {
  Calibration c;
  // Missing keys and wrong types come as exceptions of the JSON library.
  try {
    const Json j = io::parse_json<Json>(json);
    // An older format may use a key in another sense, which no missing key would reveal.
    if (j.at("format") != calibration_format) throw std::out_of_range("another version of the format");
    read(j, c);
  } catch (const std::exception& e) {
    throw InputError(Problem{file, "", "", fmt::format("a calibration of format {}", calibration_format),
                             io::in_words(e)});
  }
  return c;
}

}  // namespace

std::string calibration_json(const Calibration& c, const std::string& version) {
  Json j;
  j["format"] = calibration_format;
  j["program"] = {{"name", "phyllite"}, {"version", version}};
  j["rock"] = c.rock;
  for (const SetOption& o : c.asked)
    // With its type: a program should not have to parse "true".
    std::visit([&](const auto& value) { j["asked"][o.key] = value; }, o.value);
  // Absent for the usual method: readers take it for the posterior.
  if (c.method == CalibrationMethod::sequence) j["method"] = "sequence";
  if (!c.effort.empty()) j["effort"] = c.effort;
  j["verdict"] = verdict_json(c);
  j["tables"] = tables_json(c);
  j["parameters"] = parameters_json(c.parameters);
  j["fitted"] = rows_json(c.fitted);
  j["verification"] = rows_json(c.verification);
  j["left_out"] = rows_json(c.left_out);
  if (!c.compared.empty()) j["compared"] = rows_json(c.compared);
  // Added to the rows written above, beside the model's own prediction of each value.
  for (std::size_t i = 0; i < c.left_out.size(); ++i)
    for (const Baseline& y : baselines())
      j["left_out"][i][y.key] = y.predict(c.left_out, c.left_out[i].target);
  if (!c.discrepancy.empty()) j["discrepancy"] = discrepancy_json(c.discrepancy);
  if (!c.residuals.empty()) j["residuals"] = residuals_json(c.residuals);
  j["errors"] = errors_json(c);
  if (!c.left_out.empty()) j["yardsticks"] = yardsticks_json(c);
  j["E_is"] = to_string(c.E_is), j["layers"] = to_string(c.layers);
  j["matrix"] = c.recipe.matrix.model == MatrixModel::flat_joint ? "flat_joint" : "parallel_bond";
  j["tangent_from_test"] = rows_json(c.tangent_from_test);
  if (!c.eq2.empty()) j["eq2"] = eq2_json(c.eq2);
  if (!c.reach.empty()) j["reach"] = findings_json(c.reach);
  j["notes"] = findings_json(c.notes);
  // Written at the time, so that the text names the version that calibrated and not one that reads.
  j["methods"] = methods_text(c, version);
  // For a reader who knows chains: whether the intervals rest on enough independent draws.
  j["mixing"] = {{"effective_sample_size", c.mixing.effective}, {"r_hat", c.mixing.r_hat}};
  j["runs"] = {{"strength_tests", c.counts.tests},
               {"of_these_coarse", c.counts.coarse},
               {"of_these_in_tension", c.counts.tension},
               {"elastic_solutions", c.counts.solutions}};
  // Names of rocks come from files of any encoding; a wrong byte must not cost the whole result.
  return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Calibration comparisons_of(const std::string& json, const std::string& file) {
  return calibration_from(json, file, read_comparisons);
}

Calibration judged_from(const std::string& json, const std::string& file) {
  return calibration_from(json, file, [](const Json& j, Calibration& c) {
    read_comparisons(j, c);
    c.E_is = modulus_reading_of(j.at("E_is"));
    c.verdict.not_good_for = findings_of(j.at("verdict").at("not_good_for"));
  });
}

std::string recipe_comments(const Calibration& c) {
  // The verdict goes with the file: a recipe is passed on without its folder.
  std::string text = comment_text(c.rock + ": " + verdict_words(c)) + "\n", open;
  std::vector<std::string> known;
  for (const std::string& line : verdict_lines(c)) text += comment_text(line) + "\n";
  for (const ParameterEstimate& e : c.parameters)
    // Open parameters keep a value in the recipe, which looks as certain as the others.
    if (e.open())
      open += fmt::format("  {} = {}, 95 % interval {} to {}\n", comment_text(e.key),
                          parameter_text(e.value, e.unit), parameter_text(e.low, e.unit),
                          parameter_text(e.high, e.unit));
    else
      known.push_back(comment_text(e.symbol));
  text += c.method == CalibrationMethod::sequence
              ? "Found step by step, as the paper does: no intervals, and no word on open parameters.\n"
          : open.empty() && known.empty() ? "No parameter was fitted.\n"
          : open.empty()
              ? "The data constrain what was fitted: " + list_text(known) + ".\n"
              : "The data do not constrain (within the values that the calibration admits):\n" + open;
  return as_comments(text);
}

std::string draw_comments(const Calibration& c, std::size_t number) {
  return as_comments(
      fmt::format("{}: draw {} of {}. Moduli and strengths are one of many sets that the table allows, on a "
                  "packing of their own. A single draw is no estimate: `--ensemble` runs all of them "
                  "(docs/calibration.md, \"Ensemble\"). The calibration says:\n{}\n",
                  comment_text(c.rock), number, c.ensemble.size(), comment_text(verdict_words(c))));
}

std::string yade_script(const Recipe& r) {
  const MatrixRecipe& m = r.matrix;
  const bool jointed = !r.bedding.empty(), flat = m.model == MatrixModel::flat_joint;
  // A script has one set of planes; without bedding its numbers stand there unused.
  const BeddingRecipe b = jointed ? r.bedding.front() : BeddingRecipe{};
  return fmt::format(
             "# -*- coding: utf-8 -*-\n"
             "# {} - written by phyllite calibrate, for Yade's JCFpm model. SI units.\n"
             "# Starting values, to be checked there: JCFpm joins spheres (bond area pi Rmin^2, no bond "
             "moments, friction\n"
             "# inside the shear strength), this calibration discs with {}. `young` is matched so that a "
             "contact\n"
             "# has the same stiffness per bond area: young = pi/2 {}.\n"
             "{}{}"
             "from math import atan, pi, radians, sin, cos\nfrom yade import utils\n\n"
             "matrix = JCFpmMat(label='matrix', type=1, density={:.8g}, young={:.8g}, poisson={:.8g},\n"
             "                  frictionAngle=atan({:.8g}), tensileStrength={:.8g}, cohesion={:.8g},\n",
             comment_text(r.name),
             flat ? "flat joints, whose grains do not roll once bonds are broken" : "parallel bonds",
             flat ? "lambda E_c" : "(E_c + lambda E_b)",
             m.directional() || m.unbonded_fraction > 0.0
                 ? "# Directions of the matrix and contacts without a bond are left out: JCFpm has neither.\n"
             : m.shear_strength == ShearStrength::cohesion_friction
                 ? fmt::format("# The friction angle of the bonds, {:.4g} deg, is left out: JCFpm has one "
                               "friction, mu here.\n",
                               m.phi)
                 : "",
             b.persistence < 1.0
                 ? fmt::format(
                       "# Bridges are left out: here all of each plane is jointed, in this calibration "
                       "{:g} of it.\n",
                       b.persistence)
                 : "",
             // Per bond area a contact has the stiffness young/(pi r) in JCFpm and E/(2 r) here: hence pi/2.
             m.density, 0.5 * pi * m.modulus(), m.ks_over_kn, m.mu, m.sigma_c, m.tau_c) +
         fmt::format(
             "                  jointNormalStiffness={:.8g}, jointShearStiffness={:.8g}, "
             "jointTensileStrength={:.8g},\n"
             "                  jointCohesion={:.8g}, jointFrictionAngle=atan({:.8g}), "
             "jointDilationAngle=radians({:.8g}))\n"
             "O.materials.append(matrix)\n\n"
             "theta, spacing, zone = radians({:.8g}), {:.8g}, {:.8g}\n"
             "normal = Vector3(-sin(theta), cos(theta), 0)\n\n"
             "def lay_bedding(centre, bedded={}):\n"
             "    \"\"\"Marks the spheres at the planes; load along y, theta from +x anticlockwise.\"\"\"\n"
             "    for body in O.bodies:\n"
             "        if not bedded or not isinstance(body.shape, Sphere): continue\n"
             "        h = normal.dot(body.state.pos - centre)\n"
             "        if abs(h - spacing*round(h/spacing)) <= 0.5*zone + body.shape.radius:\n"
             "            body.state.onJoint, body.state.joint, body.state.jointNormal1 = True, 1, normal\n",
             // In radians by Python itself: a person who edits the script thinks in degrees.
             b.k_n, b.k_s, b.sigma_n, b.cohesion, b.mu, b.psi, b.theta, b.spacing, b.zone_thickness,
             jointed ? "True" : "False");
}

}  // namespace phy::report
