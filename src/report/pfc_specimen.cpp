#include "report/pfc_specimen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/check.hpp"
#include "base/quote.hpp"
#include "base/units.hpp"
#include "base/vec.hpp"
#include "records/test_description.hpp"
#include "report/pfc_properties.hpp"

namespace phy::report {
namespace {

constexpr const char* sources =
    "; NOT YET RUN IN PFC2D. Written by phyllite for PFC2D 7.0 and later. SI units, unit thickness, load\n"
    "; along y, origin in the lower left corner. Where a command was looked up:\n"
    ";   [D] PFC 7.0 documentation (docs.itascacg.com/pfc700), page of that name, as it is collected in\n"
    ";       github.com/yusong652/pfc-mcp; the vendor's own pages were not read\n"
    ";   [P] only in public data files of users of PFC (FISH functions: in a public list of their names)\n"
    ";   [N] not found anywhere\n";

std::string discs_text(const Packing& packing) {
  std::string text = "; --- discs   [D] ball create\n";
  for (std::size_t i = 0; i < packing.discs.size(); ++i) {
    const Disc& d = packing.discs[i];
    // All digits: rounding moves discs by as much as the gaps that decide which pairs touch.
    text += fmt::format("ball create id {} radius {} position-x {} position-y {}\n", i + 1, print_number(d.r),
                        print_number(d.x), print_number(d.y));
  }
  return text;
}

/// Domain, contact models of pairs to come, discs, platens; the contacts are there at its end.
std::string bodies_text(const Recipe& r, const Specimen& s) {
  const MatrixRecipe& m = r.matrix;
  const Packing& p = *s.packing;
  const double w = p.width, h = p.height;
  double r_max = 0.0, reach = 0.0;
  for (const Disc& d : p.discs) r_max = std::max(r_max, d.r);
  for (const Contact& c : s.contacts)
    // Pairs with a gap are bonded here, too; PFC makes no contact farther apart than its proximity.
    reach = std::max(reach, norm(Vec2{p.discs[c.b].x - p.discs[c.a].x, p.discs[c.b].y - p.discs[c.a].y}) -
                                p.discs[c.a].r - p.discs[c.b].r);
  const std::string stiffness =
      m.stiffness_convention == StiffnessConvention::pfc5
          ? fmt::format("method deformability emod {:.8g} kratio {:.8g} property", m.E_c, 1.0 / m.ks_over_kn)
          : fmt::format("property kn {:.8g} ks {:.8g}", m.E_c, m.ks_over_kn * m.E_c);
  return fmt::format(
             "model new                                      ; [P]\n"
             "model large-strain on                          ; [P]\n"
             "model domain extent {:.8g} {:.8g} {:.8g} {:.8g}   ; [D]\n"
             "; pairs that meet later are linear contacts without a bond   [D] contact cmat default\n"
             "contact cmat default type ball-ball model linearpbond {} fric {:.8g}\n"
             "; a disc and a rigid platen: 2 E_c t\n"
             "contact cmat default type ball-facet model linear property kn {:.8g} ks {:.8g} fric {:.8g}\n"
             "contact cmat proximity {:.8g}                  ; [D]\n",
             // The domain is wide enough for fragments, which may not leave it.
             -w, 2.0 * w, -h, 2.0 * h, stiffness, m.mu, 2.0 * m.E_c, 2.0 * m.ks_over_kn * m.E_c,
             // A little more, so that rounding in PFC loses no pair at the very limit.
             r.test.platen_friction, 1.001 * reach + 1e-6 * r_max) +
         discs_text(p) +
         fmt::format(
             "ball attribute density {:.8g} damp {:.8g}      ; [D]\n"
             "; --- platens   [D] wall create\n"
             "wall create id 1 name 'bottom' vertices {:.8g} 0 {:.8g} 0\n"
             "wall create id 2 name 'top' vertices {:.8g} {} {:.8g} {}\n"
             "model clean                                    ; [D] contact cmat proximity: finds the "
             "contacts\n",
             // Platens are twice as wide as the specimen, which bulges.
             m.density, r.engine.damping, -0.5 * w, 1.5 * w, -0.5 * w, print_number(h), 1.5 * w,
             print_number(h));
}

constexpr const char* contact_functions =
    "; --- contacts by the numbers of their discs\n"
    "; [P] ball.find, ball.contactmap, contact.typeid, contact.end1, contact.end2, contact.group, "
    "contact.prop,\n"
    ";     contact.list, contact.gap, comp.x, comp.y, math.abs\n"
    "; [D] properties of linear, linearpbond and smoothjoint\n"
    "[lost = 0]\n"
    "fish define contact_of(a, b)\n"
    "  contact_of = null\n"
    "  local other = ball.find(b)\n"
    "  loop foreach local c ball.contactmap(ball.find(a), contact.typeid('ball-ball'))\n"
    "    if contact.end1(c) = other then\n      contact_of = c\n    endif\n"
    "    if contact.end2(c) = other then\n      contact_of = c\n    endif\n"
    "  endloop\n"
    "  if contact_of = null then\n    lost = lost + 1\n  endif\nend\n"
    "; discs that overlap at the start press from there on: the overlaps are free of stress\n"
    "fish define free_of_stress\n"
    "  loop foreach local c contact.list('ball-ball')\n"
    "    contact.prop(c,'lin_mode') = 0\n"
    "    if contact.gap(c) < 0.0 then\n      contact.prop(c,'rgap') = contact.gap(c)\n    endif\n"
    "  endloop\n"
    "  loop foreach local w contact.list('ball-facet')\n"
    "    if contact.gap(w) < 0.0 then\n      contact.prop(w,'rgap') = contact.gap(w)\n    endif\n"
    "  endloop\nend\n@free_of_stress\n";

// A contact without a bond keeps its kind here and has the strength 0.
bool holds(const Contact& c) { return c.kind == ContactKind::bonded && c.sigma_c > 0.0; }

std::string bonds_text(const Specimen& s) {
  std::string text =
      "; --- bonds: discs, tensile strength [Pa], cohesion [Pa]\n"
      "fish define bond(a, b, ten, coh)\n"
      "  local c = contact_of(a, b)\n"
      "  if c # null then\n"
      "    contact.group(c) = 'bond'\n"
      "    contact.prop(c,'pb_ten') = ten\n"
      "    contact.prop(c,'pb_coh') = coh\n"
      "  endif\nend\n";
  // One line per bond with the strength that was drawn here: PFC's own draw would be another specimen.
  for (const Contact& c : s.contacts)
    if (holds(c))
      // Identifiers of PFC begin at 1.
      text += fmt::format("[bond({},{},{},{})]\n", c.a + 1, c.b + 1, print_number(c.sigma_c),
                          print_number(c.tau_c));
  return text +
         "contact method bond gap 1.0 range group 'bond'   ; [D] contact method; 1 m: all of the group\n";
}

/// Turns a joint as its plane lies, and counts those that PFC has laid otherwise.
constexpr const char* joint_function =
    "[turned = 0]\n[swapped = 0]\n"
    "fish define joint(a, b, theta, side, ten)\n"
    "  local c = contact_of(a, b)\n"
    "  if c # null then\n"
    "    contact.prop(c,'dip') = 180.0 - theta\n"
    "    contact.prop(c,'sj_ten') = ten\n"
    "    contact.prop(c,'sj_state') = 3\n"
    "    local n = contact.prop(c,'sj_unorm')\n"
    "    local along = side*(math.cos(theta*math.degrad)*comp.y(n) - "
    "math.sin(theta*math.degrad)*comp.x(n))\n"
    "    if contact.end1(c) = ball.find(b) then\n      along = -along\n    endif\n"
    "    if math.abs(along) < 0.999 then\n      turned = turned + 1\n    endif\n"
    "    if along < -0.999 then\n      swapped = swapped + 1\n    endif\n"
    "  endif\nend\n";

std::string joints_text(const Specimen& s) {
  // Without joints the functions would stand in the file for nothing.
  if (std::none_of(s.contacts.begin(), s.contacts.end(),
                   [](const Contact& c) { return c.kind == ContactKind::joint; }))
    return "";
  std::string text =
      "; --- smooth joints: discs, set, theta [deg] from +x anticlockwise, side (+1: the normal of the "
      "plane\n"
      "; points from the first disc to the second), tensile strength [Pa]\n"
      "; [D] contact model, sj_state may be set; [P] 3: bonded; [N] that dip = 180 - theta, so the normals "
      "are\n"
      "; counted that PFC has laid otherwise\n"
      "fish define mark_joint(a, b)\n"
      "  local c = contact_of(a, b)\n"
      "  if c # null then\n    contact.group(c) = 'joint'\n  endif\nend\n";
  for (const Contact& c : s.contacts)
    if (c.kind == ContactKind::joint) text += fmt::format("[mark_joint({},{})]\n", c.a + 1, c.b + 1);
  text += "contact model smoothjoint range group 'joint'\n";
  for (std::size_t k = 0; k < s.bedding.size(); ++k)
    text += fmt::format("fish define set_{}(c)\n", k + 1) + pfc_joint_properties(s.bedding[k]) + "end\n";
  text += joint_function;
  for (const Contact& c : s.contacts) {
    if (c.kind != ContactKind::joint) continue;
    const int set = s.set_of(c.set);
    const BeddingRecipe& b = s.bedding_of(c.set);
    text += fmt::format("[set_{}(contact_of({},{}))]\n[joint({},{},{},{},{})]\n", set + 1, c.a + 1, c.b + 1,
                        c.a + 1, c.b + 1, print_number(b.theta), int{c.side},
                        // The contact holds its strength as a multiple of the set's: both make the strength
                        // that was drawn.
                        print_number(b.sigma_n * c.sigma_n));
  }
  return text;
}

// PFC runs on when a contact is missing; only a count tells that the specimen is another one.
std::string counts_text(const Specimen& s) {
  const auto n = [&](const auto& is) { return std::count_if(s.contacts.begin(), s.contacts.end(), is); };
  const auto n_joints = n([](const Contact& c) { return c.kind == ContactKind::joint; });
  return fmt::format(
      "; --- what there should be: {} discs, {} bonds, {} joints\n"
      "[io.out('contacts that were not found (0): ' + string(lost))]   ; [P]\n{}",
      s.packing->discs.size(), n(holds), n_joints,
      n_joints == 0 ? ""
                    : "[io.out('joints of another direction (0): ' + string(turned))]\n"
                      "[io.out('joints of the other side (0): ' + string(swapped))]\n");
}

std::string head(const Recipe& r, const Specimen& s) {
  return fmt::format("; {}, {}\n{}", comment_text(r.name), comment_text(s.name), sources);
}

// The test of this program step by step, so that both curves may differ by their engines alone.
std::string test_text(const Recipe& r, const Specimen& s, const std::string& stem) {
  const TestRecipe& t = r.test;
  // Both platens move.
  const double rate = 2.0 * t.platen_speed / s.packing->height;
  return fmt::format(
      "program call '{0}-specimen.p2dat'   ; [P]\n"
      "[width = {1}]\n[height = {2}]\n[speed = {3:.8g}]\n"
      "[ramp = {4:.8g}]      ; seconds in which the speed rises\n"
      "[stop_at = {5:.8g}]\n[post_peak = {6:.8g}]\n[max_strain = {7:.8g}]\n"
      "; [P] wall.find, wall.vel.y, wall.disp.y, wall.force.contact.y, mech.timestep, array.create, string,\n"
      ";     file.open, file.write, file.close, model cycle in a command of FISH\n"
      "[top = wall.find(2)]\n[bottom = wall.find(1)]\n"
      // FISH arrays do not grow; a test that fills it ends.
      "[rows = array.create(100000)]\n"
      "[rows(1) = 'axial_strain [1],axial_stress [Pa],n_cracks [1]']\n"
      "[n = 1]\n[strain = 0.0]\n[stress = 0.0]\n[peak = 0.0]\n[at_peak = 0.0]\n[cracks = 0]\n"
      "fish define unbroken   ; [D] pb_state and sj_state: 3 is bonded\n"
      "  unbroken = 0\n"
      "  loop foreach local c contact.list('ball-ball')\n"
      "    if contact.model(c) = 'linearpbond' then\n"
      "      if contact.prop(c,'pb_state') = 3 then\n        unbroken = unbroken + 1\n      endif\n"
      "    endif\n"
      "    if contact.model(c) = 'smoothjoint' then\n"
      "      if contact.prop(c,'sj_state') = 3 then\n        unbroken = unbroken + 1\n      endif\n"
      "    endif\n"
      "  endloop\nend\n"
      "[whole = unbroken]\n"
      "fish define move(share)\n"
      "  wall.vel.y(bottom) = share*speed\n"
      "  wall.vel.y(top) = -share*speed\nend\n"
      "fish define read_row\n"
      "  strain = (wall.disp.y(bottom) - wall.disp.y(top))/height\n"
      // Mean of both platens: the difference of the two is inertia.
      "  stress = 0.5*(wall.force.contact.y(top) - wall.force.contact.y(bottom))/width\n"
      "  cracks = whole - unbroken\n"
      "  n = n + 1\n"
      "  rows(n) = string(strain) + ',' + string(stress) + ',' + string(cracks)\n"
      "  if stress > peak then\n    peak = stress\n    at_peak = strain\n  endif\nend\n"
      "fish define press\n"
      "  local t = 0.0\n"
      "  loop while t < ramp\n"
      "    move(t/ramp)\n"
      "    command\n      model cycle 1\n    endcommand\n"
      "    t = t + mech.timestep\n"
      "  endloop\n"
      "  move(1.0)\n"
      "  local going = 1\n"
      "  loop while going = 1\n"
      "    command\n      model cycle {8}\n    endcommand\n"
      "    read_row\n"
      // As in the press here: fewer than three cracks are chance.
      "    if cracks > 2 then\n"
      "      if stress < stop_at*peak then\n        going = 0\n      endif\n"
      "      if strain > (1.0 + post_peak)*at_peak then\n        going = 0\n      endif\n"
      "    endif\n"
      "    if strain > max_strain then\n      going = 0\n    endif\n"
      "    if n > 99999 then\n      going = 0\n    endif\n"
      "  endloop\nend\n@press\n"
      "fish define write_curve\n"
      "  local status = file.open('{0}-pfc.csv', 1, 1)\n"
      "  status = file.write(rows, n)\n"
      "  status = file.close()\nend\n@write_curve\n",
      stem, print_number(s.packing->width), print_number(s.packing->height), t.platen_speed,
      // While the speed rises evenly its mean is half: hence twice the time for this strain.
      // 0 switches the rule off, and FISH has no word for infinity.
      2.0 * t.ramp_strain / rate, t.stop_at, t.post_peak > 0.0 ? t.post_peak : 1e9, t.max_strain,
      t.history_interval);
}

}  // namespace

void check_pfc_export(const Recipe& r, const std::string& where) {
  std::vector<Problem> problems;
  const auto refuse = [&](bool has, const char* key, const char* expected, const char* advice) {
    if (has) problems.push_back({where, key, "", expected, advice});
  };
  const MatrixRecipe& m = r.matrix;
  // All refusals at once, and before a packing is made.
  refuse(r.test.kind != TestKind(), "test.kind", "uniaxial",
         "`phyllite recipe FILE --pfc` has the parameters");
  refuse(m.model != MatrixModel::parallel_bond, "matrix.model", "parallel_bond",
         "`phyllite recipe FILE --pfc` has commands for flat joints");
  refuse(m.directional(), "matrix.foliation", "a matrix without directions",
         "`phyllite recipe FILE --pfc` has commands for them");
  refuse(std::any_of(r.bedding.begin(), r.bedding.end(),
                     [](const BeddingRecipe& b) { return b.layer_thickness > 0.0; }),
         "bedding.layer_thickness", "no layers with a matrix of their own", "leave it out");
  refuse(r.packing.initial_stress == InitialStress::isotropic, "packing.initial_stress", "stress_free",
         "the files declare present overlaps stress-free");
  refuse(r.test.pre_strain > 0.0, "test.pre_strain", "0", "the platens begin at rest");
  refuse(r.test.approach_strain > 0.0, "test.approach_strain", "0", "the platens keep one speed");
  refuse(m.unbreakable, "matrix.unbreakable", "false", "PFC's bonds break");
  if (!problems.empty()) throw InputError(problems);
}

PfcFiles pfc_specimen(const Recipe& recipe, const Specimen& s, const std::string& stem) {
  return {head(recipe, s) + bodies_text(recipe, s) + "; --- matrix   [D] contact property, contact method\n" +
              pfc_matrix_properties(recipe.matrix) + contact_functions + bonds_text(s) + joints_text(s) +
              counts_text(s),
          head(recipe, s) + test_text(recipe, s, stem)};
}

}  // namespace phy::report
