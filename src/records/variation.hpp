// How E and strength over the inclination answer to parameters that vary one at a time around a base: what is
// left of a study for pictures; and lines that others found, to be held against it. Plain data, SI units.
#pragma once
#include <string>
#include <vector>

#include "base/stats.hpp"

namespace phy {

/// A number at one inclination, over packings and bond seeds.
struct AngleValue {
  double theta = 0.0;  ///< [deg]
  Summary value;       ///< [Pa]; n = 0: none of the specimens has it
};

/// Macro joint stiffnesses by Eq. 1 (theory/eq1_fit.hpp).
struct MacroPoint {
  double factor = 0.0;  ///< parameter / its base
  Summary K_n, K_s;     ///< [Pa/m]; n = 0: the data allow none
};

/// number = slope * key + intercept, as somebody found it.
struct Regression {
  std::string source;      ///< who, where
  std::string number;      ///< "K_n", "ucs"
  std::string key;         ///< of the recipe: "bedding.k_n"
  double slope = 0.0;      ///< SI units of number per those of key
  double intercept = 0.0;  ///< SI
  std::string unit;        ///< of number and intercept: "Pa/m"
  double R2 = 0.0;         ///< NaN: not given
};

struct VariedSetting {
  std::string text;     ///< "840 GPa/m"
  double value = 0.0;   ///< SI; NaN for words
  double factor = 0.0;  ///< of the base; NaN for words, and for a base of 0
  bool base = false;
  std::vector<AngleValue> E, ucs;  ///< angles ascending; ucs is empty where no test was run to the peak
  std::vector<std::vector<AngleValue>> E_each;  ///< of each packing and bond seed by itself; empty: not known
};

struct VariedParameter {
  std::string key;                      ///< of the recipe: "bedding.k_n"
  std::vector<VariedSetting> settings;  ///< ascending, the base among them
};

struct Variation {
  std::string name;
  double spacing = 0.0;   ///< of the bedding planes [m]; 0: not known, or no planes
  double E_intact = 0.0;  ///< [Pa]; 0: not known
  std::vector<VariedParameter> parameters;
  std::vector<Regression> regressions;  ///< that the study is held against
};

}  // namespace phy
