#include "cli/study_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "cli/machine.hpp"
#include "cli/provenance.hpp"
#include "cli/terminal.hpp"
#include "genesis/cache.hpp"
#include "jobs/study_folder.hpp"
#include "report/words.hpp"
#include "study/expected.hpp"
#include "study/study_in.hpp"

namespace phy::cli {
namespace {

/// CPU seconds per cost: of finished tests, else the usual value.
double seconds_per_cost(const study::Plan& plan, const study::StudyRows& rows) {
  double seconds = 0.0, cost = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i]) seconds += rows[i]->result.seconds, cost += plan.tests[i].cost;
  // What has run on this machine says more of its speed than any table.
  return cost > 0.0 ? seconds / cost : study::usual_seconds_per_cost(plan.study.base.engine.precision);
}

std::size_t n_packings_to_make(const study::Plan& plan) {
  std::set<std::string> keys;  // batches may share a packing
  for (const study::Batch& b : plan.batches) {
    if (b.tests.empty()) continue;
    const Recipe& r = plan.tests[b.tests.front()].recipe;
    // Imported discs are read, not made.
    if (r.packing.file.empty() && !genesis::is_cached(r, genesis::default_cache_folder()))
      keys.insert(genesis::packing_key(r.specimen, r.packing, r.matrix));
  }
  return keys.size();
}

}  // namespace

void print_plan(const study::Plan& plan, const study::StudyRows& rows, const Session& session) {
  std::size_t mine = 0, left = 0;
  double cost = 0.0;
  for (const study::Batch& b : plan.batches)
    for (const std::size_t t : b.tests) {
      // Batches are those of this part; the plan lists the tests of all parts.
      ++mine;
      if (!rows[t]) ++left, cost += plan.tests[t].cost;
    }
  const study::Study& s = plan.study;
  const int threads = n_threads(session), width = session.terminal_width;
  print_wrapped(width, 10, "study     {} ({}), {} parameter(s)\n", s.name, study::to_string(s.design),
                s.vary.size());
  print_notes(s.base.notes, width);
  tell_versions(rows, width);
  print_wrapped(width, 10,
                "          {} points x {} packing(s) x {} bond seed(s) = {} specimens, {} of them distinct\n",
                plan.points.size(), s.packings.size(), s.bond_seeds.size(), plan.runs.size(),
                plan.tests.size());
  if (mine < plan.tests.size()) print_wrapped(width, 10, "shard     {} of them are this part's\n", mine);
  if (s.solver == study::Solver::direct)
    print_wrapped(width, 10, "solver    direct elastic solution, no time steps\n");
  else {
    // One speed for all would be wrong to print where the study sets it by angle.
    const bool has_speeds = std::any_of(s.by_angle.begin(), s.by_angle.end(), [](const study::ByAngle& b) {
      return b.key.path() == "test.platen_speed";
    });
    print_wrapped(
        width, 10, "press     {}, {} precision, affine pre-strain {}\n",
        has_speeds ? "each angle at its own speed" : speed_words(s.base.test),
        s.base.engine.precision == Precision::double_precision ? "double" : "single",
        s.base.test.pre_strain > 0.0 ? fmt::format("to strain {:g}", s.base.test.pre_strain) : "off");
    for (const std::string& line : study::by_angle_lines(s)) print_wrapped(width, 10, "by angle  {}\n", line);
  }
  if (left == 0) return;
  const std::size_t to_make = n_packings_to_make(plan);
  print_wrapped(width, 10, "expected  {} to run, about {} on {} thread(s){}\n", left,
                report::duration_text(cost * seconds_per_cost(plan, rows) / threads), threads,
                to_make > 0 ? fmt::format(", and {} packing(s) to make", to_make) : "");
}

std::size_t print_failures(const study::Plan& plan, const study::StudyRows& rows, int width) {
  std::size_t n = 0;
  for (std::size_t t = 0; t < rows.size(); ++t) {
    if (!rows[t] || has_answer(rows[t]->result.outcome.status)) continue;
    if (n++ == 0)
      print_out("\nwithout {}:\n", plan.study.solver == study::Solver::direct
                                       ? "an elastic solution"
                                       : "a peak, or not to be trusted");
    // Several runs may share a test; the first names a point that the user knows.
    const auto run =
        std::find_if(plan.runs.begin(), plan.runs.end(), [&](const study::Run& r) { return r.test == t; });
    const Outcome& o = rows[t]->result.outcome;
    print_wrapped(width, 4, "  {}, packing {}, {}: {}: {}{}{}\n", rows[t]->result.name, run->packing,
                  study::describe(plan.study, plan.points[run->point]), to_string(o.status), o.reason,
                  o.advice.empty() ? "" : "; ", o.advice);
  }
  return n;
}

std::size_t n_unfinished(const study::Plan& plan, const study::StudyRows& rows) {
  std::size_t n = 0;
  for (const study::Batch& b : plan.batches)
    for (const std::size_t t : b.tests) n += rows[t] ? 0 : 1;
  return n;
}

std::string lanes_text(const study::LaneUse& use) {
  // Everything came from the store: a share of nothing.
  if (!(use.contact_steps > 0.0)) return "";
  const std::string full =
      use.alone() < 1.0 ? fmt::format("lanes of tests side by side {:.0f} % full, ", 100.0 * use.occupancy())
                        : "";
  const std::string alone =
      use.alone() > 0.0 ? fmt::format("{:.0f} % of the cycles one test alone, ", 100.0 * use.alone()) : "";
  return fmt::format("{}{}{:.1f} ns per contact, cycle and test", full, alone, 1e9 * use.seconds_per_step());
}

}  // namespace phy::cli
