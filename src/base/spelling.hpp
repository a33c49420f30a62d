// What somebody may have meant by a word that nobody knows.
#pragma once
#include <string>
#include <vector>

namespace phy {

/// The candidate nearest in spelling, or an empty string when none is near.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace phy
