// What is believed of the strength parameters once some tests have run.
//
// A strength is proportional to all micro-strengths together (moduli, geometry and friction kept):
// log(UCS/sigma_c) is a function of five ratios alone, one function per angle. A surrogate per test and angle
// (surrogate.hpp) learns it from runs of the press; sigma_c costs no run. A strength under confinement
// depends on that stress over sigma_c too, so its surrogate has sigma_c among its inputs. What is wanted is
// the posterior
//
//   log p = -1/2 sum_i [ (log lab_i - log sigma_c - f_i(z))^2 / v_i + log v_i ],
//   v_i = se_i^2 + var f_i(z) + d_p^2
//
// plus -1/2 ((log z_j - log usual_j)/sd_j)^2 of every ratio of which literature knows something, within the
// box of parameters.hpp: laboratory scatter and ignorance of the surrogate count alike, and a ratio that the
// data do not determine keeps its prior. d_p is what the best known rock misses
// beyond both, of each property by itself: zero where the table can be met; where it cannot, the posterior
// would otherwise flee to the rocks of which least is known, and a tension that cannot be met would take UCS
// along. What is missed is still wanted as near as it can be had: a property with a discrepancy adds
// -|log lab - log model|/se to log p, a pull that grows no further with the distance. One packing serves all
// angles: of var f_i what it does to every strength in compression is one error and not many, so that all of
// them together tell sigma_c less well (intervals; the search leaves it out). E and nu as a
// laboratory reads them join the sum as far as moduli cannot follow what strengths make of them
// (read_moduli.hpp).
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "calibrate/ensemble.hpp"
#include "calibrate/parameters.hpp"
#include "calibrate/read_moduli.hpp"
#include "calibrate/surrogate.hpp"

namespace phy::calibrate {

/// Points are vectors: log sigma_c, then the places of the ratios in their boxes.
class StrengthPosterior {
 public:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);  ///< target to leave out

  /// `recipe`: moduli of the rock. `read`: E and nu as the laboratory reads them, which are wanted beside the
  /// strengths; it outlives the posterior. nullptr: those of small strain, which strengths leave alone.
  StrengthPosterior(const Evidence& evidence, const Recipe& recipe, const ReadModuli* read = nullptr);

  const std::vector<Target>& targets() const { return targets_; }
  std::size_t n_targets() const { return targets_.size(); }
  /// sigma_c, then the ratios.
  const std::vector<const Parameter*>& parameters() const { return parameters_; }
  const LogBox& box(const Parameter& p) const { return boxes_[index_of(p)]; }
  /// Standard deviation of a coordinate of points before any data.
  double prior_spread(std::size_t coordinate) const;
  /// A point with the ratios of the middle of the box and a usual sigma_c.
  Point middle_of_box() const;
  static double log_sigma_c(const Point& x) { return x.front(); }
  static std::span<const double> ratios(const Point& x) { return std::span(x).subspan(1); }
  /// What the answer to a target depends on at a point: the ratios, and under confinement the place of
  /// sigma_c in its box, because only strengths over that stress are alike.
  std::vector<double> inputs(const Point& x, std::size_t target) const;
  /// Logarithm of what is sought of a parameter at a point.
  double log_value(const Point& x, const Parameter& p) const;
  Recipe recipe_at(Recipe recipe, const Point& x) const;
  /// The nearest point of the box.
  Point held(Point x) const;

  void add_run(std::size_t target, SurrogateRun run) { runs_[target].push_back(std::move(run)); }
  /// The rock has other moduli from here on: earlier runs move by what is expected of the change.
  void take_moduli(const Evidence& evidence, const Recipe& recipe);
  /// Targets with tests of their own that no run has answered.
  std::vector<Target> without_runs() const;
  /// From all runs so far; to be called before what follows.
  void learn();
  /// The mean over packings, as a laboratory takes that of its specimens: of strengths, not of logarithms.
  Surrogate::Value predict(const Point& x, std::size_t target) const;
  /// Places of the ratios, then that of sigma_c.
  std::vector<double> places(const Point& x) const;
  /// A value of the table against the model: of the targets, in their order, then of moduli as they are read.
  using Miss = ReadModuli::Miss;
  std::vector<Miss> misses(const Point& x) const;
  double log_density(const Point& x, std::size_t left_out) const;
  /// By walkers that begin at the likeliest of many points of the box: one that starts where nothing fits
  /// may not find out of there.
  /// `length`: of the chains; as many draws of longer ones are worth more.
  std::vector<Point> draws(std::size_t left_out, std::uint32_t seed, int length = 1) const;
  /// How well draws have mixed.
  static Mixing mixing_of(const std::vector<Point>& draws);
  /// The same from all targets, with the discrepancies that they ask for: what the best of the draws misses
  /// of a property beyond scatter and ignorance becomes part of its variances, and draws are made anew.
  std::vector<Point> draws_with_discrepancy(std::uint32_t seed, int length = 1);
  /// d^2.
  double discrepancy(Property property) const { return discrepancy_[static_cast<std::size_t>(property)]; }
  /// The search aims at the laboratory's means as if no error were above half of the tolerance: where all of
  /// many draws lie within the scatter of few specimens, hardly one lies near every mean. From here on errors
  /// count in full, as the intervals have to.
  void use_full_errors();

  /// Squared relative standard error of the laboratory, as of a normal distribution.
  static double variance(const Target& t);

 private:
  std::vector<std::vector<SurrogateRun>> runs_;  // per target
  std::vector<maps::PriorMean> prior_;
  std::vector<Surrogate> models_;
  std::vector<Target> targets_;
  std::vector<const Parameter*> parameters_;
  std::vector<LogBox> boxes_;  // of the parameters
  std::vector<double> least_;  // places of the ratios: -1, or what the recipe asks of them
  double middle_sigma_ = 0.0;  // logarithm
  std::array<double, n_properties> discrepancy_ = {};
  std::vector<double> variances_, log_means_;  // of the targets
  const ReadModuli* read_ = nullptr;
  bool errors_count_ = false;

  /// What counts of a laboratory's squared scatter.
  double counted(Property property, double squared) const;
  double scatter_of(std::size_t target) const {
    return counted(targets_[target].property, variances_[target]);
  }
  /// Of a model's variance, what all strengths in compression have in common because the same packings
  /// answered for them; none during the search, which asks where to look and not how much is known.
  double common_variance(std::size_t target, double variance) const;
  /// What a miss costs of a property that has a discrepancy, in units of log p.
  double pull(const Miss& miss) const;
  double log_prior(const Point& x) const;
  bool find_discrepancy(const std::vector<Point>& draws);  // false: as it was

  /// log of that mean over sigma_c. From places: they are the same for all targets.
  Surrogate::Value response(const std::vector<double>& places, std::size_t target) const;
  std::size_t index_of(const Parameter& p) const;
  bool inside(const Point& x) const;
  /// Of the places; without a stress on the sides strength is proportional to sigma_c, the last of them.
  std::size_t n_inputs(std::size_t target, const std::vector<double>& places) const {
    return places.size() - (targets_[target].confining == 0.0 ? 1 : 0);
  }
  std::vector<Point> spread_points(int n) const;
  double best_sigma(const Point& x, std::size_t left_out) const;
  double likeliest_sigma(Point x, std::size_t left_out) const;
};

/// `n` points far from each other: `first`, and draws.
std::vector<Point> spread_draws(const Point& first, const std::vector<Point>& draws, std::size_t n);

}  // namespace phy::calibrate
