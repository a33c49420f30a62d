#include "jobs/study_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/check.hpp"
#include "base/option.hpp"
#include "base/quote.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "jobs/another_recipe.hpp"
#include "jobs/run_folder.hpp"
#include "records/specimen_record.hpp"
#include "report/words.hpp"
#include "study/experiment.hpp"
#include "study/study_in.hpp"
#include "study/table.hpp"

namespace phy::jobs {

namespace fs = std::filesystem;

namespace {

std::string in(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

}  // namespace

std::string store_file(const std::string& folder, const study::Shard& shard) {
  return in(folder, shard.n == 1 ? "study.sqlite" : fmt::format("shard-{}-of-{}.sqlite", shard.i, shard.n));
}

study::Study study_in(const std::string& folder) {
  const std::string file = in(folder, "study.toml");
  if (!fs::exists(file))
    throw IoError(folder + ": is no folder of a study (no study.toml); name the --out of `phyllite study`");
  return study::read_study(file);
}

std::vector<std::string> shards_in(const std::string& folder) {
  std::vector<std::string> shards;
  for (const fs::path entry : io::list_folder(folder))
    // By name and not by the plan: shards of another division of the study have to be merged as well.
    if (entry.filename().string().starts_with("shard-") && entry.extension() == ".sqlite")
      shards.push_back(entry.string());
  return shards;
}

void check_effects(const std::string& folder) {
  io::check_outputs({in(folder, "responses.csv"), in(folder, "effects.csv")});
}

void check_tables(const std::string& folder, const std::string& word) {
  io::check_outputs({in(folder, "results.csv"), in(folder, "responses.csv"), in(folder, "effects.csv"),
                     in(folder, "report.html")},
                    word);
}

namespace {

/// The keys in which specimens that both studies have are loaded differently, without those of `reported`:
/// "test.platen_speed at theta = 45 deg", with how many more differ. Angles may be added.
std::vector<study::RecipeDifference> differences_by_angle(
    const study::Study& there, const study::Study& here,
    const std::vector<study::RecipeDifference>& reported) {
  struct OfKey {
    study::RecipeDifference first;
    std::string specimen;
    int n_others = 0;
  };
  std::vector<OfKey> keys;
  const std::vector<std::string> old = specimen_names(there.base), now = specimen_names(here.base);
  const std::vector<Recipe> as_old = study::specimens_of(there, there.base),
                            as_now = study::specimens_of(here, here.base);
  for (std::size_t i = 0; i < old.size(); ++i) {
    const auto k = static_cast<std::size_t>(std::find(now.begin(), now.end(), old[i]) - now.begin());
    // An angle that was dropped leaves its results in the store, unused.
    if (k == now.size()) continue;
    for (study::RecipeDifference& d : study::differences(as_old[i], as_now[k])) {
      // The base recipe is the cause then, and would be told again for every angle.
      if (std::any_of(reported.begin(), reported.end(), [&](const auto& t) { return t.key == d.key; }))
        continue;
      const auto known =
          std::find_if(keys.begin(), keys.end(), [&](const OfKey& o) { return o.first.key == d.key; });
      // One line per key: a speed set for seven angles would be seven lines.
      if (known != keys.end())
        ++known->n_others;
      else
        keys.push_back({std::move(d), old[i]});
    }
  }
  std::vector<study::RecipeDifference> all;
  for (OfKey& o : keys) {
    o.first.key += " at " + o.specimen;
    if (o.n_others > 0) o.first.other += fmt::format(" ({} more specimen(s) differ)", o.n_others);
    all.push_back(std::move(o.first));
  }
  return all;
}

}  // namespace

void refuse_other_study(const study::Study& study, const std::string& folder) {
  std::error_code none;
  if (!fs::exists(fs::path(folder) / "study.toml", none)) {
    if (std::optional<Problem> p = problem_of_page(folder, PageOf::study)) throw InputError(*std::move(p));
    return;
  }
  // The copy in the folder, not the file it came from, which may have been edited since.
  const study::Study there = study_in(folder);
  const std::string remedy =
      "the folder holds another study: use another " + option("out") + ", or remove the folder";
  std::vector<study::RecipeDifference> heads;
  if (there.name != study.name) heads.push_back({"name", there.name, study.name});
  if (there.solver != study.solver)
    heads.push_back({"solver", study::to_string(there.solver), study::to_string(study.solver)});
  // Ranges and points are not compared: a study may grow in its folder.
  std::vector<Problem> problems = problems_of(folder, heads, "as in the study file", remedy);
  const std::vector<study::RecipeDifference> bases = study::differences(there.base, study.base);
  for (Problem& p : problems_of(folder + "/recipe.toml", bases, "as in the base recipe", remedy))
    problems.push_back(std::move(p));
  for (Problem& p : problems_of(folder + "/study.toml", differences_by_angle(there, study, bases),
                                "as asked for now", remedy))
    problems.push_back(std::move(p));
  if (!problems.empty()) throw InputError(std::move(problems));
}

void refuse_unmerged(const std::string& folder) {
  std::error_code none;
  if (!fs::is_directory(folder, none)) return;
  const std::vector<std::string> parts = shards_in(folder);
  const std::string whole = store_file(folder, {});
  std::vector<std::string> known;
  // Results that are in both are safe; only those of parts alone would run again.
  if (!parts.empty() && fs::exists(whole)) known = study::Store(whole).keys();
  for (const std::string& part : parts) {
    const std::vector<std::string> keys = study::Store(part, study::Sharing::alone).keys();
    // Both lists of keys are sorted, as a store returns them.
    if (!std::includes(known.begin(), known.end(), keys.begin(), keys.end()))
      throw IoError(fmt::format("{}: holds results that {} has not; phyllite study merge {}", part, whole,
                                shell_word(folder)));
  }
}

void check_study_outputs(const StudyFiles& files, const std::string& folder, const study::Shard& shard) {
  std::vector<std::string> fresh;
  for (const auto& [name, content] : files)
    // A file that already says the same is no obstacle: a study is resumed by its first command, too.
    if (!io::holds(in(folder, name), content)) fresh.push_back(in(folder, name));
  io::check_outputs(fresh);
  // A part has no tables: curves of some points would look like those of all.
  if (shard.n == 1) check_tables(folder, files.empty() ? "" : "out");
}

std::unique_ptr<study::Store> begin_study(const StudyFiles& files, const std::string& folder,
                                          const study::Shard& shard) {
  io::check_writable(folder);
  // First: it may be somebody else's.
  auto store = std::make_unique<study::Store>(store_file(folder, shard),
                                              shard.n == 1 ? study::Sharing::shared : study::Sharing::alone);
  for (const auto& [name, content] : files) io::write_output(in(folder, name), content);
  return store;
}

void write_effects(const study::Plan& plan, const study::StudyRows& rows, const std::string& folder) {
  const std::vector<study::Response> all = study::all_responses(plan, rows);
  io::write_output(in(folder, "responses.csv"), study::responses_csv(plan, all));
  io::write_output(in(folder, "effects.csv"), study::effects_csv(plan, all));
}

void write_tables(const study::Plan& plan, const study::StudyRows& rows, const std::string& folder) {
  io::write_output(in(folder, "results.csv"), study::study_csv(plan, rows));
  write_effects(plan, rows, folder);
}

std::string progress_text(const study::Progress& p, double seconds) {
  std::string text = fmt::format("{}/{} specimens", p.n_done, p.n_total);
  if (p.n_failed > 0) text += fmt::format(" ({} without an answer)", p.n_failed);
  text += fmt::format(", {:.0f} s", seconds);
  // Until one has finished, the length of a test is a guess.
  if (p.n_new == 0) return text + (p.work > 0.0 ? "" : ", starting");
  return text + fmt::format(", {:.0f} per minute, about {} left",
                            60.0 * static_cast<double>(p.n_new) / seconds,
                            report::duration_text(p.seconds_left(seconds)));
}

}  // namespace phy::jobs
