// The elastic stage on every elastic tensor of data/rocks: mean E over five unseen packings within 2 % at
// every angle, or a verdict that names the limit. PHY_TENSOR_FIRST, PHY_TENSORS choose some of the 26;
// PHY_TWIN_THREADS sets the threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "calibrate/calibration.hpp"
#include "report/words.hpp"
#include "rock/table.hpp"
#include "setting.hpp"

namespace phy {
namespace {

constexpr std::size_t n_angles = 7;

/// The tables: seven rows of a file are one tensor.
std::vector<Rock> tensors() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(PHY_SOURCE_DIR "/data/rocks"))
    if (entry.path().filename().string().starts_with("dyn_")) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Rock> rocks;
  for (const auto& file : files) {
    std::ifstream in(file);
    std::string header, line, table;
    std::getline(in, header);
    for (std::size_t row = 1; std::getline(in, line); ++row) {
      table += line + "\n";
      if (row % n_angles != 0) continue;
      Rock rock;
      rock.model.bedding.resize(1);
      std::vector<Problem> problems;
      const rock::Readings read =
          rock::parse_readings(header + "\n" + table, file.filename().string(), {}, problems, rock.notes);
      rock.readings = read.values, rock.bedded = read.bedded;
      EXPECT_TRUE(problems.empty()) << file;
      rock.name = file.stem().string().substr(4) + " " + std::to_string(row / n_angles);
      rocks.push_back(rock);
      table.clear();
    }
  }
  return rocks;
}

double worst_E(const std::vector<Comparison>& rows) {
  double worst = 0.0;
  for (const Comparison& c : rows)
    if (c.target.property == Property::E) worst = std::max(worst, std::fabs(c.error()));
  return worst;
}

TEST(ElasticTensors, ModulusWithinTwoPercentOrAVerdictThatNamesTheLimit) {
  const auto threads = static_cast<int>(setting("PHY_TWIN_THREADS", std::thread::hardware_concurrency()));
  const std::vector<Rock> all = tensors();
  ASSERT_EQ(all.size(), 26U);
  const auto first = static_cast<int>(setting("PHY_TENSOR_FIRST", 0)),
             n = static_cast<int>(setting("PHY_TENSORS", 26));
  int limited = 0, run = 0;
  for (int k = first; k < std::min(26, first + n); ++k, ++run) {
    const Rock& rock = all[static_cast<std::size_t>(k)];
    const auto simulator = calibrate::make_simulator({threads, "", nullptr, nullptr});
    calibrate::CalibrationOptions options;
    options.elastic_only = true;
    const std::clock_t start = std::clock();
    const Calibration c = calibrate::calibrate(Evidence(rock), options, *simulator);
    const double cpu = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const double fitted = worst_E(c.fitted), unseen = worst_E(c.verification);
    std::printf("| %s | %.1f | %.1f | %.0f | %lld | %s |", rock.name.c_str(), 100.0 * fitted, 100.0 * unseen,
                cpu, static_cast<long long>(c.counts.solutions), to_string(c.verdict.status));
    for (const ParameterEstimate& p : c.parameters) std::printf(" %s %.3g", p.symbol.c_str(), p.value);
    for (const Finding& f : c.verdict.findings) std::printf("\n    %s", report::sentence(f).c_str());
    std::printf("\n");
    std::fflush(stdout);
    if (unseen <= 0.02) continue;
    ++limited;
    EXPECT_NE(c.verdict.status, VerdictStatus::calibrated) << rock.name;
    EXPECT_FALSE(c.verdict.findings.empty()) << rock.name;
  }
  std::printf("%d of %d with a verdict that names a limit\n", limited, run);
  EXPECT_LE(9 * limited, run);
}

}  // namespace
}  // namespace phy
