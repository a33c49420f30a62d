// The measured rocks that come with the program (data/rocks): their files, and which of them is nearest to
// another table.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/finding.hpp"
#include "records/rock.hpp"
#include "rock/template.hpp"

namespace phy::jobs {

/// Names of their folders, in alphabetical order.
std::vector<std::string> base_rocks();
/// Its table as a rock. Throws InputError where there is no such rock.
Rock base_rock(const std::string& name);
/// The text of card.json. Throws InputError likewise.
std::string_view base_card(const std::string& name);

/// What a copy of the rock's folder consists of; the rock file names the table beside it.
struct BaseFile {
  std::string name, text;
};
std::vector<BaseFile> base_files(const std::string& name);

/// Grain size, spacing, size of specimen and model of a new rock that begins like this one.
rock::Start start_like(const std::string& name);

/// By E, UCS and BTS each the rock with the most similar curve over the angles, UCS first: the root mean
/// square difference of both, each over its mean, at the angles of the table, below a quarter. A rock with
/// the very same values is no neighbour but named for that. Nothing where no curve can be compared.
std::optional<Finding> nearest_rock(const std::vector<Target>& table);

}  // namespace phy::jobs
