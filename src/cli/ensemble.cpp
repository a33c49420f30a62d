#include "cli/ensemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "base/check.hpp"
#include "base/quote.hpp"
#include "base/text_table.hpp"
#include "base/units.hpp"
#include "calibrate/discrepancy.hpp"
#include "cli/machine.hpp"
#include "cli/terminal.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "io/toml_in.hpp"
#include "jobs/ensemble.hpp"
#include "jobs/report.hpp"
#include "records/quality.hpp"
#include "records/test_description.hpp"
#include "report/words.hpp"
#include "study/band.hpp"
#include "study/experiment.hpp"
#include "study/table.hpp"

namespace phy::cli {
namespace {

namespace fs = std::filesystem;

/// A test of an ensemble.
struct Job {
  std::size_t draw = 0;
  double sigma_3 = nan;  ///< [Pa] of an envelope; NaN: the test is that of the recipe
  Recipe single;
  TestResult result = {};

  std::string name() const {
    return fmt::format("draw {}, {}{}", draw + 1, result.name,
                       std::isnan(sigma_3) ? "" : fmt::format(" at {:g} MPa", sigma_3 * 1e-6));
  }
};

/// Draw by draw, stress by stress, the specimens in the order of the recipe's.
std::vector<Job> jobs_of(const std::vector<Recipe>& draws, const std::vector<double>& confining) {
  std::vector<Job> jobs;
  for (std::size_t k = 0; k < draws.size(); ++k) {
    if (confining.empty())
      for (Recipe& single : study::single_recipes(draws[k])) jobs.push_back({k, nan, std::move(single)});
    // An envelope replaces the test by a biaxial one; without stresses the recipe's own test runs.
    for (const double sigma_3 : confining)
      for (Recipe& single : study::single_recipes(study::confined_recipe(draws[k], sigma_3)))
        jobs.push_back({k, sigma_3, std::move(single)});
  }
  return jobs;
}

/// Runs what the store does not hold yet. False: stopped by the user.
bool run_jobs(std::vector<Job>& jobs, const EnsembleArguments& args, const Session& session) {
  ProgressLine line;
  std::vector<Recipe> recipes;
  for (const Job& job : jobs) recipes.push_back(job.single);
  const auto simulator = calibrate::make_simulator(tests_in(args.out, args.with_untrusted, session, line));
  std::vector<TestResult> results;
  try {
    results = simulator->test(recipes);
    // No error for the user: the store holds what was finished, and the same command goes on.
  } catch (const calibrate::Stopped&) {
    line.finish();
    return false;
  }
  for (std::size_t i = 0; i < jobs.size(); ++i) jobs[i].result = std::move(results[i]);
  line.finish();
  return true;
}

/// The value of a laboratory's table that a number stands for; nothing: none that a calibration knows what it
/// misses of. Rock between the layers is none of its tests.
std::optional<Target> value_of(const Job& job, const Recipe& draw, const std::string& number) {
  const TestKind& kind = job.single.test.kind;
  // The discrepancy is known per property of a laboratory's table, not per number of a test.
  const auto property = property_of(kind->name, number);
  if (!property || (job.result.intact && layered(draw))) return {};
  Target value;
  value.property = *property;
  // Without bedding an angle means nothing, and a property along the bedding has none to choose.
  if (layered(draw) && !measured(*property).along_bedding) value.theta = job.result.theta;
  // Confinement is part of the place in the table: the model may miss more where the rock is confined.
  if (kind->kept_stress.value != nullptr) value.confining = job.single.test.*kind->kept_stress.value;
  return value;
}

/// What a draw misses of its own numbers.
void add_missed(study::Predictions& numbers, const Job& job, const Recipe& draw,
                const calibrate::Discrepancy& discrepancy) {
  for (study::Prediction& p : numbers) {
    const auto value = value_of(job, draw, p.number);
    if (!value || !discrepancy.knows(value->property)) continue;
    const calibrate::Discrepancy::Term term = discrepancy.at(*value);
    // Each draw has its own misfit: draws that are too strong are corrected downwards, not all by the mean.
    p.missed = discrepancy.of_draw(term, job.draw), p.missed_sd = std::sqrt(term.variance);
  }
}

/// What predictions are made from.
struct Tested {
  const std::vector<Recipe>& draws;
  const std::vector<double>& confining;  ///< [Pa] of an envelope
  std::vector<Job> jobs;
  std::optional<calibrate::Discrepancy> discrepancy;
};

/// Of draw k, the fits of an envelope after the tests.
study::Predictions predictions_of(const Tested& tested, std::size_t k) {
  const std::vector<double>& confining = tested.confining;
  study::Predictions all;
  study::EnvelopeTests tests{confining, std::vector<std::vector<TestResult>>(confining.size())};
  const Recipe* rock = nullptr;
  for (const Job& job : tested.jobs) {
    if (job.draw != k) continue;
    study::Predictions numbers = study::predictions_of(job.result, job.sigma_3);
    if (tested.discrepancy) add_missed(numbers, job, tested.draws[k], *tested.discrepancy);
    for (study::Prediction& p : numbers) all.push_back(std::move(p));
    // Equality of doubles is safe: each job carries a copy of one of these very stresses.
    const auto at = std::find(confining.begin(), confining.end(), job.sigma_3) - confining.begin();
    if (!confining.empty()) tests.results[static_cast<std::size_t>(at)].push_back(job.result);
    rock = &job.single;
  }
  if (!confining.empty() && rock != nullptr)
    for (study::Prediction& p : study::predictions_of(study::fit_envelope(tests, *rock)))
      all.push_back(std::move(p));
  return all;
}

/// A row per test: draw, packing, place, outcome and every number.
std::string tests_csv(const std::vector<Job>& jobs) {
  std::vector<std::string> heads;
  const auto head_of = [](const Number& n) { return n.name + " [" + n.unit + "]"; };
  // Tests of different outcome have different numbers: the table has a column for every one that occurs.
  for (const Job& job : jobs)
    for (const Number& n : job.result.numbers)
      if (std::find(heads.begin(), heads.end(), head_of(n)) == heads.end()) heads.push_back(head_of(n));
  std::string text = "draw,packing,specimen,theta [deg],sigma_3 [Pa],status,quality,result_hash";
  for (const std::string& head : heads) text += "," + head;
  text += "\n";
  for (const Job& job : jobs) {
    const TestResult& r = job.result;
    text += fmt::format("{},{},{},{},{},{},{},{}", job.draw + 1, job.single.packing.seed, csv_cell(r.name),
                        r.intact ? "" : print_number(r.theta), study::csv_cell(job.sigma_3),
                        to_string(r.outcome.status), to_string(grade_of(r)), r.hash);
    for (const std::string& head : heads) {
      const auto it = std::find_if(r.numbers.begin(), r.numbers.end(),
                                   [&](const Number& n) { return head_of(n) == head; });
      text += "," + (it == r.numbers.end() ? "" : study::csv_cell(it->value));
    }
    text += "\n";
  }
  return text;
}

/// The bands of one number, the model's and, where it is known what the model misses, the rock's; nothing
/// where no test has it. Is there one of the rock?
bool print_bands(const std::vector<study::Band>& all, const TableColumn& c, int width) {
  std::vector<study::Band> bands;
  // A table for every number.
  std::copy_if(all.begin(), all.end(), std::back_inserter(bands),
               [&](const study::Band& b) { return b.number == c.number; });
  if (bands.empty()) return false;
  using B = const study::Band&;
  const auto number = [](double value, double scale, int digits) {
    // A fit that failed in every draw leaves a band without ends.
    return std::isfinite(value) ? fmt::format("{:.{}f}", value * scale, digits) : "-";
  };
  const auto of = [&](const char* head, double study::Band::*value) {
    return column_of(head, c.unit, bands, [&](B b) { return number(b.*value, c.scale, c.digits); });
  };
  const Columns columns = {
      of(c.head, &study::Band::median), of("from", &study::Band::low), of("to", &study::Band::high),
      column_of("width", "%", bands, [&](B b) { return number(b.width(), 100.0, 0); }),
      column_of("without", "draws", bands, [](B b) { return fmt::format("{}", b.n_without); })};
  const bool rock = std::any_of(bands.begin(), bands.end(), [](B b) { return b.has_rock(); });
  std::vector<Columns> groups = {columns};
  if (rock)
    groups.push_back({column_of("rock/model", "", bands, [&](B b) { return number(b.factor, 1.0, 2); }),
                      column_of("+-", "%", bands, [&](B b) { return number(b.factor_sd, 100.0, 0); }),
                      of("rock", &study::Band::rock), of("from", &study::Band::rock_low),
                      of("to", &study::Band::rock_high)});
  // Fits of an envelope belong to all stresses together, and have no such column.
  if (std::any_of(bands.begin(), bands.end(), [](B b) { return std::isfinite(b.place.sigma_3); }))
    groups.front().insert(groups.front().begin(), column_of("sigma_3", "MPa", bands, [&](B b) {
                            return number(b.place.sigma_3, 1e-6, 1);
                          }));
  const Column label = column_of("theta", "deg", bands, [](B b) {
    return b.place.intact ? "intact" : fmt::format("{:g}", b.place.theta);
  });
  print_out("\n{}", text_table(label, groups, width));
  return rock;
}

/// What a table shows of a test: the number that it is made for, the modulus, and what is known of the rock.
std::vector<TableColumn> columns_of(const TestKind& kind, const std::vector<study::Band>& bands) {
  std::vector<TableColumn> columns;
  for (const TableColumn& c : kind->table) {
    const bool rock = std::any_of(bands.begin(), bands.end(),
                                  [&](const study::Band& b) { return b.number == c.number && b.has_rock(); });
    // Other columns stay in band.csv: a terminal has no room for a band of every number.
    if (rock || c.number == kind->curve.quantity().number || std::string(c.number) == "E_tangent")
      columns.push_back(c);
  }
  return columns;
}
const std::vector<TableColumn> columns_of_envelope = {{"sigma_1", "MPa", "sigma_1", 1e-6, 2},
                                                      {"c", "MPa", "cohesion", 1e-6, 2},
                                                      {"phi", "deg", "friction", 1.0, 2},
                                                      {"m_i", "", "m_i", 1.0, 2}};

/// Tests that are in no band: how many of each kind, and the first of them.
void print_left_out(const std::vector<Job>& jobs, int width) {
  // One line per kind of failure: twenty draws that fail alike would fill the screen.
  for (const Status status : all_statuses) {
    if (has_strength(status)) continue;
    const auto is = [&](const Job& job) { return job.result.outcome.status == status; };
    const auto first = std::find_if(jobs.begin(), jobs.end(), is);
    if (first == jobs.end()) continue;
    const Outcome& o = first->result.outcome;
    print_wrapped(width, 2, "left out, {}: {} of {} tests; {}: {}{}{}\n", to_string(status),
                  std::count_if(first, jobs.end(), is), jobs.size(), first->name(), o.reason,
                  o.advice.empty() ? "" : "; ", o.advice);
  }
}

void print_ensemble(const std::vector<Job>& jobs, const std::vector<study::Band>& bands, std::size_t n_draws,
                    bool envelope, int width) {
  bool rock = false, missing = false;
  for (const TableColumn& c :
       envelope ? columns_of_envelope : columns_of(jobs.front().single.test.kind, bands)) {
    rock = print_bands(bands, c, width) || rock;
    missing = missing || std::any_of(bands.begin(), bands.end(), [&](const study::Band& b) {
                return b.number == c.number && b.n_without > 0;
              });
  }
  print_wrapped(width, 2,
                "\nmedian, smallest and largest of the draws: {} of them hold one more with a probability of "
                "{:.1f} %, n of them with (n - 1)/(n + 1)\n",
                n_draws, 100.0 * study::band_probability(n_draws));
  print_wrapped(
      width, 2, "{}\n",
      rock ? "rock: the model times what it misses of the calibration's table (rock/model); its "
             "band has the same probability. Columns before it are the model alone"
           : "what the model misses of this test is not known: the calibration's table has no such "
             "strength, or calibration.json is not beside the recipe. The bands are the model alone");
  if (missing)
    print_wrapped(width, 2,
                  "where draws are \"without\", the band holds the others alone, and no probability: a "
                  "common reason may be why the number is missing\n");
  print_left_out(jobs, width);
}

/// The recipe of the command line; InputError for several.
std::string only_recipe(const std::vector<std::string>& recipes) {
  if (recipes.size() > 1)
    throw InputError(Problem{"command line", "recipe", fmt::format("{}", recipes[1]),
                             "one calibrated.toml with --ensemble",
                             "run them one by one, with an --out each"});
  return recipes.front();
}

}  // namespace

calibrate::SimulatorOptions tests_in(const std::string& folder, bool with_untrusted, const Session& session,
                                     ProgressLine& line) {
  calibrate::SimulatorOptions options;
  options.threads = n_threads(session), options.stop = stop_on_interrupt();
  options.with_untrusted = with_untrusted;
  // Kept in a store: hours of tests survive a stop.
  options.store = (fs::path(folder) / "runs.sqlite").string();
  options.on_progress = [&line](const calibrate::TestProgress& p) {
    line.show([&](double) {
      return fmt::format(
          "{}/{} tests{}", p.n_done, p.n_total,
          p.seconds_left > 0.0 ? ", about " + report::duration_text(p.seconds_left) + " left" : "");
    });
  };
  return options;
}

int tell_stopped(const std::string& folder, int width) {
  print_wrapped(width, 2, "stopped: what was finished is in {}; the same command goes on with it\n", folder);
  return 1;
}

int run_ensemble(const EnsembleArguments& args, const Session& session,
                 const std::vector<double>& confining) {
  const std::string path = only_recipe(args.recipes);
  const int width = session.terminal_width;
  const Recipe recipe = io::read_recipe(path);
  const std::vector<Recipe> draws = jobs::read_draws(path, recipe, "--ensemble");
  const std::string tests = (fs::path(args.out) / "ensemble.csv").string();
  const std::string band = (fs::path(args.out) / "band.csv").string();
  // Both keep a runs.sqlite: mixed, --resume of the calibration would find tests that are not its own.
  if (jobs::holds_calibration(args.out))
    throw InputError(Problem{"command line", "--out", args.out, "",
                             "it holds a calibration, and tests of an ensemble have a folder of their own. "
                             "Choose another --out"});
  io::check_outputs({tests, band});
  io::check_writable(args.out);
  Tested tested{draws, confining, jobs_of(draws, confining), jobs::read_discrepancy(path, draws.size())};
  std::vector<Job>& jobs = tested.jobs;
  print_wrapped(width, 10,
                "ensemble  {} draws beside {}, {} tests; of the file itself: [test] and [engine]\n",
                draws.size(), path, jobs.size());
  print_notes(recipe.notes, width);
  flush_out();
  if (!run_jobs(jobs, args, session)) return tell_stopped(args.out, width);
  std::vector<study::Predictions> predictions;
  for (std::size_t k = 0; k < draws.size(); ++k) predictions.push_back(predictions_of(tested, k));
  const std::vector<study::Band> bands = study::bands_of(predictions);
  io::write_output(tests, tests_csv(jobs));
  io::write_output(band, study::bands_csv(bands));
  print_ensemble(jobs, bands, draws.size(), !confining.empty(), width);
  print_wrapped(width, 2, "in {}: band.csv, ensemble.csv (every draw), runs.sqlite (every test)\n", args.out);
  return std::all_of(jobs.begin(), jobs.end(),
                     [](const Job& job) { return has_strength(job.result.outcome.status); })
             ? 0
             : 1;
}

}  // namespace phy::cli
