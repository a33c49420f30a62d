#include "records/result.hpp"

#include "base/hash.hpp"

namespace phy {

const std::vector<HistoryColumn>& history_columns() {
  static const std::vector<HistoryColumn> columns = {
      {"step", "1", "cycle number", &HistoryRow::step},
      {"time", "s", "simulated time", &HistoryRow::time},
      {"axial_strain", "1", "shortening between the platens / initial height", &HistoryRow::axial_strain},
      {"axial_strain_gauge", "1", "least-squares strain of the middle 60 % along the load",
       &HistoryRow::axial_strain_gauge},
      {"lateral_strain_gauge", "1",
       "least-squares strain of the middle 60 % across the load, shortening positive",
       &HistoryRow::lateral_strain_gauge},
      {"axial_stress", "Pa", "mean platen force / initial width", &HistoryRow::axial_stress},
      {"stress_top", "Pa", "top platen force / initial width", &HistoryRow::stress_top},
      {"stress_bottom", "Pa", "bottom platen force / initial width", &HistoryRow::stress_bottom},
      {"n_cracks", "1", "broken bonds and joints so far", &HistoryRow::n_cracks},
      {"boundary_work", "J/m", "work done by the platens", &HistoryRow::boundary_work},
      {"kinetic", "J/m", "kinetic energy", &HistoryRow::kinetic},
      {"strain_linear", "J/m", "strain energy of linear contacts", &HistoryRow::strain_linear},
      {"strain_bond", "J/m", "strain energy of parallel bonds", &HistoryRow::strain_bond},
      {"strain_joint", "J/m", "strain energy of smooth joints", &HistoryRow::strain_joint},
      {"strain_wall", "J/m", "strain energy of platen contacts", &HistoryRow::strain_wall},
      {"slip", "J/m", "energy dissipated by slip so far", &HistoryRow::slip},
      {"damping", "J/m", "energy dissipated by local damping so far", &HistoryRow::damping},
      {"released", "J/m", "strain energy of bonds at breakage so far", &HistoryRow::released},
      {"energy_error", "1", "work not accounted for / boundary work", &HistoryRow::energy_error},
      {"unbalanced", "1", "mean unbalanced force / mean contact force", &HistoryRow::unbalanced},
  };
  return columns;
}

const char* to_string(Status status) {
  switch (status) {
    case Status::peaked: return "peaked";
    case Status::not_peaked: return "not peaked";
    case Status::not_settled: return "not settled";
    case Status::unstable: return "unstable";
    case Status::interrupted: return "interrupted";
  }
  return "unknown";
}

std::string hash_of(const TestResult& result) {
  Hash h;
  for (const HistoryRow& row : result.history.rows)
    for (const HistoryColumn& column : history_columns()) h.add(row.*column.value);
  for (const CrackEvent& c : result.cracks) {
    h.add(c.step), h.add(c.a), h.add(c.b);
    h.add(static_cast<int>(c.mode)), h.add(static_cast<int>(c.place));
    for (const double v :
         {c.time, c.strain, c.position.x, c.position.y, c.normal.x, c.normal.y, c.size, c.energy})
      h.add(v);
  }
  if (!result.snapshots.empty())
    for (const GrainState& g : result.snapshots.back().grains) h.add(g.ux), h.add(g.uy), h.add(g.rotation);
  return h.text();
}

}  // namespace phy
