// What grains half as large make of nu: a rock that is one of small grains, by a model of coarse ones.
#include "calibrate/finer_grains.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "calibrate/elastic_response.hpp"

namespace phy::calibrate {
namespace {

const std::vector<std::int64_t> seeds = {1, 2};
const Cell nu_45{Property::nu, 45.0};

/// Some 300 coarse grains.
Rock coarse_rock() {
  Rock rock;
  rock.model.packing.n_grains = 300;
  rock.model.packing.radius_min *= 5.0, rock.model.packing.radius_max *= 5.0;
  rock.model.bedding.resize(1);
  rock.model.bedding[0].spacing = 0.012, rock.model.bedding[0].zone_thickness *= 5.0;
  return rock;
}

/// What the rock has on small grains, nu by so much more.
std::vector<Target> table_of(Recipe small, double more_nu, Simulator& simulator) {
  small.packing.n_grains *= 4, small.packing.radius_min /= 2.0, small.packing.radius_max /= 2.0;
  std::vector<Target> targets;
  for (const Property p : {Property::E, Property::nu})
    for (const double theta : {0.0, 45.0, 90.0})
      targets.push_back({p, theta, 1.0, p == Property::E ? 1e8 : 0.005, 3, false});
  const std::vector<Comparison> values = elastic_response(small, targets, seeds, simulator);
  for (std::size_t i = 0; i < targets.size(); ++i)
    targets[i].mean = values[i].mean + (targets[i].property == Property::nu ? more_nu : 0.0);
  return targets;
}

TEST(FinerGrains, AreNamedWhereTheyMeetANuThatCoarseOnesMiss) {
  const auto simulator = make_simulator({2, "", nullptr, nullptr});
  const Rock rock = coarse_rock();
  ElasticFit fit;  // that misses nu at 45 degrees by 0.06
  for (const Target& t : table_of(rock.model, 0.0, *simulator)) {
    Comparison c;
    c.target = t, c.mean = t.mean + (cell_of(t) == nu_45 ? 0.06 : 0.0);
    fit.comparisons.push_back(c);
  }
  std::vector<Target> targets;
  for (const Comparison& c : fit.comparisons) targets.push_back(c.target);
  const auto found = grains_for_nu(Evidence(rock, targets), fit, {nu_45}, seeds, *simulator);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->cells, std::vector<Cell>{nu_45});
  EXPECT_NEAR(found->number("miss"), 0.06, 1e-9);
  EXPECT_LT(found->number("miss_finer"), 0.03);
  EXPECT_NEAR(found->number("finer") / found->number("grains"), 4.0, 1e-9);
  EXPECT_FALSE(grains_for_nu(Evidence(rock, targets), fit, {}, seeds, *simulator)) << "none is missed";
  for (Target& t : targets) t.mean += cell_of(t) == nu_45 ? 0.4 : 0.0;  // of no body
  EXPECT_FALSE(grains_for_nu(Evidence(rock, targets), fit, {nu_45}, seeds, *simulator));
}

}  // namespace
}  // namespace phy::calibrate
