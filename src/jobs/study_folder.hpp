// The folder of a study: study.toml, recipe.toml, the store study.sqlite (of a shard: shard-I-of-N.sqlite)
// and the tables made from it.
#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "study/effects.hpp"
#include "study/plan.hpp"
#include "study/work.hpp"

namespace phy::jobs {

/// The files that say what a study is; none for one that goes on where they are.
using StudyFiles = std::vector<std::pair<std::string, std::string>>;

std::string store_file(const std::string& folder, const study::Shard& shard);

/// The study of an earlier run. Throws IoError where the folder is none of a study.
study::Study study_in(const std::string& folder);
std::vector<std::string> shards_in(const std::string& folder);

// What stands in the way throws InputError.
/// responses.csv and effects.csv.
void check_effects(const std::string& folder);
/// The tables of a whole store, and its page.
void check_tables(const std::string& folder, const std::string& word);
/// Before the folder is looked at: what it holds of an earlier run is no input.
void check_study_outputs(const StudyFiles& files, const std::string& folder, const study::Shard& shard);
/// A folder holds one study: of this name and solver, on this base recipe. It may grow.
void refuse_other_study(const study::Study& study, const std::string& folder);
/// What parts have run would run again, unless it is merged first: IoError.
void refuse_unmerged(const std::string& folder);

/// Makes the folder ready, opens its store and writes the files beside it.
std::unique_ptr<study::Store> begin_study(const StudyFiles& files, const std::string& folder,
                                          const study::Shard& shard);

/// responses.csv and effects.csv.
void write_effects(const study::Plan& plan, const study::StudyRows& rows, const std::string& folder);
/// These and results.csv.
void write_tables(const study::Plan& plan, const study::StudyRows& rows, const std::string& folder);

/// One line on how far a study has come.
std::string progress_text(const study::Progress& p, double seconds);

}  // namespace phy::jobs
