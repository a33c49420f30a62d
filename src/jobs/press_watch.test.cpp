#include "jobs/press_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/in_folder_fixture.hpp"
#include "io/base64.hpp"

namespace phy::jobs {
namespace {

using Json = nlohmann::json;
using std::chrono::milliseconds;
using testing::ElementsAre;

/// Pictures may cost whatever they do.
const PressWatchOptions free_of_charge = {milliseconds(3000), 1e9};

class PressWatchTest : public InFolder {
 protected:
  Json now() const { return Json::parse(read(at(press_file))); }
  bool shows() const { return std::filesystem::exists(at(press_file)); }
  std::vector<double> strain() const { return now()["strain"].get<std::vector<double>>(); }
};

/// Two discs side by side in a box of 2 x 4 m, joined by a joint, and one above.
struct Bench {
  Recipe recipe;
  Specimen specimen;
  Frame frame{0.0, 0.0, 0.0, {{0.0F, 0.0F}, {0.5F, 0.0F}, {0.0F, -0.25F}}};
  std::vector<CrackEvent> cracks;
  int n_looks = 0;

  explicit Bench(const std::string& name) {
    auto packing = std::make_shared<Packing>();
    packing->width = 2.0, packing->height = 4.0;
    packing->discs = {{0.5, 2.0, 0.5}, {1.5, 2.0, 0.5}, {1.0, 3.0, 0.5}};
    specimen.name = name, specimen.packing = packing;
    specimen.contacts.resize(1);
    specimen.contacts[0].b = 1, specimen.contacts[0].kind = ContactKind::joint;
    specimen.bedding.resize(1);
    specimen.bedding[0].theta = 30.0, specimen.bedding[0].spacing = 0.5;
  }
  RunningTest at(double strain, double stress, bool over = false) {
    return {specimen, recipe, strain, stress, over, [this] {
              ++n_looks;
              return SpecimenNow{frame, cracks};
            }};
  }
};

template <class T>
std::string packed(std::vector<T> numbers) {
  return io::base64({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)});
}

TEST_F(PressWatchTest, WritesDiscsMovesAndCracksInSixteenBits) {
  PressWatch watch(folder.string(), free_of_charge);
  EXPECT_FALSE(shows());
  Bench b("theta = 30 deg");
  CrackEvent crack;
  crack.a = 0, crack.b = 2, crack.mode = CrackMode::shear, crack.place = CrackPlace::bedding;
  crack.normal = {0.0, -1.0}, crack.size = 1.0;
  b.cracks = {crack};
  watch.reading(b.at(1e-3, 5e6));
  const Json seen = now();
  EXPECT_EQ(seen["specimen"], "theta = 30 deg");
  EXPECT_EQ(seen["test"], "uniaxial");
  EXPECT_EQ(seen["bedding"][0]["spacing"], 0.5);
  EXPECT_EQ(seen["crack_kinds"].size(), 4U);
  const double quantum = seen["disc_quantum [m]"];
  EXPECT_DOUBLE_EQ(quantum, 4.0 / 60000.0);
  // From the centre of the specimen, in units of the quantum.
  EXPECT_EQ(seen["discs"], packed<std::int16_t>({-7500, 0, 7500, 7500, 0, 7500, 0, 15000, 7500}));
  EXPECT_EQ(seen["jointed"], packed<std::uint8_t>({1, 1, 0}));
  EXPECT_DOUBLE_EQ(seen["displacement_quantum [m]"], 0.5 / 32000.0);
  EXPECT_EQ(seen["moves"], packed<std::int16_t>({0, 0, 32000, 0, 0, -16000}));
  EXPECT_EQ(seen["cracks"]["pairs"], packed<std::uint32_t>({0, 2}));
  EXPECT_EQ(seen["cracks"]["shapes"], packed<std::int16_t>({0, -32767, 15000}));
  EXPECT_EQ(seen["cracks"]["kinds"], packed<std::uint8_t>({3}));
}

TEST_F(PressWatchTest, ATestThatHasBlownUpIsShownAllTheSame) {
  PressWatch watch(folder.string(), free_of_charge);
  Bench b("intact");
  b.frame.u = {{std::nanf(""), 0.0F}, {INFINITY, 0.0F}, {0.001F, 0.0F}};
  watch.reading(b.at(1e-3, 5e6));
  EXPECT_EQ(now()["moves"], packed<std::int16_t>({0, 0, 32767, 0, 4000, 0}));
}

TEST_F(PressWatchTest, LooksAFewTimesASecondAlone) {
  PressWatch watch(folder.string(), free_of_charge);
  Bench b("intact");
  for (int i = 0; i < 1000; ++i) watch.reading(b.at(1e-6 * i, 1e6));
  EXPECT_LE(b.n_looks, 3);
  EXPECT_GE(b.n_looks, 1);
}

TEST_F(PressWatchTest, PicturesTakeTheirShareOfTheTimeAlone) {
  PressWatch watch(folder.string(), {milliseconds(3000), 1e-9});
  Bench b("intact");
  watch.reading(b.at(1e-6, 1e6));
  std::this_thread::sleep_for(milliseconds(300));  // long enough, but nothing is computed
  watch.reading(b.at(2e-6, 1e6));
  EXPECT_EQ(b.n_looks, 1);
}

TEST_F(PressWatchTest, FollowsOneSpecimenToItsEnd) {
  PressWatch watch(folder.string(), free_of_charge);
  Bench first("first"), second("second");
  for (int i = 1; i <= 5; ++i) {
    watch.reading(first.at(0.001 * i, 1e6 * i));
    watch.reading(second.at(0.002 * i, 2e6 * i));  // not this one
  }
  EXPECT_EQ(second.n_looks, 0);
  watch.reading(first.at(0.006, 1e6, true));
  EXPECT_TRUE(now()["over"].get<bool>());
  EXPECT_THAT(strain(), ElementsAre(0.001, 0.002, 0.003, 0.004, 0.005, 0.006));
  watch.reading(second.at(0.012, 2e6));
  EXPECT_EQ(now()["specimen"], "first") << "its end is seen for a moment";
  std::this_thread::sleep_for(milliseconds(450));
  watch.reading(second.at(0.014, 2e6));
  EXPECT_EQ(now()["specimen"], "second");
  EXPECT_THAT(strain(), ElementsAre(0.002, 0.004, 0.006, 0.008, 0.01, 0.012, 0.014)) << "from its beginning";
}

TEST_F(PressWatchTest, WhoHasFallenSilentIsOver) {
  PressWatch watch(folder.string(), {milliseconds(0), 1e9});
  Bench first("first"), second("second");
  watch.reading(first.at(0.001, 1e6));
  watch.reading(second.at(0.001, 1e6));
  EXPECT_EQ(now()["specimen"], "second");
}

TEST_F(PressWatchTest, ATestThatBeginsAnewIsShownFromThere) {
  PressWatch watch(folder.string(), free_of_charge);
  Bench b("intact");
  watch.reading(b.at(0.002, 1e6)), watch.reading(b.at(0.003, 1e6));
  watch.reading(b.at(0.0005, 5e5));
  watch.reading(b.at(0.0006, 5e5, true));
  EXPECT_THAT(strain(), ElementsAre(0.0005, 0.0006));
}

TEST_F(PressWatchTest, BetweenStagesNothingIsShownAndWhatRunsKeepsItsBeginning) {
  PressWatch watch(folder.string(), free_of_charge);
  Bench b("intact");
  watch.reading(b.at(1e-3, 1e6));
  watch.clear();
  EXPECT_FALSE(shows());
  watch.reading(b.at(2e-3, 2e6));
  EXPECT_THAT(strain(), ElementsAre(1e-3, 2e-3));
}

TEST_F(PressWatchTest, ALongCurveKeepsItsEnds) {
  PressWatch watch(folder.string(), free_of_charge);
  Bench b("intact");
  for (int i = 0; i < 5000; ++i) watch.reading(b.at(1e-6 * i, 1.0 * i, i == 4999));
  const std::vector<double> kept = strain();
  EXPECT_LE(kept.size(), 401U);
  EXPECT_GE(kept.size(), 200U);
  EXPECT_LT(kept.front(), 2e-5);
  EXPECT_GT(kept.back(), 0.00496);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
}

TEST_F(PressWatchTest, AtItsEndTheFileGoes) {
  {
    PressWatch watch(folder.string(), free_of_charge);
    Bench b("intact");
    watch.reading(b.at(1e-3, 1e6));
    EXPECT_TRUE(shows());
  }
  EXPECT_FALSE(shows());
}

TEST_F(PressWatchTest, AFolderThatIsGoneStopsNothing) {
  PressWatch watch(at("sub"));
  Bench b("intact");
  EXPECT_NO_THROW(watch.reading(b.at(1e-3, 1e6)));
}

}  // namespace
}  // namespace phy::jobs
