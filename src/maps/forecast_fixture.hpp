// Forty tables to try the forecast on, written down before it was: twenty of rocks that a model is, twenty of
// rocks that no mapped model is. Specimens: three per angle with 5 % noise, of nu too.
#pragma once
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "maps/response_map.hpp"
#include "records/reading_fixture.hpp"

namespace phy::maps {

/// Noise-free values at the mapped angles; 0: not measured.
struct CleanTable {
  std::string of;
  std::array<double, 7> E, nu, ucs;  ///< [GPa], [-], [MPa]
  std::array<double, 3> bts;         ///< [MPa]
  bool bedded = true;
  bool nu_alone = false;  ///< only nu is impossible: "except", since nu puts nothing out of reach
};

/// Three specimens per cell, 5 % noise of each by itself.
inline std::vector<RockReading> noisy_readings(const CleanTable& table, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto normal = [&] {  // Box & Muller (1958): the same on every machine up to rounding
    const double u = (static_cast<double>(random()) + 1.0) / 4294967297.0,
                 v = static_cast<double>(random()) / 4294967296.0;
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::acos(-1.0) * v);
  };
  std::vector<RockReading> readings;
  const auto add = [&](Property p, double theta, double value) {
    for (int i = 0; i < 3 && value > 0.0; ++i)
      readings.push_back(reading(p, theta, value * (1.0 + 0.05 * normal())));
  };
  const std::size_t n = table.bedded ? 7 : 1;
  for (std::size_t i = 0; i < n; ++i) {
    add(Property::E, mapped_angles[i], 1e9 * table.E[i]);
    add(Property::nu, mapped_angles[i], table.nu[i]);
    add(Property::ucs, mapped_angles[i], 1e6 * table.ucs[i]);
  }
  for (std::size_t i = 0; i < (table.bedded ? 3U : 1U); ++i)
    add(Property::brazilian, mapped_disc_angles[i], 1e6 * table.bts[i]);
  return readings;
}

/// Rows of a map to make tables of: sensible, dense, with all answers; drawn by a seed.
inline std::vector<std::size_t> drawn_rows(const ResponseMap& table, std::size_t n, std::uint32_t seed) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.n_rows(); ++row) {
    bool whole = table.is_dense(row) && table.is_plausible(row);
    for (const double theta : mapped_disc_angles)
      whole = whole && std::isfinite(table.at(row, column_at(table.model(), "BTS/sigma_c", theta)));
    if (whole) rows.push_back(row);
  }
  std::mt19937 random(seed);
  for (std::size_t i = 0; i < n; ++i) std::swap(rows[i], rows[i + random() % (rows.size() - i)]);
  rows.resize(n);
  return rows;
}

/// E = 40 GPa, sigma_c = 40 MPa.
inline CleanTable table_of(const ResponseMap& map, std::size_t row) {
  CleanTable t;
  t.of = map.model().name + std::string(" ") + std::to_string(row);
  const auto at = [&](const char* stem, double theta) {
    return map.at(row, column_at(map.model(), stem, theta));
  };
  for (std::size_t i = 0; i < 7; ++i) {
    t.E[i] = 40.0 * at("E50/E_c", mapped_angles[i]), t.nu[i] = at("nu50", mapped_angles[i]);
    t.ucs[i] = 40.0 * at("UCS/sigma_c", mapped_angles[i]);
  }
  for (std::size_t i = 0; i < 3; ++i) t.bts[i] = 40.0 * at("BTS/sigma_c", mapped_disc_angles[i]);
  return t;
}

/// What is wrong with each stands first. Where nothing else is said, a usual layered rock: E from 20 to 40
/// GPa, UCS with its least at 45 to 60 degrees, tension a tenth of UCS and less across than along the load's
/// plane.
inline const std::vector<CleanTable>& outside_tables() {
  constexpr std::array<double, 7> usual_E = {20, 20.5, 22, 25, 30, 36, 40},
                                  same_E = {30, 30, 30, 30, 30, 30, 30},
                                  threefold_E = {15, 15.5, 17.5, 21, 28, 38, 45}, no_nu = {};
  constexpr std::array<double, 7> usual_ucs = {110, 98, 75, 58, 56, 75, 115},
                                  same_ucs = {100, 100, 100, 100, 100, 100, 100};
  constexpr std::array<double, 3> no_bts = {};
  static const std::vector<CleanTable> all = {
      {"UCS(0)/UCS(90) = 2.5, E ratio 3", threefold_E, no_nu, {125, 110, 85, 62, 50, 48, 50}, no_bts},
      {"UCS(0)/UCS(90) = 3.5, E ratio 2", usual_E, no_nu, {175, 160, 130, 100, 75, 58, 50}, no_bts},
      {"UCS(90)/UCS(0) = 4, E ratio 2", usual_E, no_nu, {40, 45, 60, 85, 115, 145, 160}, no_bts},
      {"UCS(90)/UCS(0) = 4, E the same", same_E, no_nu, {40, 45, 60, 85, 115, 145, 160}, no_bts},
      {"UCS/BTS = 25, otherwise alike at all angles", same_E, no_nu, same_ucs, {4, 4, 4}},
      {"UCS/BTS = 45 at 0 and 90", usual_E, no_nu, usual_ucs, {2.4, 2, 2.5}},
      {"UCS/BTS = 2 at 0 and 90", usual_E, no_nu, usual_ucs, {55, 50, 57}},
      {"weakest at 15 alone", usual_E, no_nu, {110, 35, 100, 105, 110, 112, 115}, no_bts},
      {"weakest at 75 alone", usual_E, no_nu, {110, 112, 108, 105, 100, 35, 110}, no_bts},
      {"W-shaped UCS", usual_E, no_nu, {110, 45, 85, 110, 85, 45, 110}, no_bts},
      {"UCS in zigzag", usual_E, no_nu, {120, 65, 120, 65, 120, 65, 120}, no_bts},
      {"strongest at 45", usual_E, no_nu, {55, 70, 100, 120, 100, 70, 55}, no_bts},
      {"stiffest at 45", {20, 24, 33, 40, 33, 24, 20}, no_nu, usual_ucs, no_bts},
      {"three times as stiff across as along", {45, 42, 35, 27, 20, 16, 15}, no_nu, usual_ucs, no_bts},
      {"E in zigzag", {25, 38, 25, 38, 25, 38, 25}, no_nu, usual_ucs, no_bts},
      {"nu falls with E", usual_E, {0.45, 0.42, 0.35, 0.27, 0.17, 0.09, 0.06}, usual_ucs, no_bts, true, true},
      {"nu impossible at 45 alone",
       usual_E,
       {0.13, 0.14, 0.2, 0.02, 0.3, 0.3, 0.26},
       usual_ucs,
       no_bts,
       true,
       true},
      {"UCS(45) a fortieth", usual_E, no_nu, {120, 100, 8, 3, 4, 20, 120}, no_bts},
      {"BTS(0)/BTS(90) = 10, otherwise alike", same_E, no_nu, same_ucs, {20, 8, 2}},
      {"without layers, UCS/BTS = 25", {40}, {0.25}, {100}, {4}, false}};
  return all;
}

}  // namespace phy::maps
