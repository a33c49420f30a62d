#include "records/quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/nan.hpp"

namespace phy {

const char* to_string(Grade grade) {
  switch (grade) {
    case Grade::unknown: return "not assessed";
    case Grade::good: return "good";
    case Grade::warning: return "warning";
    case Grade::untrusted: return "untrusted";
    case Grade::none: return "no result";
  }
  return "";
}

namespace {

// Cracks that open widen a specimen. Its strength is none the worse for it, nu is.
const std::vector<std::string> poisson = {"nu", "nu_platen"};
constexpr const char* elastic_instead = "`phyllite elastic` gives E and nu of the rock before it cracks";

}  // namespace

const std::vector<QualityLimit>& quality_limits() {
  static const std::vector<QualityLimit> limits = {
      // The density of a rock is a choice; overlaps that nature could not make are none
      // (docs/reliability.md).
      {"porosity", "1 - area of all discs / area of the box, before a disc is cut from it", true, 0.05, 0.0,
       "the discs lie on top of each other",
       "put fewer discs into the box (packing.n_grains, packing.porosity or the imported file)"},
      {"overlap", "largest overlap at the start / smaller radius", false, 0.5, 1.0,
       "grains are pushed into each other at the start",
       "put fewer discs into the box (packing.n_grains, packing.porosity), or move imported ones apart"},
      {"rattlers", "share of grains outside the load-bearing network", false, 0.1, 0.25,
       "this share of the grains can carry nothing",
       "put more discs into the box (packing.n_grains, packing.porosity or the imported file)"},
      {"grains_across", "smaller side / mean grain diameter", true, 10.0, 5.0,
       "too few grains across the specimen to be a rock",
       "lower the radii of [packing], or widen the specimen"},
      {"grains_in_radius", "radius of an opening / mean grain diameter", true, 15.0, -1.0,
       "too few grains around the opening for its hoop stress to be the rock's",
       "lower the radii of [packing], or widen the opening and its block"},
      {"wall_to_edge", "share of the wall of an opening whose loose rock reaches the edge of the block",
       false, 0.0, 1.0, "rock has slid out to the edge of the block, and the collapse may be the block's",
       "widen the block"},
      {"joints", "fewest smooth joints of a bedding set", true, 3.0, 1.0,
       "hardly any contact lies on a plane of the bedding",
       "raise bedding.zone_thickness (zone rule), lower bedding.spacing, move bedding.offset, or raise "
       "bedding.persistence; of the oriented rule raise "
       "bedding.orientation_range"},
      {"grains_per_spacing", "spacing / mean grain diameter", true, 3.0, 1.0,
       "too few grains between two bedding planes", "lower the radii of [packing], or raise bedding.spacing"},
      // At 0.01 E of small strain is 40 % lower; from 0.1 on it is that of loose grains
      // (docs/reliability.md).
      {"broken_at_start",
       "share of the matrix bonds that the confining, normal or far-field stress breaks before loading",
       false, 0.01, 0.1,
       "the confining, normal or far-field stress broke this share of the bonds before the test",
       "lower this stress, or raise the strengths of [matrix] and [[bedding]]"},
      {"slow_share",
       "part of the way to the peak, in strain, behind a fast approach (`test.approach_strain`)", true, 0.2,
       -1.0, "the peak lies within the fast approach, or close behind it", "lower test.approach_strain"},
      // Below 50 the error of UCS exceeds the scatter of single tests, below 10 it is a third and more
      // (docs/reliability.md).
      {"wave_transits", "crossings of a wave within the rise to the peak", true, 50.0, 10.0,
       "stress waves have little time to even out", "lower test.platen_speed"},
      {"peak_confirmed", "fall of stress behind the peak / 20 %, or strain behind it / 50 %, the larger",
       true, 1.0, 0.5, "the test ended before it showed that the largest stress is the peak",
       "raise test.max_strain where the test came that far; else lower test.stop_at to 0.8 or less, or raise "
       "test.post_peak to 0.5 or more"},
      {"fall_seen",
       "fall behind the first peak / the fall that ends the test (`test.stop_at`), in compression", true, 1.0,
       -1.0, "the test ended before the stress fell as far as its recipe asks: a higher peak may follow",
       "raise test.max_strain"},
      {"rows_to_peak", "rows of the history up to the peak or knee", true, 20.0, 5.0,
       "too few rows of the history see the way to the peak",
       "lower test.platen_speed, or, of a test that is slow already, test.history_interval"},
      {"platen_difference_95",
       "difference of the opposite platens, grips or boxes / strength, of 95 % of the rows", false, 0.03, 0.1,
       "opposite platens, grips, jaws or rollers carry different forces, inertia takes the difference",
       "lower test.platen_speed, or raise engine.damping if it is below 0.7"},
      {"kinetic_ratio", "largest kinetic / stored energy from 20 % of the strength on", false, 0.01, 0.1,
       "the specimen is in motion, not in equilibrium",
       "lower test.platen_speed, or raise engine.damping if it is below 0.7"},
      // Up to 0.1 the peak of bonded rock is within 3 %, from 0.3 on it is off by 7 % and more.
      {"sigma_n_error_rms",
       "deviation of the normal stress from the load asked for up to the peak, root mean square", false, 0.1,
       0.3, "the normal stress is not held while the box is sheared", "lower test.platen_speed"},
      {"sigma_n_error_residual",
       "the same over the last quarter",
       false,
       0.1,
       0.3,
       "the normal stress is not held where these are read",
       "lower test.platen_speed",
       {"tau_residual", "mu_residual"}},
      {"box_lifted",
       "share of rows behind the peak below 5 % of the normal load",
       false,
       0.0,
       0.05,
       "the boxes lose touch, nothing is sheared then",
       "lower test.platen_speed, or raise test.normal_stress",
       {"tau_residual", "mu_residual", "dilation"}},
      {"area_change", "1 - nu, in the range that nu is read in", true, 0.1, 0.0,
       "the area of the specimen hardly shrinks under the load, or grows: cracks open", elastic_instead,
       poisson},
      // Where nu changes within its own range, there is no one nu to give.
      {"nu_spread", "half the difference of nu between the halves of that range", false, 0.05, 0.2,
       "nu differs by twice as much between the halves of the range that it is read in", elastic_instead,
       poisson},
      // Up to 0.1 E of two speeds differs by 7 %, above 0.3 by 78 %.
      {"cracks_in_window",
       "cracks in that range / cracks up to the strength, fewer than three counting as none",
       false,
       0.1,
       0.3,
       "this share of the cracks forms where E and nu are read",
       elastic_instead,
       {"E_tangent", "nu", "E_tangent_platen", "nu_platen"}},
      // Below 0.3 UCS is up to 36 % low with a small energy error: no other measure tells it.
      {"damping", "local damping coefficient, `engine.damping`", true, 0.3, -1.0,
       "waves of each crack load its neighbours, which mostly lowers the strength",
       "raise engine.damping to 0.7"},
      {"energy_error", "work not accounted for / boundary work", false, 0.01, 0.1,
       "energy appears or is lost",
       "raise engine.damping where it is below 0.7, else lower engine.step_safety"},
  };
  return limits;
}

bool QualityLimit::speaks_of(const std::string& name) const {
  return of.empty() || std::find(of.begin(), of.end(), name) != of.end();
}

std::string QualityMark::heading() const {
  if (limit->of.empty()) return to_string(grade);
  const std::string names = fmt::format("{}", fmt::join(limit->of, ", "));
  return grade == Grade::untrusted ? names + " not given" : "warning for " + names;
}

std::string QualityMark::name() const {
  return fmt::format("{} {} {:g}", limit->number, limit->least ? "below" : "above", bound());
}

std::string QualityMark::value_text() const {
  std::string text;  // as many digits as tell it from the bound: not "0.1, above 0.1"
  for (int digits = 2; digits <= 6; ++digits)
    if (text = fmt::format("{:.{}g}", value, digits); text != fmt::format("{:g}", bound())) break;
  return text;
}

std::string QualityMark::text() const {
  return fmt::format("{} {}, {} {:g}: {}", limit->number, value_text(), limit->least ? "below" : "above",
                     bound(), limit->says);
}

std::vector<QualityMark> quality_marks(const std::vector<Number>& numbers) {
  std::vector<QualityMark> marks;
  for (const QualityLimit& limit : quality_limits())
    for (const Number& n : numbers) {
      if (n.name != limit.number || !std::isfinite(n.value)) continue;
      const auto beyond = [&](double bound) { return limit.least ? n.value < bound : n.value > bound; };
      // A bound of -1 lies below every measure: such limits warn and never end a test.
      if (beyond(limit.warning))
        marks.push_back({&limit, n.value, beyond(limit.untrusted) ? Grade::untrusted : Grade::warning});
    }
  const auto rank = [](const QualityMark& m) {
    return m.ends_test() ? 2 : m.grade == Grade::untrusted ? 1 : 0;
  };
  // Stable: among equals the order of the list, in which causes stand before what follows from them.
  std::stable_sort(marks.begin(), marks.end(),
                   [&](const QualityMark& p, const QualityMark& q) { return rank(p) > rank(q); });
  return marks;
}

namespace {

bool is_assessed(const std::vector<Number>& numbers) {
  return std::any_of(numbers.begin(), numbers.end(),
                     // The porosity is measured of every test since there are measures: without it the result
                     // is older.
                     [](const Number& n) { return n.name == quality_limits().front().number; });
}

}  // namespace

Grade grade_of(const TestResult& result) {
  if (result.outcome.status == Status::untrusted) return Grade::untrusted;
  if (!has_answer(result.outcome.status)) return Grade::none;
  const std::vector<QualityMark> marks = quality_marks(result.numbers);
  if (std::any_of(marks.begin(), marks.end(), [](const QualityMark& m) { return m.ends_test(); }))
    return Grade::untrusted;
  if (!marks.empty()) return Grade::warning;
  return is_assessed(result.numbers) ? Grade::good : Grade::unknown;
}

void note_marks(std::vector<Number>& numbers) {
  for (const QualityMark& mark : quality_marks(numbers))
    for (Number& n : numbers) {
      if (mark.limit->of.empty() || !mark.limit->speaks_of(n.name)) continue;
      n.note += (n.note.empty() ? "" : "; ") + mark.text();
      // A number in a table outlives its note: one that is not trusted is not given at all.
      if (mark.grade == Grade::untrusted) n.value = nan;
    }
}

void QualityTally::add(const std::vector<Number>& numbers, const std::string& number) {
  std::vector<QualityMark> marks = quality_marks(numbers);
  // Cracks where E is read are no reason to doubt a strength.
  std::erase_if(marks, [&](const QualityMark& m) { return !number.empty() && !m.limit->speaks_of(number); });
  ++n_results;
  n_unknown += is_assessed(numbers) ? 0 : 1;
  n_marked += marks.empty() ? 0 : 1;
  for (const QualityMark& m : marks) ++measures[m.limit->number];
}

void QualityTally::add(const QualityTally& more) {
  n_results += more.n_results, n_marked += more.n_marked, n_unknown += more.n_unknown;
  for (const auto& [measure, n] : more.measures) measures[measure] += n;
}

std::string QualityTally::text() const {
  std::string text;
  const char* between = "";
  if (n_marked > 0) text += fmt::format("{} of {} tests carry a warning: ", n_marked, n_results);
  for (const auto& [measure, n] : measures)
    text += fmt::format("{}{} ({})", between, measure, n), between = ", ";
  if (n_unknown > 0)
    text += fmt::format("{}{} of {} tests are of an older version, which did not assess them",
                        n_marked > 0 ? "; " : "", n_unknown, n_results);
  return text;
}

}  // namespace phy
