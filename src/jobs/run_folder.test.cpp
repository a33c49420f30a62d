// Whose page does a folder have?
#include "jobs/run_folder.hpp"

#include <gmock/gmock.h>

#include "base/in_folder_fixture.hpp"
#include "io/file.hpp"
#include "jobs/folder_lock.hpp"

namespace phy::jobs {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class FolderOfARun : public InFolder {
 protected:
  std::vector<std::string> problems(bool replace = false, const Recipe& recipe = {}) const {
    std::vector<std::string> all;
    for (const Problem& p : run_folder_problems(at("folder"), recipe, "r.toml", replace))
      all.push_back(to_line(p));
    return all;
  }
};

TEST_F(FolderOfARun, HasOnePage) {
  EXPECT_THAT(problems(), IsEmpty()) << "there is none yet";
  io::write_file(at("folder/calibration.json"), "{}");
  EXPECT_THAT(
      problems(),
      ElementsAre(HasSubstr("it holds a calibration, and a run would overwrite its report.html. Choose")));
  EXPECT_THAT(problems(true), ElementsAre(HasSubstr("Choose another --out"))) << "--replace is about results";
  EXPECT_FALSE(problem_of_page(at("folder"), PageOf::calibration));
  EXPECT_TRUE(problem_of_page(at("folder"), PageOf::study));
}

TEST_F(FolderOfARun, IsNotThatOfACalibrationThatWasStopped) {
  io::write_file(at("folder/request.toml"), "");
  EXPECT_THAT(problems(), ElementsAre(HasSubstr("it holds a calibration")));
}

TEST_F(FolderOfARun, TellsHowLongItIsWorkedIn) {
  EXPECT_EQ(seconds_since_lock(folder.string()), 0.0);
  using Time = std::filesystem::file_time_type::clock;
  io::write_file(at(".lock"), "");
  std::filesystem::last_write_time(at(".lock"), Time::now() - std::chrono::hours(1));  // by a run before
  EXPECT_NEAR(seconds_since_lock(folder.string()), 3600.0, 60.0);
  const FolderLock lock(folder.string());
  EXPECT_LT(seconds_since_lock(folder.string()), 60.0);
}

TEST_F(FolderOfARun, IsNotThatOfAStudy) {
  io::write_file(at("folder/study.toml"), "");
  EXPECT_THAT(problems(), ElementsAre(HasSubstr("it holds a study")));
  EXPECT_FALSE(problem_of_page(at("folder"), PageOf::study));
  io::write_file(at("one/specimen/result.json"), "{}");
  EXPECT_TRUE(problem_of_page(at("one"), PageOf::study));
  EXPECT_FALSE(problem_of_page(at("one"), PageOf::run));
}

TEST_F(FolderOfARun, AStressOfAnotherTestIsAMistake) {
  Recipe r;
  r.test.confining_stress = 10e6;
  EXPECT_THAT(problems(false, r), ElementsAre(HasSubstr("or set kind = \"biaxial\"")));
  r.test.kind = TestKind("biaxial");
  EXPECT_THAT(problems(false, r), IsEmpty());
  r.test.normal_stress = 1e6;
  EXPECT_THAT(problems(false, r), ElementsAre(testing::AllOf(HasSubstr("test.normal_stress"),
                                                             HasSubstr("0 with kind = \"biaxial\""))));
}

}  // namespace
}  // namespace phy::jobs
