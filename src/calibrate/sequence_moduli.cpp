#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/check.hpp"
#include "base/nan.hpp"
#include "base/option.hpp"
#include "base/stats.hpp"
#include "calibrate/elastic_response.hpp"
#include "calibrate/sequence.hpp"
#include "theory/eq1_fit.hpp"

namespace phy::calibrate {
namespace {

constexpr std::array k_factors = {0.25, 0.5, 1.0, 1.5, 2.0};  // on k: docs/paper.md, Fig. 4
constexpr int most_bases = 4;
constexpr double usual_slope = 1.5;   // K/k, for the first base only
constexpr double nu_settled = 0.005;  // of the logarithm of k_s/k_n

const Parameter& parameter(const Recipe& model, MacroNumber acts_on) {
  const std::vector<const Parameter*> list = elastic_parameters(model);
  const auto it =
      std::find_if(list.begin(), list.end(), [&](const auto* p) { return p->modulus->acts_on == acts_on; });
  PHY_CHECK(it != list.end(), "the model has the parameter");
  return **it;
}

theory::Eq1Fit eq1(const Evidence& evidence, const std::vector<theory::ModulusReading>& readings) {
  theory::Eq1Options options;
  options.reference =
      evidence.has(Property::E, 90.0) ? theory::Eq1Reference::measured_90 : theory::Eq1Reference::free;
  return theory::fit_eq1(readings, options);
}

/// Joints that add no compliance are infinitely stiff.
struct Macro {
  double E = 0.0, K_n_delta = infinity, K_s_delta = infinity;
  std::string refused;  ///< why Eq. 1 does not hold; empty: it does
};
double inverse(double compliance) { return compliance > 0.0 ? 1.0 / compliance : infinity; }
Macro macro_of(const Evidence& evidence, const std::vector<theory::ModulusReading>& readings) {
  const theory::Eq1Fit fit = eq1(evidence, readings);
  const double E = inverse(fit.e);
  return {std::isfinite(E) ? E : evidence.scales.modulus, inverse(fit.a), inverse(fit.b), fit.reason};
}

std::vector<theory::ModulusReading> readings_of(const Evidence& evidence) {
  std::vector<theory::ModulusReading> readings;
  for (const Target& t : of_property(least_confined(evidence.moduli), Property::E))
    readings.push_back({t.theta, t.mean});
  return readings;
}

/// nu along the layers, by the table; NaN without.
double nu_of(const Evidence& evidence, double E) {
  const std::vector<Target> all = of_property(least_confined(evidence.moduli), Property::nu);
  const auto at = [&](double from, double to) {
    return std::find_if(all.rbegin(), all.rend(),
                        [&](const Target& t) { return t.theta >= from && t.theta <= to; });
  };
  if (const auto along = evidence.rock.bedded ? at(80.0, 90.0) : all.rbegin(); along != all.rend())
    return along->mean;
  const auto across = at(0.0, 15.0);
  if (across == all.rend()) return std::nan("");
  for (const Target& t : of_property(evidence.moduli, Property::E))
    if (t.theta == across->theta && t.confining == across->confining) return across->mean * E / t.mean;
  return std::nan("");
}

/// The steps, each on what the one before has found.
class SequenceOfModuli {
 public:
  SequenceOfModuli(const Evidence& evidence, const std::vector<std::int64_t>& seeds, Simulator& simulator)
      : evidence_(evidence), seeds_(seeds), simulator_(simulator) {
    fit_.recipe = evidence.rock.model;
  }
  ElasticFit found() {
    const bool bedded = !fit_.recipe.bedding.empty();
    Macro rock;
    if (bedded)
      rock = macro_of(evidence_, readings_of(evidence_));
    else
      rock.E = evidence_.scales.modulus;
    if (!rock.refused.empty()) fit_.notes.push_back({FindingKind::eq1_refused, {}, {}, {rock.refused}});
    fit_matrix(rock.E);
    if (bedded) fit_joints(rock);
    fit_.comparisons = elastic_response(fit_.recipe, evidence_.moduli, seeds_, simulator_);
    return fit_;
  }

 private:
  const Evidence& evidence_;
  const std::vector<std::int64_t>& seeds_;
  Simulator& simulator_;
  ElasticFit fit_;

  double in_box(const Parameter& p, double value) const {
    const LogBox box = p.box(evidence_.scales);
    return std::clamp(value, std::exp(box.low), std::exp(box.high));
  }
  void take(const Parameter& p, double value, Support rests_on) {
    const LogBox box = p.box(evidence_.scales);
    p.set(fit_.recipe, value);
    Estimate e = sought(p);
    e.value = value, e.low = e.high = nan;
    e.box_low = std::exp(box.low), e.box_high = std::exp(box.high), e.rests_on = std::move(rests_on);
    fit_.parameters.push_back(e);
  }

  /// Mean E or nu of the packings without joints.
  double intact(const Recipe& recipe, Property property) {
    std::vector<Recipe> recipes;
    for (const std::int64_t seed : seeds_) recipes.push_back(single_at(recipe, 0.0, seed));
    for (Recipe& r : recipes) r.bedding.clear();
    std::vector<double> values;
    for (const ElasticResult& r : simulator_.elastic(recipes, Statics::one_sided))
      values.push_back(reading_of(r, property));
    return summarise(values).mean;
  }

  void fit_matrix(double E) {
    const Parameter& E_c = parameter(fit_.recipe, MacroNumber::E);
    const Parameter& q = parameter(fit_.recipe, MacroNumber::nu);
    const double nu = nu_of(evidence_, E);
    // nu before E: it does not depend on E_c, while E depends on k_s/k_n. So one turn of each is enough.
    E_c.set(fit_.recipe, E_c.get(fit_.recipe));  // contacts and bonds alike, as it is sought
    double ratio = q.get(fit_.recipe);
    if (std::isfinite(nu)) {
      LogBox x = q.box(evidence_.scales);
      while (x.high - x.low > nu_settled) {  // nu falls with k_s/k_n
        const double middle = 0.5 * (x.low + x.high);
        q.set(fit_.recipe, std::exp(middle));
        (intact(fit_.recipe, Property::nu) > nu ? x.low : x.high) = middle;
      }
      ratio = std::exp(0.5 * (x.low + x.high));
    }
    q.set(fit_.recipe, ratio);
    const double found = E_c.get(fit_.recipe) * E / intact(fit_.recipe, Property::E);
    take(E_c, in_box(E_c, found), {Basis::eq1, {LabTest{Property::E}}});
    if (std::isfinite(nu)) take(q, ratio, {Basis::tests, {at_angle(Property::nu, 90.0)}});
  }

  Macro macro_at(const Recipe& recipe) {
    const std::vector<Target> moduli = of_property(least_confined(evidence_.moduli), Property::E);
    std::vector<theory::ModulusReading> readings;
    for (const Comparison& c : elastic_response(recipe, moduli, seeds_, simulator_))
      readings.push_back({c.target.theta, c.mean});
    return macro_of(evidence_, readings);
  }

  LineFit line_about(const Parameter& p, double Macro::*K, double base) {
    std::vector<double> micro, macro;
    for (const double factor : k_factors) {
      Recipe recipe = fit_.recipe;
      p.set(recipe, factor * base);
      const double found = macro_at(recipe).*K / spacing();
      // Where Eq. 1 finds no compliance the planes are infinitely stiff, and that is no point of a line.
      if (std::isfinite(found)) micro.push_back(factor * base), macro.push_back(found);
    }
    return fit_line(micro, macro);
  }
  double spacing() const { return fit_.recipe.bedding.front().spacing; }

  /// One parameter by Eq. 2, regenerated.
  void fit_joint(const Parameter& p, double Macro::*K, const char* name, double K_delta) {
    const double wanted = K_delta / spacing();
    double k = p.get(fit_.recipe);
    LineFit line;
    for (int i = 0; i < most_bases; ++i) {
      const double base = k;
      line = line_about(p, K, base);
      if (!(line.slope > 0.0)) break;
      k = in_box(p, std::max(0.0, (wanted - line.intercept) / line.slope));
      if (k >= k_factors.front() * base && k <= k_factors.back() * base) break;
    }
    fit_.notes.push_back(
        {FindingKind::eq2_line,
         {},
         {{"slope", line.slope}, {"intercept", line.intercept}, {"R2", line.R2}, {"wanted", wanted}},
         {name}});
    take(p, k, {Basis::eq2, {LabTest{Property::E}}});
  }

  void fit_joints(const Macro& rock) {
    const Parameter& k_n = parameter(fit_.recipe, MacroNumber::K_n_delta);
    const Parameter& k_s = parameter(fit_.recipe, MacroNumber::K_s_delta);
    const double per_slope = 1.0 / (usual_slope * spacing());
    k_n.set(fit_.recipe, in_box(k_n, rock.K_n_delta * per_slope));
    k_s.set(fit_.recipe, in_box(k_s, rock.K_s_delta * per_slope));
    // Across the layers E has k_n alone, at an angle both: so k_n comes first.
    fit_joint(k_n, &Macro::K_n_delta, "n", rock.K_n_delta);
    fit_joint(k_s, &Macro::K_s_delta, "s", rock.K_s_delta);
  }
};

/// What Eq. 1 asks of a table before it can be tried; empty: nothing is missing.
std::string missing_for_eq1(const Evidence& evidence) {
  const theory::Eq1Fit fit = eq1(evidence, readings_of(evidence));
  const bool missing =
      fit.status == theory::Eq1Status::too_few_angles || fit.status == theory::Eq1Status::no_oblique_angle;
  return missing ? fit.reason : "";
}

}  // namespace

void check_sequence(const Evidence& evidence) {
  const Rock& rock = evidence.rock;
  std::vector<Problem> problems;
  const std::string sequence = option_set("method", "sequence");
  const auto add = [&](const char* key, std::string value, const std::string& expected, std::string remedy) {
    problems.push_back({rock.name, key, std::move(value), expected + " for " + sequence, std::move(remedy)});
  };
  const std::string leave_out = "leave " + option("method") + " out, or ",
                    otherwise = leave_out + "change the table";
  if (rock.bedded && rock.layers != LayerModel::planes && rock.layers != LayerModel::choose)
    add("layers", fmt::format("\"{}\"", to_string(rock.layers)), "\"planes\"",
        "Eq. 1 and Eq. 2 are of joints on whole planes: " + leave_out +
            "take whole planes (layers, or persistence of the recipe)");
  if (rock.matrix == MatrixModel::flat_joint)
    add("matrix", "\"flat_joint\"", "\"parallel_bond\"",
        "the paper's sequence is of parallel bonds: " + leave_out + "change matrix");
  if (!evidence.has(Property::E))
    add("table", "no E", "values of E", "it begins with them: " + otherwise);
  else if (const std::string missing = rock.bedded ? missing_for_eq1(evidence) : ""; !missing.empty())
    add("table", "E", "E(theta) that Eq. 1 can be fitted to,", missing + "; " + otherwise);
  if (!problems.empty()) throw InputError(problems);
}

ElasticFit moduli_by_sequence(const Evidence& evidence, const std::vector<std::int64_t>& seeds,
                              Simulator& simulator, const std::function<void(const Finding&)>& begins) {
  begins({FindingKind::course_moduli});
  return SequenceOfModuli(evidence, seeds, simulator).found();
}

}  // namespace phy::calibrate
