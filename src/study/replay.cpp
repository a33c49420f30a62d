#include "study/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/units.hpp"
#include "records/test_description.hpp"

namespace phy::study {
namespace {

/// Of values as they are read back: any number that is none is like any other.
bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

std::string values_text(double stored, double now) {
  const double share = now / stored - 1.0;
  return fmt::format("stored {}, now {}{}", print_number(stored), print_number(now),
                     std::isfinite(share) ? fmt::format(" ({:+.2g} %)", 100.0 * share) : "");
}

void compare_numbers(const TestResult& stored, const TestResult& now, std::vector<std::string>& found) {
  for (const Number& n : stored.numbers) {
    const auto it = std::find_if(now.numbers.begin(), now.numbers.end(),
                                 [&](const Number& other) { return other.name == n.name; });
    if (it == now.numbers.end())
      found.push_back(fmt::format("{}: stored {}, not measured now", n.name, print_number(n.value)));
    else if (!same(n.value, it->value))
      found.push_back(fmt::format("{} [{}]: {}", n.name, n.unit, values_text(n.value, it->value)));
  }
}

/// The first row with another value, and its first column.
void compare_histories(const History& stored, const History& now, std::vector<std::string>& found) {
  if (stored.kind != now.kind) {
    found.emplace_back("history: of another kind of test");
    return;
  }
  for (std::size_t i = 0; i < std::min(stored.rows.size(), now.rows.size()); ++i)
    for (const HistoryColumn& c : stored.kind->columns)
      if (const double a = stored.rows[i].*c.value, b = now.rows[i].*c.value; !same(a, b))
        return found.push_back(fmt::format("history from row {} of {} on: {}: {}", i + 1, stored.rows.size(),
                                           heading(c), values_text(a, b)));
  if (stored.rows.size() != now.rows.size())
    found.push_back(fmt::format("history: {} rows stored, {} now", stored.rows.size(), now.rows.size()));
}

void compare_cracks(const std::vector<CrackEvent>& stored, const std::vector<CrackEvent>& now,
                    std::vector<std::string>& found) {
  const auto same_crack = [](const CrackEvent& a, const CrackEvent& b) {
    return a.step == b.step && a.a == b.a && a.b == b.b && a.mode == b.mode && a.place == b.place &&
           same(a.energy, b.energy);
  };
  const auto [a, b] = std::mismatch(stored.begin(), stored.end(), now.begin(), now.end(), same_crack);
  if (a == stored.end() && b == now.end()) return;
  found.push_back(fmt::format("cracks: {} stored, {} now; the first that differs is number {}", stored.size(),
                              now.size(), a - stored.begin() + 1));
}

}  // namespace

std::vector<std::string> differences(const TestResult& stored, const TestResult& now) {
  std::vector<std::string> found;
  if (stored.outcome.status != now.outcome.status)
    found.push_back(fmt::format("outcome: stored \"{}\", now \"{}\": {}", to_string(stored.outcome.status),
                                to_string(now.outcome.status), now.outcome.reason));
  compare_numbers(stored, now, found);
  compare_histories(stored.history, now.history, found);
  compare_cracks(stored.cracks, now.cracks, found);
  if (stored.hash != now.hash)
    found.push_back(
        fmt::format("hash of history, cracks and final positions: stored {}, now {}", stored.hash, now.hash));
  return found;
}

std::vector<std::size_t> spread(const std::vector<Recipe>& singles, std::size_t n) {
  std::map<std::tuple<std::string, bool, double>, std::vector<std::size_t>> alike;
  for (std::size_t i = 0; i < singles.size(); ++i)
    alike[{singles[i].test.kind->name, layered(singles[i]), inclination(singles[i])}].push_back(i);
  std::vector<std::size_t> chosen;
  const std::size_t wanted = std::min(n, singles.size());
  for (std::size_t round = 0; chosen.size() < wanted; ++round) {
    std::vector<std::size_t> one_of_each;
    for (const auto& [what, places] : alike)
      if (round < places.size()) one_of_each.push_back(places[round]);
    // Where there are more than are wanted, at equal distances over all of them.
    const std::size_t here = std::min(wanted - chosen.size(), one_of_each.size());
    for (std::size_t k = 0; k < here; ++k) chosen.push_back(one_of_each[k * one_of_each.size() / here]);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace phy::study
