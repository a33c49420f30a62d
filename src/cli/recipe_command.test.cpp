// The command as users call it: what it prints, and its exit codes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>

#include "base/in_folder_fixture.hpp"
#include "io/file.hpp"
#include "io/toml_in.hpp"
#include "records/recipe_schema.hpp"

namespace phy::cli {
namespace {

using testing::HasSubstr;

struct Answer {
  int code = -1;
  std::string text;  ///< both streams
};

Answer phyllite(const std::string& arguments) {
  Answer a;
  FILE* pipe = ::popen((std::string(PHY_PROGRAM) + " " + arguments + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return a;
  char block[4096];
  for (std::size_t n = 0; (n = std::fread(block, 1, sizeof block, pipe)) > 0;) a.text.append(block, n);
  a.code = WEXITSTATUS(::pclose(pipe));
  return a;
}

TEST(RecipeCommand, ExplainsEveryKeyOfTheSchema) {
  for (const Field& f : recipe_fields()) {
    const Answer a = phyllite("recipe --explain " + f.path());
    EXPECT_EQ(a.code, 0) << f.path();
    EXPECT_THAT(a.text, HasSubstr(f.meaning));
    EXPECT_THAT(a.text, HasSubstr(range_text(f)));
  }
}

TEST(RecipeCommand, ExplainsKeysAsMessagesAndPfcNameThem) {
  EXPECT_THAT(phyllite("recipe --explain 'bedding[0].theta'").text, HasSubstr("0 deg <= value < 180 deg"));
  EXPECT_THAT(phyllite("recipe --explain kratio").text, HasSubstr("matrix.ks_over_kn"));
  const Answer both = phyllite("recipe --explain mu");
  EXPECT_THAT(both.text, HasSubstr("matrix.mu"));
  EXPECT_THAT(both.text, HasSubstr("bedding.mu"));
}

TEST(RecipeCommand, AnUnknownKeyIsRefusedWithTheNearest) {
  const Answer a = phyllite("recipe --explain spacin");
  EXPECT_EQ(a.code, 2);
  EXPECT_THAT(a.text, HasSubstr("did you mean \"spacing\"?"));
  EXPECT_THAT(phyllite("recipe --explain qqqqqqqqqqqqqq").text, HasSubstr("lists all keys"));
  EXPECT_EQ(phyllite("recipe").code, 2);
}

TEST(RecipeCommand, TheTemplateIsThePaperSpecimenAndReadsBack) {
  const Answer a = phyllite("recipe --template");
  EXPECT_EQ(a.code, 0);
  Recipe r;
  r.bedding.resize(1);
  EXPECT_EQ(io::write_recipe(io::parse_recipe(a.text, "template")), io::write_recipe(r));
}

TEST(RecipeCommand, TheReferenceHasARowForEveryKey) {
  const Answer a = phyllite("recipe --reference");
  EXPECT_EQ(a.code, 0);
  for (const Field& f : recipe_fields()) EXPECT_THAT(a.text, HasSubstr("| `" + f.key + "` |"));
  EXPECT_THAT(a.text, HasSubstr("## [[bedding]]"));
}

class RecipeFile : public InFolder {};

TEST_F(RecipeFile, IsCheckedAndCompleted) {
  const std::string path = at("r.toml");
  io::write_file(path, "[matrix]\nmu = 0.7\n");
  const Answer good = phyllite("recipe " + path);
  EXPECT_EQ(good.code, 0);
  EXPECT_EQ(io::parse_recipe(good.text, "out").matrix.mu, 0.7);
  io::write_file(path, "[matrix]\nmu = 700\n");
  const Answer bad = phyllite("recipe " + path);
  EXPECT_EQ(bad.code, 2);
  EXPECT_THAT(bad.text, HasSubstr(path + ":2: matrix.mu = 700: expected 0 <= value <= 10"));
  std::filesystem::remove(path);
  EXPECT_EQ(phyllite("recipe " + path).code, 3);
}

TEST(RecipeCommand, OtherFilesAreExplainedInTheSameWay) {
  for (const auto& [verb, key] : {std::pair{"rock", "elastic_reading"}, std::pair{"study", "times"}}) {
    const std::string word = verb;
    EXPECT_THAT(phyllite(word + " --reference").text, HasSubstr("| `" + std::string(key) + "` |"));
    const Answer a = phyllite(word + " --explain " + key);
    EXPECT_EQ(a.code, 0);
    EXPECT_THAT(a.text, HasSubstr("allowed"));
    EXPECT_EQ(phyllite(word + " --explain " + key + "s").code, 2);
  }
  EXPECT_THAT(phyllite("study --explain intercept").text, HasSubstr("line.intercept"));
}

}  // namespace
}  // namespace phy::cli
