// The files are taken apart here as their format says (VTK 9.1's own reader agrees on whole results).
#include "io/vtk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <regex>

namespace phy::io {
namespace {

/// The numbers of one data array, found by its offset in the appended block.
template <class T>
std::vector<T> array_of(const std::string& file, const std::string& name) {
  const std::size_t tag = file.find("Name=\"" + name + "\"");
  if (tag == file.npos) return {};
  const std::string attributes = file.substr(tag, file.find("/>", tag) - tag);
  std::smatch offset;
  std::regex_search(attributes, offset, std::regex("offset=\"([0-9]+)\""));
  const std::string mark = "<AppendedData encoding=\"raw\">\n_";
  const std::size_t raw = file.find(mark) + mark.size() + std::stoul(offset[1]);
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, file.data() + raw, sizeof bytes);
  std::vector<T> values(bytes / sizeof(T));
  if (bytes > 0) std::memcpy(values.data(), file.data() + raw + sizeof bytes, bytes);
  return values;
}

Packing two_discs() {
  Packing p;
  p.discs = {{1.0, 2.0, 0.5}, {3.0, 4.0, 0.25}};
  return p;
}
Snapshot shot() {
  Snapshot s;
  s.grains = {{0.1, 0.2, 0.3}, {-0.1, -0.2, -0.3}};
  s.contacts.push_back({0, 1, ContactKind::joint, true, 5.0, -1.0, {1.0, 0.0}});
  return s;
}

TEST(Vtk, GrainsCarryPresentPlaceRadiusDisplacementAndRotation) {
  const std::string f = grains_vtp(two_discs(), shot());
  EXPECT_THAT(f, testing::HasSubstr("NumberOfPoints=\"2\" NumberOfVerts=\"2\" NumberOfLines=\"0\""));
  EXPECT_EQ(array_of<double>(f, "points"),
            (std::vector<double>{1.0 + 0.1, 2.0 + 0.2, 0.0, 3.0 - 0.1, 4.0 - 0.2, 0.0}));
  EXPECT_EQ(array_of<double>(f, "radius [m]"), (std::vector<double>{0.5, 0.25}));
  EXPECT_EQ(array_of<double>(f, "displacement [m]"), (std::vector<double>{0.1, 0.2, 0.0, -0.1, -0.2, 0.0}));
  EXPECT_EQ(array_of<double>(f, "rotation [rad]"), (std::vector<double>{0.3, -0.3}));
  EXPECT_EQ(array_of<std::int64_t>(f, "connectivity"), (std::vector<std::int64_t>{0, 1}));
  EXPECT_EQ(array_of<std::int64_t>(f, "offsets"), (std::vector<std::int64_t>{1, 2}));
}

TEST(Vtk, ArraysLieInTheFileAsTheyAreNamedWhateverTheCompiler) {
  const std::string f = grains_vtp(two_discs(), shot());
  const std::string data = f.substr(0, f.find("</PointData>"));
  const std::regex offset("offset=\"([0-9]+)\"");
  std::vector<int> offsets;
  for (std::sregex_iterator i(data.begin(), data.end(), offset), end; i != end; ++i)
    offsets.push_back(std::stoi((*i)[1]));
  EXPECT_EQ(offsets.size(), 3U);
  EXPECT_TRUE(std::ranges::is_sorted(offsets));
}

TEST(Vtk, ContactsAreLinesBetweenCentres) {
  const std::string f = contacts_vtp(two_discs(), shot());
  EXPECT_THAT(f, testing::HasSubstr("NumberOfVerts=\"0\" NumberOfLines=\"1\""));
  EXPECT_EQ(array_of<double>(f, "F_n [N/m]"), std::vector<double>{5.0});
  EXPECT_EQ(array_of<double>(f, "F_s [N/m]"), std::vector<double>{-1.0});
  EXPECT_EQ(array_of<std::int64_t>(f, "kind"), std::vector<std::int64_t>{2});
  EXPECT_EQ(array_of<std::int64_t>(f, "broken"), std::vector<std::int64_t>{1});
}

TEST(Vtk, CracksLieAcrossTheirNormal) {
  CrackEvent c;
  c.position = {1.0, 2.0}, c.normal = {0.0, 1.0}, c.size = 0.5;
  c.mode = CrackMode::shear, c.place = CrackPlace::bedding, c.strain = 0.001;
  const std::string f = cracks_vtp({c}, TestKind("uniaxial"));
  EXPECT_EQ(array_of<double>(f, "points"), (std::vector<double>{1.25, 2.0, 0.0, 0.75, 2.0, 0.0}));
  EXPECT_EQ(array_of<std::int64_t>(f, "mode"), std::vector<std::int64_t>{1});
  EXPECT_EQ(array_of<std::int64_t>(f, "place"), std::vector<std::int64_t>{1});
  EXPECT_EQ(array_of<double>(f, "strain"), std::vector<double>{0.001});
  EXPECT_THAT(cracks_vtp({}, TestKind("uniaxial")), testing::HasSubstr("NumberOfPoints=\"0\""));
}

TEST(Vtk, EventsArePointsWithTheirTensor) {
  AcousticEvent e, silent;
  e.magnitude = -7.5, silent.magnitude = -HUGE_VAL;  // ParaView reads no infinity, and 0 is a large event
  const std::string f = events_vtp({e, silent}, TestKind("uniaxial"));
  EXPECT_EQ(array_of<double>(f, "magnitude"), std::vector<double>{-7.5});
  EXPECT_THAT(f, testing::HasSubstr("NumberOfPoints=\"1\" NumberOfVerts=\"1\""));
  EXPECT_THAT(f, testing::HasSubstr("Name=\"moment tensor [N]\" NumberOfComponents=\"9\""));
  EXPECT_THAT(events_vtp({}, TestKind("uniaxial")), testing::HasSubstr("NumberOfPoints=\"0\""));
}

// In direct shear cracks come at a displacement in metres, which is no strain.
TEST(Vtk, CracksOfDirectShearAreFiledUnderADisplacement) {
  CrackEvent c;
  c.strain = 4e-5;
  const std::string f = cracks_vtp({c}, TestKind("direct_shear"));
  EXPECT_EQ(array_of<double>(f, "shear_displacement [m]"), std::vector<double>{4e-5});
  EXPECT_THAT(f, testing::Not(testing::HasSubstr("Name=\"strain\"")));
}

TEST(Vtk, ACollectionNamesFilesByStrain) {
  EXPECT_THAT(collection_pvd({{0.0, "a.vtp"}, {0.001, "b.vtp"}}),
              testing::HasSubstr("<DataSet timestep=\"0.001\" file=\"b.vtp\"/>"));
}

// Of a test that has blown up: ParaView has no place for what is no number.
TEST(Vtk, WhatIsNoNumberIsDrawnAtItsStart) {
  Snapshot blown = shot();
  blown.grains[0] = {std::nan(""), -std::numeric_limits<double>::infinity(), std::nan("")};
  blown.contacts[0].F_n = blown.contacts[0].F_s = std::nan("");
  const std::string grains = grains_vtp(two_discs(), blown), contacts = contacts_vtp(two_discs(), blown);
  EXPECT_EQ(array_of<double>(grains, "points"), (std::vector<double>{1.0, 2.0, 0.0, 2.9, 3.8, 0.0}));
  EXPECT_EQ(array_of<double>(grains, "rotation [rad]"), (std::vector<double>{0.0, -0.3}));
  EXPECT_EQ(array_of<double>(contacts, "F_n [N/m]"), std::vector<double>{0.0});
  EXPECT_EQ(array_of<double>(contacts, "F_s [N/m]"), std::vector<double>{0.0});
}

}  // namespace
}  // namespace phy::io
