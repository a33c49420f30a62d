#include "calibrate/elastic_verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/lines.hpp"
#include "calibrate/margin.hpp"
#include "report/words.hpp"
#include "survey/elastic_limits.hpp"

namespace phy::calibrate {
namespace {

constexpr double near_edge = 0.01;  // of a logarithm

void report_edges(ElasticVerdict& verdict, const std::vector<Estimate>& parameters) {
  for (const Estimate& e : parameters)
    if (std::log(e.value / e.box_low) < near_edge || std::log(e.box_high / e.value) < near_edge)
      verdict.findings.push_back(fmt::format("{} lies at the edge of its box ({:.4g})", e.symbol, e.value));
}

/// Why: what the table asks of any body of its kind; what nu had to give for E.
void report_limit(ElasticVerdict& verdict, const ElasticFit& fit, const Evidence& evidence, bool softened,
                  bool nu_missed) {
  if (evidence.rock.bedded)
    for (const std::string& limit : report::sentences(survey::elastic_limits(evidence.moduli)))
      verdict.findings.push_back(
          !softened
              ? limit
              : fmt::format("the moduli at small strain that the readings (E_is = \"{}\") stand for: {}",
                            to_string(evidence.rock.E_is), limit));
  if (fit.nu_gave_way && nu_missed)
    verdict.findings.push_back(
        fmt::format("nu gave way to E: with full weight on both, E missed the table by up to {:.1f} %",
                    100.0 * fit.E_before));
}

}  // namespace

ElasticVerdict judge_elastic(const ElasticFit& fit, const Evidence& evidence, bool softened) {
  ElasticVerdict verdict;
  report_edges(verdict, fit.parameters);
  double worst = 0.0;
  bool nu_missed = false;
  for (const Comparison& c : fit.comparisons) {
    const Target& t = c.target;
    if (!c.answered()) {
      verdict.out_of_reach = true;
      add_line(verdict.findings, cell_name(t),
               "the model has no answer (`phyllite elastic` with calibrated.toml tells why)");
    } else if (misses(c) && t.property == Property::E) {
      worst = std::max(worst, std::fabs(c.error()));
      verdict.findings.push_back(fmt::format("{} = {:.2f} GPa, {:+.1f} % from the laboratory's {:.2f}",
                                             cell_name(t), c.mean * 1e-9, 100.0 * c.error(), t.mean * 1e-9));
    } else if (misses(c)) {
      nu_missed = true;
      verdict.findings.push_back(fmt::format("{} = {:.3f} instead of {:.3f}", cell_name(t), c.mean, t.mean));
    }
  }
  if (worst > 0.0 || nu_missed) report_limit(verdict, fit, evidence, softened, nu_missed);
  verdict.out_of_reach = verdict.out_of_reach || worst > modulus_limit;
  return verdict;
}

}  // namespace phy::calibrate
