#include "records/result.hpp"

#include <algorithm>

#include "base/hash.hpp"

namespace phy {

namespace {

using Columns = std::vector<HistoryColumn>;
using Row = HistoryRow;

const Columns clock_columns = {{"step", "1", "cycle number", &Row::step},
                               {"time", "s", "simulated time", &Row::time}};

const Columns gauge_columns = {
    {"axial_strain_gauge", "1", "least-squares strain of the middle 60 % along the load",
     &Row::axial_strain_gauge},
    {"lateral_strain_gauge", "1",
     "least-squares strain of the middle 60 % across the load, shortening positive",
     &Row::lateral_strain_gauge}};

const Columns common_columns = {
    {"n_cracks", "1", "broken bonds and joints so far", &Row::n_cracks},
    {"boundary_work", "J/m", "work done by the platens", &Row::boundary_work},
    {"kinetic", "J/m", "kinetic energy", &Row::kinetic},
    {"strain_linear", "J/m", "strain energy of linear contacts", &Row::strain_linear},
    {"strain_bond", "J/m", "strain energy of parallel bonds", &Row::strain_bond},
    {"strain_joint", "J/m", "strain energy of smooth joints", &Row::strain_joint},
    {"strain_wall", "J/m", "strain energy of platen contacts", &Row::strain_wall},
    {"slip", "J/m", "energy dissipated by slip so far", &Row::slip},
    {"damping", "J/m", "energy dissipated by local damping so far", &Row::damping},
    {"released", "J/m", "strain energy of bonds at breakage so far", &Row::released},
    {"energy_error", "1", "work not accounted for / boundary work", &Row::energy_error},
    {"unbalanced", "1", "mean unbalanced force / mean contact force", &Row::unbalanced}};

Columns joined(std::initializer_list<Columns> parts) {
  Columns all;
  for (const Columns& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

Columns press_columns() {
  return joined(
      {clock_columns,
       {{"axial_strain", "1", "shortening between the platens / initial height", &Row::axial_strain}},
       gauge_columns,
       {{"axial_stress", "Pa", "mean platen force / initial width", &Row::axial_stress},
        {"stress_top", "Pa", "top platen force / initial width", &Row::stress_top},
        {"stress_bottom", "Pa", "bottom platen force / initial width", &Row::stress_bottom}},
       common_columns});
}

Columns tension_columns() {
  return joined(
      {clock_columns,
       {{"axial_strain", "1", "approach of the grips / free length between them: negative",
         &Row::axial_strain}},
       gauge_columns,
       {{"axial_stress", "Pa", "mean grip force / initial width, tension negative", &Row::axial_stress},
        {"grip_stress_top", "Pa", "top grip force / initial width", &Row::stress_top},
        {"grip_stress_bottom", "Pa", "bottom grip force / initial width", &Row::stress_bottom}},
       common_columns});
}

Columns disc_columns() {
  return joined({clock_columns,
                 {{"axial_strain", "1", "approach of the platens / diameter", &Row::axial_strain}},
                 gauge_columns,
                 {{"centre_tension", "Pa", "2P/(pi D t) times Hondros' factor, P mean platen force",
                   &Row::axial_stress},
                  {"centre_tension_top", "Pa", "the same from the top platen", &Row::stress_top},
                  {"centre_tension_bottom", "Pa", "the same from the bottom platen", &Row::stress_bottom}},
                 common_columns});
}

Columns confined_columns() {
  return joined(
      {clock_columns,
       {{"axial_strain", "1", "shortening between the platens since the confinement / initial height",
         &Row::axial_strain},
        {"lateral_strain", "1", "approach of the sides since the confinement / initial width",
         &Row::lateral_strain},
        {"volumetric_strain", "1", "axial + lateral strain", &Row::volumetric_strain}},
       gauge_columns,
       {{"axial_stress", "Pa", "mean platen force / initial width", &Row::axial_stress},
        {"stress_top", "Pa", "top platen force / initial width", &Row::stress_top},
        {"stress_bottom", "Pa", "bottom platen force / initial width", &Row::stress_bottom},
        {"lateral_stress", "Pa", "mean side force / initial height, or pressure of the jacket",
         &Row::lateral_stress},
        {"deviatoric_stress", "Pa", "axial - lateral stress", &Row::deviatoric_stress}},
       common_columns});
}

Columns shear_columns() {
  return joined(
      {clock_columns,
       {{"shear_displacement", "m", "of the upper box against the lower one", &Row::axial_strain},
        {"normal_closure", "m", "approach of the boxes; dilation is negative", &Row::lateral_strain},
        {"shear_stress", "Pa", "mean box force along the plane / width", &Row::axial_stress},
        {"shear_stress_upper", "Pa", "upper box force along the plane / width", &Row::stress_bottom},
        {"shear_stress_lower", "Pa", "lower box force along the plane / width", &Row::stress_top},
        {"normal_stress", "Pa", "mean box force across the plane / width", &Row::lateral_stress}},
       common_columns});
}

}  // namespace

const std::vector<HistoryColumn>& history_columns(TestKind kind) {
  static const Columns press = press_columns(), tension = tension_columns(), disc = disc_columns(),
                       confined = confined_columns(), shear = shear_columns();
  switch (kind) {
    case TestKind::uniaxial: return press;
    case TestKind::direct_tension: return tension;
    case TestKind::brazilian: return disc;
    case TestKind::biaxial: return confined;
    case TestKind::direct_shear: return shear;
  }
  return press;
}

const HistoryColumn& loading_column(TestKind kind) {
  const std::vector<HistoryColumn>& columns = history_columns(kind);
  return *std::find_if(columns.begin(), columns.end(),
                       [](const HistoryColumn& c) { return c.value == &Row::axial_strain; });
}

std::string heading(const HistoryColumn& column) {
  return std::string(column.name) + " [" + column.unit + "]";
}

const char* stress_name(TestKind kind) {
  switch (kind) {
    case TestKind::uniaxial: return "axial stress";
    case TestKind::direct_tension: return "tension";
    case TestKind::brazilian: return "tension at the centre of an elastic disc";
    case TestKind::biaxial: return "deviatoric stress";
    case TestKind::direct_shear: return "shear stress";
  }
  return "";
}

const char* to_string(TestKind kind) {
  switch (kind) {
    case TestKind::uniaxial: return "uniaxial";
    case TestKind::direct_tension: return "direct_tension";
    case TestKind::brazilian: return "brazilian";
    case TestKind::biaxial: return "biaxial";
    case TestKind::direct_shear: return "direct_shear";
  }
  return "unknown";
}

const char* to_string(Status status) {
  switch (status) {
    case Status::peaked: return "peaked";
    case Status::not_peaked: return "not peaked";
    case Status::not_settled: return "not settled";
    case Status::unstable: return "unstable";
    case Status::interrupted: return "interrupted";
    case Status::untrusted: return "untrusted";
  }
  return "unknown";
}

std::optional<Status> status_of(std::string_view name) {
  for (const Status s : all_statuses)
    if (name == to_string(s)) return s;
  return std::nullopt;
}

std::string hash_of(const TestResult& result) {
  Hash h;
  for (const HistoryRow& row : result.history.rows)
    for (const HistoryColumn& column : history_columns(result.history.kind)) h.add(row.*column.value);
  for (const CrackEvent& c : result.cracks) {
    h.add(c.step), h.add(c.a), h.add(c.b);
    h.add(static_cast<int>(c.mode)), h.add(static_cast<int>(c.place));
    for (const double v :
         {c.time, c.strain, c.position.x, c.position.y, c.normal.x, c.normal.y, c.size, c.energy})
      h.add(v);
  }
  // After a blow-up positions are no numbers, and which ones depends on the neighbours in the lanes.
  if (!result.snapshots.empty() && result.outcome.status != Status::unstable)
    for (const GrainState& g : result.snapshots.back().grains) h.add(g.ux), h.add(g.uy), h.add(g.rotation);
  return h.text();
}

}  // namespace phy
