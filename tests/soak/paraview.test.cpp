// Snapshots as ParaView meets them: VTK's own reader (Debian: python3-vtk9) opens every file of a result.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../program.hpp"

namespace {

class ParaView : public ProgramTest {};

TEST_F(ParaView, OpensEverySnapshot) {
  if (run_line("/usr/bin/python3 -c 'import vtkmodules.vtkIOXML'") != 0)
    GTEST_SKIP() << "not measured: python3-vtk9 is absent";
  ASSERT_EQ(run("run " + small_recipe() + " --out " + out()), 0) << output;
  ASSERT_EQ(run_line("/usr/bin/python3 " PHY_SOURCE_DIR "/tests/soak/read_vtp.py " + out()), 0) << output;
  EXPECT_THAT(output, testing::HasSubstr("3 results"));
}

}  // namespace
