#include "report/calibration_files.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/exact_math.hpp"
#include "base/quote.hpp"

namespace phy::report {
namespace {

using Json = nlohmann::ordered_json;

Json rows_json(const std::vector<Comparison>& rows) {
  Json list = Json::array();
  for (const Comparison& c : rows) {
    const Target& t = c.target;
    list.push_back(
        {{"property", to_string(t.property)},
         {"unit", t.property == Property::nu ? "1" : "Pa"},
         {"theta [deg]", t.theta},
         {"laboratory", {{"mean", t.mean}, {"sd", t.sd}, {"n", t.n}, {"sd_assumed", t.sd_assumed}}},
         {"model", c.mean},
         {"sd_of_packings", c.sd},
         {"n_packings", c.n_packings},
         {"low", c.low},
         {"high", c.high}});
    if (t.diameter > 0.0) list.back()["diameter [m]"] = t.diameter;
    if (t.property == Property::brazilian) list.back()["not_from_the_centre"] = c.n_invalid;
  }
  return list;
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
              {"determined", e.determined}};
    if (!e.rests_on.empty()) j["rests_on"] = e.rests_on;
    if (!e.next_test.empty()) j["next_test"] = e.next_test;
    list.push_back(std::move(j));
  }
  return list;
}

/// "property value" pairs of one PFC command.
std::string joint_properties(const BeddingRecipe& b) {
  const std::pair<const char*, double> list[] = {
      {"sj_kn", b.k_n},      {"sj_ks", b.k_s},       {"sj_fric", b.mu}, {"sj_da", b.psi},
      {"sj_ten", b.sigma_n}, {"sj_coh", b.cohesion}, {"sj_fa", b.phi},  {"sj_rmul", b.radius_multiplier}};
  std::string text;
  for (const auto& [name, value] : list)
    text += fmt::format("        contact.prop(c,'{}') = {:.8g}\n", name, value);
  return text;
}

/// FISH that gives the contacts of the matrix what they have by their direction, and takes bonds away.
std::string pfc_departures(const MatrixRecipe& m) {
  std::string text;
  if (m.unbonded_fraction > 0.0)
    text += fmt::format(
        "; --- contacts without a bond\n"
        "fish define leave_unbonded\n"
        "  loop foreach local c contact.list('ball-ball')\n"
        "    if math.random.uniform < {:.8g} then\n      contact.method(c,'unbond')\n    endif\n"
        "  endloop\nend\n@leave_unbonded\n\n",
        m.unbonded_fraction);
  if (!m.directional()) return text;
  const auto W = [](double r) { return (1.0 - r) / (1.0 + r); };
  return text + fmt::format(
                    "; --- directions: a is the angle between the normals of contact and foliation\n"
                    "[foliation = {:.8g}]\n"
                    "fish define lay_directions\n"
                    "  local mx = -math.sin(foliation*math.degrad)\n"
                    "  local my = math.cos(foliation*math.degrad)\n"
                    "  loop foreach local c contact.list('ball-ball')\n"
                    "    if contact.prop(c,'pb_state') = 3 then   ; bonded; others have the mean\n"
                    "    local h = comp.x(contact.normal(c))*mx + comp.y(contact.normal(c))*my\n"
                    "    local cos_2a = 2.0*h*h - 1.0\n"
                    "    local of_k = 1.0 + ({:.8g})*cos_2a\n"
                    "    local of_ten = 1.0 + ({:.8g})*cos_2a\n"
                    "    local of_coh = (1.0 + ({:.8g})*cos_2a)*(1.0 + ({:.8g})*(2.0*cos_2a*cos_2a - 1.0))\n"
                    "    contact.prop(c,'kn') = of_k*contact.prop(c,'kn')\n"
                    "    contact.prop(c,'ks') = of_k*contact.prop(c,'ks')\n"
                    "    contact.prop(c,'pb_kn') = of_k*contact.prop(c,'pb_kn')\n"
                    "    contact.prop(c,'pb_ks') = of_k*contact.prop(c,'pb_ks')\n"
                    "    contact.prop(c,'pb_ten') = of_ten*contact.prop(c,'pb_ten')\n"
                    "    contact.prop(c,'pb_coh') = of_coh*contact.prop(c,'pb_coh')\n"
                    "    endif\n"
                    "  endloop\nend\n@lay_directions\n\n",
                    m.foliation, W(m.stiffness_ratio), W(m.tension_ratio), W(m.cohesion_ratio),
                    W(m.cohesion_oblique));
}

/// FISH that turns the contacts of the bedding into smooth joints.
std::string pfc_joints(const Recipe& r) {
  const BeddingRecipe& b = r.bedding.front();
  std::string text = fmt::format(
      "; --- bedding: theta from +x anticlockwise, load along y; PFC's dip turns clockwise\n"
      "[theta = {:.8g}]\n[spacing = {:.8g}]\n[zone = {:.8g}]\n[offset = {:.8g}]\n"
      "fish define lay_bedding\n"
      "  nx = -math.sin(theta*math.degrad)\n  ny = math.cos(theta*math.degrad)\n"
      "  loop foreach local c contact.list('ball-ball')\n",
      b.theta, b.spacing, b.zone_thickness, b.offset);
  if (b.rule == BeddingRule::zone)
    text +=
        "    local h = comp.x(contact.pos(c))*nx + comp.y(contact.pos(c))*ny - offset ; origin: centre of "
        "specimen\n"
        "    local k = math.floor(h/spacing + 0.5)\n"
        "    if math.abs(h - k*spacing) <= 0.5*zone then                ; zone rule\n";
  else
    text +=
        "    local h1 = comp.x(ball.pos(contact.end1(c)))*nx + comp.y(ball.pos(contact.end1(c)))*ny - "
        "offset\n"
        "    local h2 = comp.x(ball.pos(contact.end2(c)))*nx + comp.y(ball.pos(contact.end2(c)))*ny - "
        "offset\n"
        "    if math.floor(h1/spacing) # math.floor(h2/spacing) then    ; crossing rule\n";
  return text +
         "      if contact.model(c) = 'linearpbond' then\n"
         "        contact.model(c) = 'smoothjoint'\n" +
         joint_properties(b) +
         "        contact.prop(c,'dip') = 180.0 - theta\n"
         "        contact.method(c,'bond')\n"
         "      endif\n    endif\n  endloop\nend\n@lay_bedding\n";
}

}  // namespace

std::string calibration_json(const Calibration& c, const std::string& version) {
  Json j;
  j["format"] = calibration_format;
  j["program"] = {{"name", "phyllite"}, {"version", version}};
  j["rock"] = c.rock;
  j["verdict"] = {{"status", to_string(c.verdict.status)}, {"findings", c.verdict.findings}};
  j["parameters"] = parameters_json(c.parameters);
  j["fitted"] = rows_json(c.fitted);
  j["verification"] = rows_json(c.verification);
  j["left_out"] = rows_json(c.left_out);
  for (std::size_t i = 0; i < c.left_out.size(); ++i)
    j["left_out"][i]["interpolated"] = interpolated(c.left_out, c.left_out[i].target);
  j["E_is"] = to_string(c.E_is), j["layers"] = to_string(c.layers);
  j["tangent_from_test"] = rows_json(c.tangent_from_test);
  j["notes"] = c.notes;
  j["mixing"] = {{"effective_sample_size", c.mixing.effective}, {"r_hat", c.mixing.r_hat}};
  j["runs"] = {{"strength_tests", c.n_strength_tests},
               {"of_these_coarse", c.n_coarse_tests},
               {"of_these_in_tension", c.n_tension_tests},
               {"elastic_solutions", c.n_elastic}};
  return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string pfc_commands(const Recipe& r) {
  const MatrixRecipe& m = r.matrix;
  const bool pfc5 = m.stiffness_convention == StiffnessConvention::pfc5;
  std::string text = fmt::format(
      "; {} - written by phyllite calibrate, for PFC2D 6 and later. SI units, unit thickness.\n"
      "; Reads on from a settled packing of {:g}-{:g} mm discs, {:g} x {:g} mm, centred at the origin.\n"
      "; Check the names of properties against the manual of your version.\n\n"
      "ball attribute density {:.8g} damp {:.8g}\n"
      "; --- matrix: linear contacts and parallel bonds\n"
      "contact model linearpbond range contact type 'ball-ball'\n"
      "contact method bond gap {:.8g} range contact type 'ball-ball'   ; {:g} of the mean radius\n",
      comment_text(r.name), r.packing.radius_min * 1e3, r.packing.radius_max * 1e3, r.specimen.width * 1e3,
      r.specimen.height * 1e3, m.density, r.engine.damping,
      m.bond_gap * 0.5 * (r.packing.radius_min + r.packing.radius_max), m.bond_gap);
  text += pfc5
              ? fmt::format(
                    "contact method deformability emod {:.8g} kratio {:.8g} range contact type 'ball-ball'\n",
                    m.E_c, 1.0 / m.ks_over_kn)
              : fmt::format(
                    "contact property kn {:.8g} ks {:.8g} range contact type 'ball-ball'   ; PFC 3.1: k_n = "
                    "E_c t\n",
                    m.E_c, m.ks_over_kn * m.E_c);
  text += fmt::format(
      "contact method pb_deformability emod {:.8g} kratio {:.8g} range contact type 'ball-ball'\n"
      "contact property fric {:.8g} pb_rmul {:.8g} pb_mcf {:.8g} pb_fa {:.8g} lin_mode 1 range contact type "
      "'ball-ball'\n"
      "[sigma_c = {:.8g}]\n[sigma_c_sd = {:.8g}]\n[tau_c = {:.8g}]\n[tau_c_sd = {:.8g}]\n"
      "fish define draw(mean, sd)   ; normal, drawn again beyond 3 SD\n"
      "  local z = math.random.gauss\n"
      "  loop while math.abs(z) > 3.0\n    z = math.random.gauss\n  endloop\n"
      "  draw = mean + sd*z\nend\n"
      "fish define draw_strengths\n"
      "  loop foreach local c contact.list('ball-ball')\n"
      "    if contact.model(c) = 'linearpbond' then\n"
      "      contact.prop(c,'pb_ten') = draw(sigma_c,sigma_c_sd)\n"
      "      contact.prop(c,'pb_coh') = draw(tau_c,tau_c_sd)\n"
      "    endif\n  endloop\nend\n@draw_strengths\n\n",
      m.E_b, 1.0 / m.bond_ks_over_kn, m.mu, m.radius_multiplier, m.moment_contribution, m.phi, m.sigma_c,
      m.sigma_c_sd, m.tau_c, m.tau_c_sd);
  text += pfc_departures(m);
  if (!r.bedding.empty()) text += pfc_joints(r);
  return text;
}

std::string yade_script(const Recipe& r) {
  const MatrixRecipe& m = r.matrix;
  const bool jointed = !r.bedding.empty();
  const BeddingRecipe b = jointed ? r.bedding.front() : BeddingRecipe{};
  return fmt::format(
             "# -*- coding: utf-8 -*-\n"
             "# {} - written by phyllite calibrate, for Yade's JCFpm model. SI units.\n"
             "# Starting values, to be checked there: JCFpm joins spheres (bond area pi Rmin^2, no bond "
             "moments, friction\n"
             "# inside the shear strength), this calibration discs with parallel bonds. `young` is matched "
             "so that a contact\n"
             "# has the same stiffness per bond area: young = pi/2 (E_c + lambda E_b).\n"
             "{}"
             "from math import atan, pi, radians, sin, cos\nfrom yade import utils\n\n"
             "matrix = JCFpmMat(label='matrix', type=1, density={:.8g}, young={:.8g}, poisson={:.8g},\n"
             "                  frictionAngle=atan({:.8g}), tensileStrength={:.8g}, cohesion={:.8g},\n",
             comment_text(r.name),
             m.directional() || m.unbonded_fraction > 0.0
                 ? "# Directions of the matrix and contacts without a bond are left out: JCFpm has neither.\n"
                 : "",
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
             b.k_n, b.k_s, b.sigma_n, b.cohesion, b.mu, b.psi, b.theta, b.spacing, b.zone_thickness,
             jointed ? "True" : "False");
}

}  // namespace phy::report
