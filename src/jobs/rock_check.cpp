#include "jobs/rock_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "base/quote.hpp"
#include "base/text_table.hpp"
#include "jobs/check_summary.hpp"
#include "maps/candidates.hpp"
#include "maps/forecast.hpp"
#include "maps/placing.hpp"
#include "report/calibration_tables.hpp"
#include "report/words.hpp"
#include "survey/cells.hpp"
#include "survey/closed_forms.hpp"
#include "survey/doubts.hpp"
#include "survey/identifiability.hpp"

namespace phy::jobs {
namespace {

constexpr std::ptrdiff_t most_notes = 2;

}  // namespace

RockCheck check(const Rock& read) {
  RockCheck found{Evidence(maps::with_model(read, read.layers, read.matrix)), Evidence(read), {}, {}, {}, {}, {}, {}, {}};
  const Evidence& evidence = found.evidence;
  found.doubts = survey::doubts_about(evidence);
  found.statements = survey::closed_forms(evidence);
  const std::vector<Estimate> expected = survey::identifiability(evidence);
  found.parameters = {expected.begin(), expected.end()};
  found.limits = survey::limits_of_table(evidence);
  // models are compared and the verdict is forecast for the rock as its file leaves it open
  const std::vector<Rock> models = maps::candidates_of(found.as_read);
  if (models.size() > 1)
    found.models.push_back(fmt::format("parameters as of {}; calibrate chooses between {}",
                                       maps::model_in_words(models.front()), maps::models_in_words(models)));
  if (const auto share = maps::assumed_share(read, models)) found.models.push_back(report::sentence(*share));
  found.in_maps = report::sentences(survey::cells_in(read, maps::place_in_maps(evidence)));
  if (const auto forecast = maps::forecast_of(found.as_read))
    found.forecast = survey::cells_in(read, maps::findings_of(*forecast));
  return found;
}

std::string rock_check(const Rock& read, const std::string& path, int width, int threads, bool all) {
  const RockCheck found = check(read);
  const Rock& rock = found.evidence.rock;
  std::string text = wrapped(fmt::format("{} ({})\n", rock.name, path), width, 2);
  const auto items = [&](const std::vector<std::string>& lines, const char* mark) {
    for (const std::string& line : lines) text += wrapped(mark + line + "\n", width, 2);
  };
  items({rock.notes.begin(), rock.notes.begin() + std::min(most_notes, std::ssize(rock.notes))}, "");
  items(report::sentences(summary_of(found, threads)), "");
  if (!all) return text + "Details: phyllite rock check " + sh_word(path) + " --all\n";
  text += "\n" + report::target_table(found.evidence.targets, width) + "\n";
  if (std::ssize(rock.notes) > most_notes) items({rock.notes.begin() + most_notes, rock.notes.end()}, "- ");
  if (found.doubts.size() > most_doubts)
    items(report::sentences({found.doubts.begin() + most_doubts, found.doubts.end()}), "- ");
  items(report::sentences(found.statements), "- ");
  text += "\n" + report::identifiability_table(found.parameters, width);
  items(found.models, "- ");
  items(report::sentences(found.limits), "- ");
  items(found.in_maps, "- ");
  if (found.forecast.size() > 1)
    items(report::sentences({found.forecast.begin() + 1, found.forecast.end()}), "- ");
  return text;
}

}  // namespace phy::jobs
