// What a search of strengths may spend, and what it says of that: points, rounds, packings, threads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "calibrate/calibration.hpp"
#include "calibrate/strength_rocks_fixture.hpp"

namespace phy::calibrate {
namespace {

TEST(StrengthStage, KeepsToItsBudget) {
  PaperPress press;
  const Searched f = fit(laboratory(truth(1), 1), press, {200});
  EXPECT_EQ(f.counts.tests, press.n_tests);
  EXPECT_EQ(f.counts.tests, 28 * 7) << "a whole search, and no round beyond the budget";
  EXPECT_FALSE(f.shortage.any());
  EXPECT_GT(f.counts.coarse, 0);
}

TEST(StrengthStage, SeveralThreadsFindTheSame) {
  const auto found = [](int threads) {
    PaperPress press;
    press.n_threads = threads;
    return fit(laboratory(truth(1), 1), press, {70, quick_effort});
  };
  const StrengthFit one = found(1), three = found(3);
  ASSERT_EQ(one.parameters.size(), three.parameters.size());
  for (std::size_t i = 0; i < one.parameters.size(); ++i) {
    EXPECT_EQ(one.parameters[i].value, three.parameters[i].value) << one.parameters[i].symbol;
    EXPECT_EQ(one.parameters[i].low, three.parameters[i].low) << one.parameters[i].symbol;
  }
  for (std::size_t i = 0; i < one.left_out.size(); ++i)
    EXPECT_EQ(one.left_out[i].mean, three.left_out[i].mean) << i;
}

bool has_note(const StrengthFit& f, FindingKind kind) { return first_of(f.notes, kind) != nullptr; }
bool unsettled(const StrengthFit& f) {
  return has_note(f, FindingKind::unsettled_tests) || has_note(f, FindingKind::unsettled_known) ||
         has_note(f, FindingKind::unsettled_moved);
}

// Two of four packings. Where these surprise and the second came nearer to the table a third follows, which
// does not, and ends the search; without tests for it that the estimate has not settled is said.
TEST(StrengthStage, RoundsAfterCoarseGrainsEndWithTheFirstThatComesNoNearer) {
  const auto found = [](double scatter, std::int64_t most) {
    PaperPress press;
    press.packing_scatter = scatter;
    const Searched f = fit(some_of(laboratory(truth(1), 1)), press, {most});
    EXPECT_EQ(f.counts.coarse, 20 * 5);
    return f;
  };
  const auto rounds = [](const Searched& f) {
    return static_cast<double>(f.counts.tests - f.counts.coarse) / (4 * 5);
  };
  const Searched calm = found(0.002, 1000), wild = found(0.2, 1000), short_of_tests = found(0.2, 143);
  EXPECT_EQ(rounds(calm), 2.0);
  EXPECT_FALSE(unsettled(calm) || has_note(calm, FindingKind::rounds_no_nearer));
  EXPECT_EQ(rounds(wild), 3.0);
  EXPECT_TRUE(has_note(wild, FindingKind::rounds_no_nearer));
  EXPECT_EQ(rounds(short_of_tests), 2.0);
  EXPECT_TRUE(unsettled(short_of_tests));
}

// Packings that differ by 20 % surprise in every round. Without coarse grains four rounds are planned, and up
// to six may follow.
TEST(StrengthStage, ARoundThatComesNoNearerIsTheLast) {
  PaperPress press;
  press.packing_scatter = 0.2;
  Rock rock;
  rock.model.bedding.resize(1), rock.model.packing.n_grains = 1197;  // no coarse grains
  const Searched wild = searched(rock, some_of(laboratory(truth(1), 1)), press, {1000});
  const Finding* last = first_of(wild.notes, FindingKind::rounds_no_nearer);
  ASSERT_NE(last, nullptr);
  EXPECT_EQ(last->number("rounds"), 4.0);
  EXPECT_EQ(wild.counts.tests, 36 * 5);
  EXPECT_FALSE(wild.shortage.any());
}

TEST(StrengthStage, EffortIsTheNumberOfPoints) {
  const auto found = [](const Budget& budget) {
    PaperPress press;
    press.packing_scatter = 0.005;
    Rock rock;
    rock.model.bedding.resize(1), rock.model.packing.n_grains = 1197;  // no coarse grains
    std::vector<Target> targets = laboratory(truth(1), 1);
    std::erase_if(targets, [](const Target& t) { return std::fmod(t.theta, 45.0) != 0.0; });
    return searched(rock, targets, press, budget);
  };
  constexpr std::int64_t n_angles = 3;
  const Searched quick = found({1000, quick_effort}), thorough = found({72 * n_angles, efforts.back()}),
                 cut = found({20 * n_angles, efforts.back()}), part = found({50 * n_angles, efforts.back()}),
                 both = found({20 * n_angles, quick_effort});
  EXPECT_EQ(quick.counts.tests, 18 * n_angles);
  EXPECT_TRUE(quick.shortage.of_effort && !quick.shortage.of_tests);
  EXPECT_EQ(thorough.counts.tests, 72 * n_angles);
  EXPECT_FALSE(thorough.shortage.any());
  EXPECT_EQ(cut.counts.tests, 20 * n_angles);
  EXPECT_TRUE(!cut.shortage.of_effort && cut.shortage.of_tests);
  EXPECT_TRUE(both.shortage.of_effort && both.shortage.of_tests);
  EXPECT_FALSE(part.shortage.any()) << "more than a usual search";
  const Finding* note = first_of(part.notes, FindingKind::search_cut);
  ASSERT_NE(note, nullptr);
  EXPECT_EQ(note->number("points"), 72.0);
  EXPECT_EQ(note->number("paid"), 50.0);
}

TEST(StrengthStage, AShortSearchTellsHowManyPackingsItSaw) {
  PaperPress press;
  Rock rock;
  rock.model.bedding.resize(1);
  const std::vector<std::int64_t> twelve = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  const auto packings = [&](std::int64_t budget) {
    return searched(rock, some_of(laboratory(truth(1), 1)), press, {budget}, twelve)
        .fitted.front()
        .n_packings;
  };
  // Five and two points, two to a packing, and the estimate on two more.
  EXPECT_EQ(packings(45), 6);
  EXPECT_EQ(packings(180), 12);
}

TEST(StrengthStage, PackingsByPorosityAreSearchedOnCoarseGrainsToo) {
  Rock rock;
  rock.model.bedding.resize(1);
  rock.model.packing.n_grains = 0, rock.model.packing.porosity = 0.082;
  const auto n_coarse = [&] {
    PaperPress press;
    return searched(rock, some_of(laboratory(truth(1), 1)), press, {45}).counts.coarse;
  };
  EXPECT_EQ(n_coarse(), 7 * 5);
  rock.model.packing.radius_min *= 1.5, rock.model.packing.radius_max *= 1.5;  // some 3,300 grains: too few
  EXPECT_EQ(n_coarse(), 0);
}

TEST(StrengthStage, WherePackingsDifferMuchMoreOfThemVerifyAsFarAsTheBudgetGoes) {
  Rock rock = rock_of({{Property::ucs, 0.0, 150e6}}, false);
  rock.model.packing.n_grains = 1197;
  std::int64_t n_search = 18;
  const auto n_unseen = [&](double scatter, std::int64_t max_tests) {
    PaperPress press;
    press.packing_scatter = scatter;
    CalibrationOptions options;
    options.max_tests = max_tests, options.effort = quick_effort;  // 18 points, no further rounds
    const Calibration c = calibrate(Evidence(rock), options, press);
    for (const Comparison& row : c.verification) EXPECT_EQ(row.n_packings, c.verification.front().n_packings);
    const bool noted = first_of(c.notes, FindingKind::packings_added) != nullptr;
    EXPECT_EQ(noted, c.verification.front().n_packings > 5);
    EXPECT_EQ(c.counts.tests, n_search + c.verification.front().n_packings);
    return c.verification.front().n_packings;
  };
  EXPECT_EQ(n_unseen(0.005, 1000), 5);  // far from where chance decides
  EXPECT_EQ(n_unseen(0.12, 1000), 15);
  EXPECT_EQ(n_unseen(0.12, 18 + 10), 10);
  rock.model.packing.n_grains = 7481, n_search = 14;  // ten of them coarse; more are too dear
  EXPECT_EQ(n_unseen(0.12, 1000), 5);
}

TEST(StrengthStage, StopsWhenTheUserDoes) {
  PaperPress press;
  press.stop_after = 100;
  const Searched f = fit(laboratory(truth(1), 1), press);
  EXPECT_TRUE(f.stopped);
  EXPECT_EQ(f.recipe.packing.n_grains, Recipe().packing.n_grains) << "what was known until then";
  EXPECT_TRUE(f.parameters.empty());
}

}  // namespace
}  // namespace phy::calibrate
