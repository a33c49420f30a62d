// Which model of the layers is chosen, for rocks whose model is known: rows of the maps as a laboratory would
// report them, moduli by the direct solution of a small packing.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <thread>

#include "calibrate/elastic_response.hpp"
#include "calibrate/model_choice.hpp"
#include "calibrate/reach.hpp"
#include "calibrate/reading_fixture.hpp"
#include "twin_trial.hpp"

namespace phy {
namespace {

using calibrate::ModelFamily;
using calibrate::ReachTable;

const ModelFamily& family(const std::string& name) {
  for (const ModelFamily& f : calibrate::model_families())
    if (f.name == name) return f;
  throw std::runtime_error(name);
}

Rock rock_of(const ReachTable& table, std::size_t row) {
  Rock rock;
  rock.model = magnified_model(5.0);
  rock.model.bedding[0].rule = BeddingRule::crossing;
  rock.E_is = ModulusReading::tangent_50;
  for (const double theta : calibrate::mapped_angles) {
    rock.readings.push_back(
        calibrate::reading(Property::E, theta, 38e9 * table.at(row, fmt::format("E50/E_c({:g})", theta))));
    rock.readings.push_back(calibrate::reading(
        Property::ucs, theta, 50e6 * table.at(row, fmt::format("UCS/sigma_c({:g})", theta))));
  }
  for (const double theta : calibrate::mapped_disc_angles) {
    const double bts = 50e6 * table.at(row, fmt::format("BTS/sigma_c({:g})", theta));
    if (std::isfinite(bts)) rock.readings.push_back(calibrate::reading(Property::brazilian, theta, bts));
  }
  return rock;
}

/// How many of the first few sensible rows of a family are taken for what they are.
int recognised(const std::string& name, LayerModel layers, int n, calibrate::Simulator& simulator) {
  const ReachTable& table = calibrate::reach_of(family(name));
  int right = 0;
  for (std::size_t row = 0; n > 0; ++row) {
    if (!table.is_sensible(row)) continue;
    --n;
    const calibrate::Evidence evidence(rock_of(table, row));
    const calibrate::ModelChoice choice =
        calibrate::choose_layers(evidence, 1, simulator, [](const std::string&) {});
    right += choice.layers == layers ? 1 : 0;
    std::printf("%s, row %zu: %s\n", name.c_str(), row, choice.text().c_str());
  }
  return right;
}

TEST(ModelChoice, TellsRocksOfPlanesFromRocksWithDirections) {
  const auto simulator = calibrate::make_simulator(
      {static_cast<int>(std::max(1U, std::thread::hardware_concurrency())), "", nullptr, nullptr});
  EXPECT_GE(recognised("parallel-bond-crossing", LayerModel::planes, 3, *simulator) +
                recognised("parallel-bond-directions", LayerModel::directions, 3, *simulator),
            5);
}

}  // namespace
}  // namespace phy
