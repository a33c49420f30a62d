// Words that the shell offers for the value of an option (cli/completion_command.cpp).
#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "io/document.hpp"

namespace phy::cli {

/// For an option whose value may also be another one; made when they are asked for, without a comma in any. A
/// closed set of words is a CLI::IsMember, and needs none.
CLI::Validator suggested(std::function<std::vector<std::string>()> words);

/// Paths of all keys of these files, for an option that explains one.
std::vector<std::string> keys_of(const std::vector<const io::Schema*>& schemas);

}  // namespace phy::cli
