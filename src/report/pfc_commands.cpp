#include "report/pfc_commands.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "base/quote.hpp"
#include "report/pfc_properties.hpp"

namespace phy::report {
namespace {

/// Names of PFC's properties of a contact of the matrix.
struct PfcWords {
  const char *model, *state, *tension, *cohesion;
  std::vector<const char*> stiffnesses;
};
PfcWords words_of(const MatrixRecipe& m) {
  if (m.model == MatrixModel::flat_joint)
    return {"flatjoint", "fj_state", "fj_ten", "fj_coh", {"fj_kn", "fj_ks"}};
  return {"linearpbond", "pb_state", "pb_ten", "pb_coh", {"kn", "ks", "pb_kn", "pb_ks"}};
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
  // From the ratio along/across to the amplitude of cos 2a, as the factor is (1 + W)/(1 - W) between the
  // ends.
  const auto W = [](double r) { return (1.0 - r) / (1.0 + r); };
  const PfcWords words = words_of(m);
  text += fmt::format(
      "; --- directions: a is the angle between the normals of contact and foliation\n"
      "[foliation = {:.8g}]\n"
      "fish define lay_directions\n"
      "  local mx = -math.sin(foliation*math.degrad)\n"
      "  local my = math.cos(foliation*math.degrad)\n"
      "  loop foreach local c contact.list('ball-ball')\n"
      "    if contact.prop(c,'{}') = 3 then   ; bonded; others have the mean\n"
      "    local h = comp.x(contact.normal(c))*mx + comp.y(contact.normal(c))*my\n"
      "    local cos_2a = 2.0*h*h - 1.0\n"
      "    local of_k = 1.0 + ({:.8g})*cos_2a\n"
      "    local of_ten = 1.0 + ({:.8g})*cos_2a\n"
      "    local of_coh = (1.0 + ({:.8g})*cos_2a)*(1.0 + ({:.8g})*(2.0*cos_2a*cos_2a - 1.0))\n",
      m.foliation, words.state, W(m.stiffness_ratio), W(m.tension_ratio), W(m.cohesion_ratio),
      W(m.cohesion_oblique));
  for (const char* stiffness : words.stiffnesses)
    // Multiplied after the bonds are there: PFC's methods set stiffness by modulus and know no direction.
    text += fmt::format("    contact.prop(c,'{0}') = of_k*contact.prop(c,'{0}')\n", stiffness);
  for (const auto& [strength, factor] : {std::pair{words.tension, "of_ten"}, {words.cohesion, "of_coh"}})
    text += fmt::format("    contact.prop(c,'{0}') = {1}*contact.prop(c,'{0}')\n", strength, factor);
  return text + "    endif\n  endloop\nend\n@lay_directions\n\n";
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
        // `#` is FISH's "not equal".
        "    if math.floor(h1/spacing) # math.floor(h2/spacing) then    ; crossing rule\n";
  return text + fmt::format("      if contact.model(c) = '{}' then\n", words_of(r.matrix).model) +
         "        contact.model(c) = 'smoothjoint'\n" + pfc_joint_properties(b) +
         "        contact.prop(c,'dip') = 180.0 - theta\n"
         // A new contact model begins unbonded, and a joint with strength but without a bond has none.
         "        contact.method(c,'bond')\n"
         "      endif\n    endif\n  endloop\nend\n@lay_bedding\n";
}

/// The number of elements is read-only once a flat joint is there (manual of PFC 6, flat-joint properties).
std::string pfc_flat_joints(const MatrixRecipe& m) {
  std::string text = fmt::format(
      "contact method deformability emod {:.8g} kratio {:.8g} range contact type 'ball-ball'\n"
      "contact property fj_fric {:.8g} fj_fa {:.8g} range contact type 'ball-ball'\n",
      // PFC's kratio is k_n/k_s, the recipe's its inverse.
      m.E_c, 1.0 / m.ks_over_kn, m.mu, m.phi);
  return text;
}

std::string pfc_matrix(const Recipe& r) {
  const MatrixRecipe& m = r.matrix;
  const bool flat = m.model == MatrixModel::flat_joint;
  const PfcWords words = words_of(m);
  std::string text =
      flat ? fmt::format(
                 "; --- matrix: flat joints\n"
                 "contact cmat default type ball-ball model flatjoint property fj_nr {} fj_rmul "
                 "{:.8g}\ncontact cmat apply range contact type 'ball-ball'\n",
                 m.elements, m.radius_multiplier)
           : std::string(
                 "; --- matrix: linear contacts and parallel bonds\n"
                 "contact model linearpbond range contact type 'ball-ball'\n");
  text += fmt::format("contact method bond gap {:.8g} range contact type 'ball-ball'{}\n",
                      // PFC takes one gap for all pairs, so a reach that grows with the discs is that of the
                      // mean disc.
                      m.bond_reach(0.5 * (r.packing.radius_min + r.packing.radius_max)),
                      m.bond_gap > 0.0 ? "" : "   ; discs that touch");
  text += flat ? pfc_flat_joints(m) : pfc_matrix_properties(m);
  return text + fmt::format(
                    "[sigma_c = {:.8g}]\n[sigma_c_sd = {:.8g}]\n[tau_c = {:.8g}]\n[tau_c_sd = {:.8g}]\n"
                    "fish define draw(mean, sd)   ; normal, drawn again beyond 3 SD\n"
                    "  local z = math.random.gauss\n"
                    "  loop while math.abs(z) > 3.0\n    z = math.random.gauss\n  endloop\n"
                    "  draw = mean + sd*z\nend\n"
                    "fish define draw_strengths\n"
                    "  loop foreach local c contact.list('ball-ball')\n"
                    "    if contact.model(c) = '{}' then\n"
                    "      contact.prop(c,'{}') = draw(sigma_c,sigma_c_sd)\n"
                    "      contact.prop(c,'{}') = draw(tau_c,tau_c_sd)\n"
                    "    endif\n  endloop\nend\n@draw_strengths\n\n",
                    m.sigma_c, m.sigma_c_sd, m.tau_c, m.tau_c_sd, words.model, words.tension, words.cohesion);
}

/// What a recipe has and the commands do not say.
std::string pfc_omissions(const Recipe& r) {
  std::string text;
  const auto omit = [&](bool has, const char* what) {
    if (has) text += fmt::format("; NOT IN THIS FILE: {}\n", what);
  };
  const MatrixRecipe& m = r.matrix;
  const bool flat = m.model == MatrixModel::flat_joint;
  // A comment in the file and no error: parameters that PFC can hold are of use without the rest.
  omit(flat && m.break_at == BreakAt::edge,
       "break_at = \"edge\"; PFC holds the stress at the centroid against fj_ten");
  omit(flat && m.gapped_fraction > 0.0, "contacts that start apart (gapped_fraction)");
  omit(m.unbreakable, "bonds that never break (unbreakable)");
  omit(!r.packing.file.empty(), "the packing of packing.file: radii and numbers above are not its own");
  omit(r.specimen.hole_diameter > 0.0, "the hole in the middle (hole_diameter): delete its balls first");
  omit(r.specimen.flaw_length > 0.0, "the flaw in the middle (flaw_length): delete its balls first");
  omit(r.engine.grain_inertia == GrainInertia::equal, "grains of equal mass (grain_inertia)");
  omit(r.bedding.size() > 1, "all sets of bedding but the first");
  if (r.bedding.empty()) return text;
  const BeddingRecipe& b = r.bedding.front();
  omit(b.rule == BeddingRule::oriented, "joints chosen by the direction of their contact");
  omit(b.persistence < 1.0, "bonded patches of the planes (persistence)");
  omit(b.scatters(), "scatter of spacing and inclination of the planes");
  omit(b.sigma_n_sd > 0.0, "scatter of the joints' tensile strength");
  omit(b.layer_thickness > 0.0, "layers with a matrix of their own");
  omit(!b.bridges, "joints of the zone rule that cross a plane outside the zone (bridges = false)");
  return text;
}

}  // namespace

std::string pfc_commands(const Recipe& r) {
  std::string text = fmt::format(
      "; {} - written by phyllite, for PFC2D 6 and later. SI units, unit thickness.\n"
      "; Reads on from a settled packing of {:g}-{:g} mm discs, {:g} x {:g} mm, centred at the origin.\n"
      "; Check the names of properties against the manual of your version.\n{}\n"
      "ball attribute density {:.8g} damp {:.8g}\n",
      comment_text(r.name), r.packing.radius_min * 1e3, r.packing.radius_max * 1e3, r.specimen.width * 1e3,
      // PFC's local damping is the same number, and is set before anything moves.
      r.specimen.height * 1e3, pfc_omissions(r), r.matrix.density, r.engine.damping);
  text += pfc_matrix(r) + pfc_departures(r.matrix);
  const bool on_planes = !r.bedding.empty() && r.bedding.front().rule != BeddingRule::oriented;
  return on_planes ? text + pfc_joints(r) : text;
}

}  // namespace phy::report
