// Moments of a test whose length nobody knows beforehand, kept at equal steps: when twice as many as wanted
// are there, every second one goes and the step doubles. So between n and 2 n remain, whatever the length of
// the test, and nothing but the moments themselves is stored. Rejected: a step from test.max_strain, which a
// brittle test leaves after a tenth.
#pragma once
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace phy::lab {

template <class Moment>
class Moments {
 public:
  /// `wanted` moments at least (fewer rows give fewer); 0 keeps none.
  explicit Moments(std::int64_t wanted) : wanted_(wanted) {}
  /// Whether row number `row`, counted from 0, is to be kept.
  bool due(std::int64_t row) const { return wanted_ > 0 && row % every_ == 0; }
  void keep(Moment moment) {
    kept_.push_back(std::move(moment));
    if (static_cast<std::int64_t>(kept_.size()) <= 2 * wanted_) return;
    for (std::size_t i = 0; 2 * i < kept_.size(); ++i)
      if (i > 0) kept_[i] = std::move(kept_[2 * i]);
    kept_.resize((kept_.size() + 1) / 2);
    every_ *= 2;
  }
  /// All kept ones, and `last` if it is of a later step than they are.
  std::vector<Moment> take(Moment last) {
    if (kept_.empty() || kept_.back().step != last.step) kept_.push_back(std::move(last));
    return std::move(kept_);
  }

 private:
  std::int64_t wanted_, every_ = 1;
  std::vector<Moment> kept_;
};

}  // namespace phy::lab
