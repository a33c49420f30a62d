// The vocabulary of laboratories: what columns of a table are called, words of moduli, of directions, of rows
// that are made of others. One list: readers, messages and docs/tables.md follow it.
#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "records/rock.hpp"

namespace phy::rock {

/// What a column holds. `scatter`: the standard deviation of the property. `cohesion` and `friction`: of a
/// Mohr-Coulomb envelope through strengths under `least_confining` to `most_confining`.
enum class Column {
  theta,
  beta,
  confining,
  diameter,
  n,
  value,
  scatter,
  cohesion,
  friction,
  least_confining,
  most_confining,
  intermediate,  ///< sigma_2, which has to be the confining stress
  normal,        ///< stress across sheared bedding
  passed,        ///< by the user's word, or beside replicates
  other
};

/// A column: our name, what it holds, and what laboratories call it.
struct Known {
  const char* name;
  Column kind;
  Property property;
  const char* meaning;
  std::vector<const char*> others;
};
const std::vector<Known>& known_columns();
/// The column of a name, ours or a laboratory's, as key_of has it; nullptr: none.
const Known* known_column(const std::string& key);
/// Which modulus a name says, "Et50", "secant modulus", "Young's modulus (dynamic)".
std::optional<ModulusReading> modulus_of(const std::string& key);
/// Our names of columns; of each value also its scatter, "UCS_sd".
const std::vector<std::string>& column_names();

/// Lower case of ASCII, of the Latin letters with accents and of Cyrillic (two bytes each in UTF-8).
std::string lower_case(std::string_view text);
/// A name as names are compared: lower case, no blanks and signs, Greek letters by their names.
std::string key_of(std::string_view text);
/// The words of a title, each as key_of has it.
std::vector<std::string> words_of(const std::string& title);

template <class List>
bool contains(const List& list, const std::string& key) {
  return std::find(list.begin(), list.end(), key) != list.end();
}
template <class List>
bool holds_any(const std::string& key, const List& words) {
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return key.find(word) != key.npos; });
}

/// What a title that is no name may be about.
struct Subjects {
  bool angles = false;      ///< "dip", "orientation"
  bool directions = false;  ///< these, and "plug", "loading"
  bool values = false;      ///< "residual strength"
};
Subjects subjects_of(const std::string& title);

/// Does a cell say that its row is no specimen, "Mean" or "SD"?
bool is_summary(const std::string& cell);
/// "SD", "St. dev.", "± SD".
bool is_scatter(const std::string& cell);
/// The same of a row's name with more words: "Mean values (n = 3)", "Standard deviation".
bool begins_summary(const std::string& cell);

}  // namespace phy::rock
