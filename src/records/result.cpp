#include "records/result.hpp"

namespace phy {

using Row = HistoryRow;

const HistoryColumns& clock_columns() {
  static const HistoryColumns columns = {{"step", "1", "cycle number", &Row::step},
                                         {"time", "s", "simulated time", &Row::time}};
  return columns;
}

const HistoryColumns& gauge_columns() {
  static const HistoryColumns columns = {
      // The middle 60 %: platens hold the ends, and their contacts add a compliance that is none of the rock.
      {"axial_strain_gauge", "1", "least-squares strain of the middle 60 % along the load",
       &Row::axial_strain_gauge},
      {"lateral_strain_gauge", "1",
       "least-squares strain of the middle 60 % across the load, shortening positive",
       &Row::lateral_strain_gauge}};
  return columns;
}

const HistoryColumns& balance_columns() {
  static const HistoryColumns columns = {
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
  return columns;
}

HistoryColumns joined(std::initializer_list<HistoryColumns> parts) {
  HistoryColumns all;
  for (const HistoryColumns& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::string heading(const HistoryColumn& column) {
  return std::string(column.name) + " [" + column.unit + "]";
}

const char* to_string(Status status) {
  switch (status) {
    case Status::peaked: return "peaked";
    case Status::not_peaked: return "not peaked";
    case Status::not_settled: return "not settled";
    case Status::unstable: return "unstable";
    case Status::interrupted: return "interrupted";
    case Status::untrusted: return "untrusted";
    case Status::solved: return "solved";
    case Status::unsolved: return "unsolved";
    case Status::knee: return "knee";
  }
  return "unknown";
}

std::optional<Status> status_of(std::string_view name) {
  for (const Status s : all_statuses)
    if (name == to_string(s)) return s;
  return std::nullopt;
}

std::vector<std::string> hashed_fields(std::initializer_list<const char*> of_the_test) {
  // A list of its own: a column that a table gets later must not change the hashes of all earlier results.
  std::vector<std::string> names = {"step", "time"};
  names.insert(names.end(), of_the_test.begin(), of_the_test.end());
  for (const char* balance :
       {"n_cracks", "boundary_work", "kinetic", "strain_linear", "strain_bond", "strain_joint", "strain_wall",
        "slip", "damping", "released", "energy_error", "unbalanced"})
    names.emplace_back(balance);
  return names;
}

}  // namespace phy
