// What scripts for PFC call a key of the recipe. Properties of PFC stand in the list of keys
// (Field::pfc_name); here are the names that scripts give to their own variables, and words that have no key,
// with the reason.
#pragma once
#include <string>

#include "records/field.hpp"

namespace phy {

/// A word of another program. One of `field` and `instead` says what there is for it here; neither: the word
/// is unknown.
struct ForeignWord {
  const Field* field = nullptr;
  std::string formula;  ///< the value of `field` from the word's: "1/kratio", "180 - dip", "pb_ten"
  std::string instead;  ///< why there is no such key, and what to do
};
/// Where several keys have the word, the one of `table` comes first.
ForeignWord foreign_word(const Fields& fields, const std::string& word, const std::string& table);

/// The value of the key in SI or degrees, from the other program's value: "1/x" and "180 - x" are worked out.
double value_of(const ForeignWord& word, double theirs);

}  // namespace phy
