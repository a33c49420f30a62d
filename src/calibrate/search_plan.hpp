// What a search of strengths does with its budget, before it begins: batches of points, on which grains, and
// the packings that they are dealt. Pure: it follows from numbers alone.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "calibrate/effort.hpp"
#include "calibrate/simulator.hpp"
#include "records/calibration.hpp"

namespace phy::calibrate {

/// Fewest points of the search; each costs one test per strength of the table, of which the budget counts
/// those in compression: tests in tension end at a fraction of the strain.
constexpr std::int64_t least_points = 8;
constexpr int verification_packings = 5;
constexpr std::size_t packings_per_round = 4;  ///< on which an estimate is tried

/// How a search passes from coarse grains to the recipe's own.
enum class Course : std::uint8_t {
  own,                   ///< the recipe's from the beginning
  coarse_then_own,       ///< then a batch over the draws on the recipe's
  coarse_then_estimate,  ///< then the estimate: half of the rounds
};
Course course_of(const Recipe& recipe, const std::vector<Target>& targets);

struct Batch {
  Grains grains;
  bool at_estimate;  ///< all at one point, on as many packings; else spread over the draws
  std::size_t n_points;
};

struct SearchPlan {
  std::vector<Batch> batches;
  std::size_t most_batches;    ///< with the rounds that may follow while the estimate has not settled
  Shortage shortage;           ///< of points, beside those of a usual search
  std::optional<Finding> cut;  ///< `search_cut`: of a search that was to be longer than usual
};
/// `n_ratios`: that are sought beside sigma_c; `n_compressive`: tests of a point that the budget counts.
SearchPlan plan_search(const Budget& budget, std::size_t n_ratios, std::int64_t n_compressive, Course course);

/// Deals the packings out. Neighbouring points of a spread batch share one: two points of seven angles fill
/// sixteen lanes. At one point every test has a packing of its own.
class PackingDealer {
 public:
  explicit PackingDealer(std::size_t n) : n_(n) {}
  /// Of each point, by place among the packings.
  std::vector<std::size_t> deal(const Batch& batch);
  /// Of how many the answers are.
  std::size_t dealt() const;

 private:
  std::size_t n_, next_ = 0;
};

}  // namespace phy::calibrate
