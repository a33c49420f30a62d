// How many tests a search of strengths may take: what each effort buys stands in docs/calibration.md,
// "Effort".
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace phy::calibrate {

struct Effort {
  std::string_view name;
  double points;          ///< of the search, in those of "normal"
  std::size_t further;    ///< rounds at an estimate that has not settled, at most
  bool foreseen = false;  ///< short, because no long search is expected to bring the rock within reach
};

/// What settled() makes of "auto" depends on the table.
inline constexpr std::array<Effort, 4> efforts = {
    {{"auto", 1.0, 6}, {"quick", 0.5, 0}, {"normal", 1.0, 6}, {"thorough", 2.0, 12}}};
inline constexpr Effort auto_effort = efforts[0], quick_effort = efforts[1], normal_effort = efforts[2];

/// What a search may cost.
struct Budget {
  std::int64_t max_tests;  ///< in compression
  Effort effort = normal_effort;
};

}  // namespace phy::calibrate
