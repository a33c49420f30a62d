#include "io/csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/check.hpp"
#include "base/in_folder_fixture.hpp"
#include "base/rng.hpp"
#include "records/assembly.hpp"
#include "records/test_description.hpp"
#include "system/process.hpp"

namespace phy::io {
namespace {

using testing::HasSubstr;

std::string problems_of(const std::string& text) {
  return message_of<InputError>([&] { parse_discs(text, "d.csv"); });
}

const std::string header = "x [m],y [m],r [m]\n";

TEST(DiscFiles, ReadBackToTheSameBits) {
  Packing p;
  p.width = 1.0 / 3.0, p.height = 2.0 / 3.0;
  for (std::uint32_t i = 0; i < 1000; ++i)
    p.discs.push_back({uniform(1, Stream::test, i), -uniform(2, Stream::test, i) * 1e-7,
                       uniform(3, Stream::test, i) * 1e-6});
  const DiscFile back = parse_discs(discs_csv(p), "d.csv");
  EXPECT_EQ(back.width, p.width);
  EXPECT_EQ(back.height, p.height);
  ASSERT_EQ(back.discs.size(), p.discs.size());
  for (std::size_t i = 0; i < p.discs.size(); ++i) {
    EXPECT_EQ(back.discs[i].x, p.discs[i].x);
    EXPECT_EQ(back.discs[i].y, p.discs[i].y);
    EXPECT_EQ(back.discs[i].r, p.discs[i].r);
  }
}

TEST(DiscFiles, OfOtherProgramsMayHaveBlanksCommentsAndNoBox) {
  const DiscFile f =
      parse_discs("# made elsewhere\r\n" + header + "1, 2 ,\t3\r\n\n# half way\n4,5,6", "d.csv");
  EXPECT_EQ(f.width, 0.0);
  ASSERT_EQ(f.discs.size(), 2U);
  EXPECT_EQ(f.discs[0].y, 2.0);
  EXPECT_EQ(f.discs[1].r, 6.0);
}

TEST(DiscFiles, BadLinesAreToldAllAtOnce) {
  const std::string p = problems_of(header + "1,2,3\n1,2\n1,2,-3\n1,two,3\n1,2,3,4\n1,2,nan\n9,2,3\n");
  for (const char* line : {"d.csv:3", "d.csv:4", "d.csv:5", "d.csv:6", "d.csv:7"})
    EXPECT_THAT(p, HasSubstr(line));
  EXPECT_THAT(p, testing::Not(HasSubstr("d.csv:8")));
  EXPECT_THAT(p, HasSubstr("three numbers x,y,r with r > 0"));
}

TEST(DiscFiles, ManyBadLinesAreCounted) {
  std::string text = header;
  for (int i = 0; i < 1000; ++i) text += "no numbers\n";
  const std::string p = problems_of(text);
  EXPECT_THAT(p, HasSubstr("980 more bad lines"));
  EXPECT_EQ(std::count(p.begin(), p.end(), '\n'), 20);
}

TEST(DiscFiles, OtherColumnsAreRefused) {
  EXPECT_THAT(problems_of("x,y,r\n1,2,3\n"),
              HasSubstr("d.csv:1: header = x,y,r: expected x [m],y [m],r [m]"));
  EXPECT_THAT(problems_of(header), HasSubstr("at least one line"));
  EXPECT_THAT(problems_of(""), HasSubstr("at least one line"));
  EXPECT_THROW(read_discs("/nonexistent.csv"), IoError);
}

TEST(CrackFiles, NameWhatCracksAreFiledUnder) {
  CrackEvent crack;
  crack.step = 300, crack.strain = 4e-5, crack.b = 1;
  for (const TestDescription* test : laboratory_tests()) {
    const std::string text = cracks_csv({crack}, *test);
    EXPECT_EQ(text.find("strain") != text.npos, test->loads_by_strain()) << test->name;
    EXPECT_THAT(text, HasSubstr("time [s]," + heading(test->loading_column()) + ",grain_a"));
    const std::vector<CrackEvent> back = parse_cracks(text, "c.csv");
    ASSERT_EQ(back.size(), 1U);
    EXPECT_EQ(back[0].strain, 4e-5);
  }
}

// To the same bits, an event without a moment too. In direct shear the way is a displacement.
TEST(EventFiles, ReadBackWhatIsWritten) {
  AcousticEvent e;
  e.time = 1e-5 / 3.0, e.strain = 1e-3, e.duration = 2e-7, e.n_cracks = 3, e.position = {0.01, 0.02};
  e.tensor = {1.0 / 3.0, -2.0, 0.5}, e.moment = 1.7, e.thickness = 6e-4, e.magnitude = -8.2;
  e.volume_share = -41.0, e.type = SourceType::implosion, e.energy = 1e-4;
  AcousticEvent mute;
  mute.magnitude = -HUGE_VAL;
  for (const TestDescription* test : laboratory_tests()) {
    const std::string text = events_csv({e, mute}, *test);
    EXPECT_THAT(text, HasSubstr("time [s]," + heading(test->loading_column()) + ",duration"));
    const std::vector<AcousticEvent> back = parse_events(text, "e.csv");
    ASSERT_EQ(back.size(), 2U);
    EXPECT_EQ(events_csv(back, *test), text);
    EXPECT_EQ(back[0].time, e.time);
    EXPECT_EQ(back[0].tensor.xy, -2.0);
    EXPECT_EQ(back[0].type, SourceType::implosion);
    EXPECT_EQ(back[1].magnitude, -HUGE_VAL);
  }
  EXPECT_THROW(parse_events("time [s],strain\n", "e.csv"), IoError);
  std::string loud = events_csv({e}, TestKind());
  loud.replace(loud.find("implosion"), 9, "explosion");
  EXPECT_THROW(parse_events(loud, "e.csv"), IoError);
}

TEST(WallFiles, ReadBackWhatIsWritten) {
  const WallPoint standing{WallMoment::standing, 10.0, 2e7 / 3.0, 4e7, 1e6, -2e5, 1e-5, 0.0};
  const WallPoint end{WallMoment::end, 20.0, 3e7, std::nan(""), 0.0, 0.0, 1e-4, 2e-3};
  const std::string text = wall_csv({standing, end});
  const std::vector<WallPoint> back = parse_wall(text, "w.csv");
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(wall_csv(back), text);
  EXPECT_EQ(back[0].borne_stress, standing.borne_stress);
  EXPECT_EQ(back[1].moment, WallMoment::end);
  EXPECT_TRUE(std::isnan(back[1].hoop));
  std::string other = text;
  other.replace(other.find("standing"), 8, "stand in");
  EXPECT_THROW(parse_wall(other, "w.csv"), IoError);
}

TEST(CrackFiles, AHeadOfNoTestIsRefused) {
  EXPECT_THROW(parse_cracks("step [1],time [s],shear_displacement [1]\n", "c.csv"), IoError);
}

/// The cells of the one contact of two touching discs of radius 1 and 1.
std::vector<std::string> cells_of(const Specimen& s) {
  std::istringstream lines(contacts_csv(s));
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  std::istringstream row(line);
  std::vector<std::string> cells;
  for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
  return cells;
}

Specimen pair() {
  Specimen s = assembly({{0.0, 0.0, 1.0}, {2.0, 0.0, 1.0}}, MatrixRecipe{});
  bond_touching(s);
  return s;
}

// By hand, per metre of thickness: linear k_n = E_c; bond k_n = E_b/(R1 + R2) 2 R = E_b,
// k_m = E_b/(R1 + R2) (2/3) R^3 = E_b/3; joint k_n = k_n 2 R.
TEST(ContactFiles, GiveKindNormalGapAndStiffness) {
  Specimen s = pair();
  EXPECT_THAT(cells_of(s), testing::ElementsAre("0", "1", "bonded", "0", "1", "0", "0", "7.6e+10", "2.28e+10",
                                                testing::_, testing::_, "12666666666.666666", "1", "0"));
  s.contacts[0].kind = ContactKind::touching;
  EXPECT_EQ(cells_of(s)[7], "3.8e+10");
  s.contacts[0].kind = ContactKind::joint;
  s.contacts[0].side = -1;  // the normal of planes at 90 degrees is (-1, 0); it points from a to b
  s.bedding.resize(1);
  s.bedding[0].theta = 90.0;
  EXPECT_THAT(cells_of(s), testing::ElementsAre("0", "1", "joint", "0", "1", "0", "0", "6.72e+12", "1.92e+12",
                                                testing::_, testing::_, "0", "1", "0"));
}

// Where joints have strengths of their own, each has a column for it.
TEST(ContactFiles, GiveTheDrawnStrengthOfJoints) {
  Specimen s = pair();
  s.bedding.resize(1);
  EXPECT_THAT(contacts_csv(s), Not(HasSubstr("sigma_n")));
  s.bedding[0].sigma_n = 4e6, s.bedding[0].sigma_n_sd = 1e6;
  EXPECT_THAT(contacts_csv(s), HasSubstr(",y [m],sigma_n [Pa]\n"));
  EXPECT_EQ(cells_of(s).back(), "0") << "a bond has none";
  s.contacts[0].kind = ContactKind::joint, s.contacts[0].side = -1, s.contacts[0].sigma_n = 1.25;
  EXPECT_EQ(cells_of(s).size(), 15U);
  EXPECT_EQ(cells_of(s).back(), "5e+06");
}

// One disc in another unit must not make all others be held against each other.
TEST(DiscFiles, OneHugeDiscAmongManyDoesNotTakeLong) {
  const std::string head = "x [m],y [m],r [m]\n", odd = "0.5,0.5,1000\n-1,-1,4e-320\n";
  std::string rows;
  for (int i = 0; i < 150000; ++i)
    rows += std::to_string(i % 300 * 0.003) + "," + std::to_string(i / 300 * 0.003) + ",0.001\n";
  const auto time_of = [](const std::string& text, std::size_t n_discs) {
    const double begin = system::thread_seconds();
    EXPECT_EQ(parse_discs(text, "discs.csv").discs.size(), n_discs);
    return system::thread_seconds() - begin;
  };
  const double alike = time_of(head + rows, 150000);
  EXPECT_LT(time_of(head + odd + rows, 150002), 5.0 * alike);  // a thousand times that, disc by disc
  EXPECT_THROW(parse_discs(head + odd + rows + "0.3,0.3,0.5\n", "discs.csv"), InputError)
      << "in one place with a smaller one";
}

TEST(DiscFiles, CentresInOnePlaceAreToldWithBothLines) {
  const auto reported = [](const std::string& rows) { return problems_of(header + rows); };
  const std::string two = reported("0.01,0.01,1e-3\n0.02,0.01,1e-3\n0.01,0.01,5e-4\n");
  EXPECT_NE(two.find("d.csv:4"), two.npos) << two;
  EXPECT_NE(two.find("the disc of line 2"), two.npos) << two;
  EXPECT_EQ(reported("0.01,0.01,1e-3\n0.01,0.0100002,1e-3\n").substr(0, 7), "d.csv:3");  // 2e-4 of the radius
  EXPECT_EQ(reported("0.01,0.01,1e-3\n0.01,0.010002,1e-3\n"), "no error");               // 2e-3: an overlap
  EXPECT_EQ(reported("-1e300,0,1e-3\n1e300,0,1e-3\n"), "no error");                      // far apart
  std::string many;
  for (int i = 0; i < 60; ++i) many += "0.01,0.01,1e-3\n";
  const std::string all = reported(many);
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 20) << all;
  EXPECT_NE(all.find("39 more bad lines"), all.npos) << all;
}

}  // namespace
}  // namespace phy::io
