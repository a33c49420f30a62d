// One problem of many lines: the first in full, the others counted.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/check.hpp"

namespace phy::io {

class RepeatedProblem {
 public:
  void add(Problem p) {
    if (first_)
      ++more_;
    else
      first_ = std::move(p);
  }
  /// Appends it with "and 49 more lines", if there is one.
  void tell(std::vector<Problem>& problems) const {
    if (!first_) return;
    problems.push_back(*first_);
    if (more_ == 0) return;
    std::string& remedy = problems.back().remedy;
    remedy += (remedy.empty() ? "and " : "; and ") + std::to_string(more_) + " more line";
    remedy += more_ > 1 ? "s" : "";
  }

 private:
  std::optional<Problem> first_;
  int more_ = 0;
};

}  // namespace phy::io
