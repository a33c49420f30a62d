#include "jobs/study_folder.hpp"

#include <gmock/gmock.h>

#include "base/in_folder_fixture.hpp"
#include "io/file.hpp"
#include "jobs/another_recipe.hpp"
#include "study/study_in.hpp"

namespace phy::jobs {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(AnotherRecipe, IsToldBySixLinesAtMost) {
  std::vector<study::RecipeDifference> differences;
  for (int i = 0; i < 6; ++i) differences.push_back({"key " + std::to_string(i), "a", "b"});
  EXPECT_EQ(problems_of("place", differences, "as in x.toml", "do this").size(), 6u);
  differences.push_back({"key 6", "a", "b"});
  const std::vector<Problem> seven = problems_of("place", differences, "as in x.toml", "do this");
  ASSERT_EQ(seven.size(), 6u);
  EXPECT_EQ(to_line(seven.front()), "place: key 0 = a: expected b, as in x.toml; do this");
  EXPECT_EQ(to_line(seven.back()), "place: 2 other keys: expected as in x.toml; do this");
}

class FolderOfAStudy : public InFolder {
 protected:
  /// Three specimens of some hundred discs; `set` and `speeds` as in the file.
  study::Study made(const std::string& name, const std::string& set, const std::string& speeds) const {
    io::write_file(at("base.toml"),
                   "[[bedding]]\nspacing = \"8 mm\"\n[test]\nangles = [\"0 deg\", \"45 deg\", \"90 deg\"]\n");
    io::write_file(at("asked.toml"), "name = \"" + name + "\"\nrecipe = \"base.toml\"\n[set]\n" + set +
                                         "\n[by_angle]\n\"test.platen_speed\" = " + speeds +
                                         "\n[[vary]]\nkey = \"bedding.mu\"\nvalues = [0.2]\n");
    return study::read_study(at("asked.toml"));
  }
  std::string refusal(const study::Study& wanted) const {
    return message_of<InputError>([&] { refuse_other_study(wanted, at("folder")); });
  }
};

TEST_F(FolderOfAStudy, TellsAllThatDiffers) {
  const std::string mu = "\"matrix.mu\" = 0.5", speeds = "[\"0.1 m/s\", \"0.2 m/s\", \"0.3 m/s\"]";
  const study::Study first = made("first", mu, speeds);
  for (const auto& [name, content] : study::study_files(first)) io::write_file(at("folder/" + name), content);
  EXPECT_NO_THROW(refuse_other_study(first, at("folder")));
  EXPECT_THAT(
      refusal(made("second", "\"matrix.mu\" = 0.6\n\"test.stop_at\" = 0.5",
                   "[\"0.1 m/s\", \"0.25 m/s\", \"0.35 m/s\"]")),
      AllOf(HasSubstr("name = first: expected second"), HasSubstr("matrix.mu = 0.5: expected 0.6"),
            HasSubstr("test.stop_at"),
            HasSubstr("test.platen_speed at theta = 45 deg = \"0.2 m/s\": expected \"0.25 m/s\" (1 more "
                      "specimen(s) differ)"),
            Not(HasSubstr("test.stop_at at theta"))));
}

}  // namespace
}  // namespace phy::jobs
