// Is a packing read back bit by bit, and is nothing else ever taken for it?
#include "genesis/cache.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <iterator>

#include "base/hash.hpp"
#include "base/in_folder_fixture.hpp"
#include "genesis/packing.hpp"

namespace phy::genesis {
namespace {

namespace fs = std::filesystem;

class Cache : public InFolder {
 protected:
  void SetUp() override {
    recipe.specimen = {0.005, 0.006};
    recipe.packing.n_grains = 80;
  }

  std::shared_ptr<const Packing> get() const {
    return cached_packing(recipe.specimen, recipe.packing, recipe.matrix, cache);
  }
  std::string key() const { return packing_key(recipe.specimen, recipe.packing, recipe.matrix); }
  fs::path file() const { return cache_file(cache, key()); }
  /// The text in place of the file, with a fingerprint that fits.
  void write_fitting(std::string text) const {
    text.resize(text.rfind("end "));
    Hash h;
    h.add(std::string_view(text));
    write(file(), text + "end " + h.text() + "\n");
  }

  const fs::path cache = folder / "cache";
  Recipe recipe;
};

TEST_F(Cache, GivesBackTheSameBits) {
  EXPECT_FALSE(is_cached(recipe, cache));
  const auto made = get(), kept = get();
  EXPECT_TRUE(is_cached(recipe, cache));
  EXPECT_NE(made, kept);
  EXPECT_EQ(kept->hash, made->hash);
  EXPECT_EQ(packing_hash(kept->discs), made->hash);
  EXPECT_EQ(kept->width, made->width);
  EXPECT_EQ(kept->height, made->height);
  EXPECT_EQ(kept->stress_free, made->stress_free);
  EXPECT_EQ(kept->report.porosity, made->report.porosity);
  EXPECT_EQ(kept->report.coordination, made->report.coordination);
  EXPECT_EQ(kept->report.fabric, made->report.fabric);
  EXPECT_EQ(kept->report.n_rattlers, made->report.n_rattlers);
  EXPECT_EQ(kept->report.unbalanced, made->report.unbalanced);
  EXPECT_EQ(std::distance(fs::directory_iterator(cache), {}), 1);  // no temporary file left
}

// Somebody else may write there, where several people share a cache.
TEST_F(Cache, WhatIsNoFileIsMadeAnewAndNotWaitedFor) {
  const std::string hash = get()->hash;
  ::alarm(60);  // ends the tests where something waits after all
  const std::function<void()> kinds[] = {[&] { ASSERT_EQ(::mkfifo(file().c_str(), 0600), 0); },
                                         [&] { fs::create_symlink("/dev/zero", file()); },
                                         [&] {
                                           write(file(), "x");
                                           fs::resize_file(file(), std::uintmax_t{6} << 30U);
                                         }};
  for (const auto& make : kinds) {
    fs::remove(file());
    make();
    EXPECT_EQ(get()->hash, hash);
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(file())));  // put in its place
    EXPECT_LT(fs::file_size(file()), 1 << 20);
  }
  fs::remove(file());
  fs::create_directory(file());
  EXPECT_FALSE(is_cached(recipe, cache));
  EXPECT_EQ(get()->hash, hash);
  ::alarm(0);
}

TEST_F(Cache, IsReallyRead) {
  get();
  // Another specimen height, with a fitting fingerprint: only reading can tell.
  std::string text = read(file());
  const std::size_t line = text.find('\n', text.find('\n') + 1) + 1;
  const std::size_t height = text.find(' ', line) + 1;
  text.replace(height, text.find(' ', height) - height, "1p+3");
  write_fitting(text);
  EXPECT_EQ(get()->height, 8.0);
}

TEST_F(Cache, TakesNoDiscsThatAreNone) {
  const std::string hash = get()->hash, whole = read(file());
  const std::size_t end = whole.rfind("end "), radius = whole.rfind(' ', end) + 1;
  for (const char* odd : {"nan", "-1p-12", "0", "1p-12"}) {  // the last is one, of another packing
    write_fitting(whole.substr(0, radius) + odd + "\n" + whole.substr(end));
    EXPECT_EQ(get()->hash, hash) << odd;
    EXPECT_EQ(read(file()), whole) << odd;
  }
}

TEST_F(Cache, MakesADamagedFileAnew) {
  const std::string hash = get()->hash, whole = read(file());
  std::string flipped = whole;
  flipped[whole.size() / 2] = flipped[whole.size() / 2] == '1' ? '2' : '1';
  for (const std::string& damaged : {std::string(), whole.substr(0, whole.size() / 2), flipped}) {
    write(file(), damaged);
    EXPECT_EQ(get()->hash, hash);
    EXPECT_EQ(read(file()), whole);
  }
}

TEST_F(Cache, RemovesWhatAKilledProcessHasLeft) {
  get();
  const fs::path dead = file().string() + ".phyllite-part-999999999",
                 alive = file().string() + ".phyllite-part-" + std::to_string(::getppid());
  fs::copy(file(), dead), fs::copy(file(), alive);
  fs::remove(file());
  get();
  EXPECT_FALSE(fs::exists(dead));
  EXPECT_TRUE(fs::exists(alive));
}

TEST_F(Cache, DoesNotTakeAnotherKeysFile) {
  const std::string first_hash = get()->hash;
  const fs::path first = file();
  recipe.packing.seed = 2;
  const std::string second_hash = get()->hash;
  ASSERT_NE(first_hash, second_hash);
  fs::copy_file(first, file(), fs::copy_options::overwrite_existing);
  EXPECT_EQ(get()->hash, second_hash);
}

TEST_F(Cache, UnwritableFolderIsNoError) {
  write(cache, "a file where the folder should be");
  const auto p = get();
  EXPECT_EQ(p->discs.size(), 80U);
  EXPECT_TRUE(fs::is_regular_file(cache));
  EXPECT_FALSE(is_cached(recipe, cache));
  EXPECT_EQ(cached_packing(recipe.specimen, recipe.packing, recipe.matrix, {})->hash, p->hash);
  EXPECT_FALSE(is_cached(recipe, {}));
}

TEST_F(Cache, KeyHoldsWhatTheDiscsDependOn) {
  const std::string stress_free = key();
  recipe.matrix.E_c *= 2.0;
  EXPECT_EQ(key(), stress_free);  // does not move stress-free discs
  recipe.packing.initial_stress = InitialStress::isotropic;
  recipe.packing.isotropic_stress = 1e6;
  const std::string stressed = key();
  EXPECT_NE(stressed, stress_free);
  recipe.matrix.E_c *= 2.0;
  EXPECT_NE(key(), stressed);
  const std::string before = key();
  recipe.packing.radius_max *= 1.0 + 1e-15;
  EXPECT_NE(key(), before);
}

TEST(CacheFolder, FollowsTheEnvironment) {
  ::setenv("XDG_CACHE_HOME", "/somewhere", 1);
  EXPECT_EQ(default_cache_folder(), "/somewhere/phyllite");
  ::setenv("XDG_CACHE_HOME", "not/absolute", 1);
  ::setenv("HOME", "/home/geo", 1);
  EXPECT_EQ(default_cache_folder(), "/home/geo/.cache/phyllite");
  ::unsetenv("HOME");
  EXPECT_TRUE(default_cache_folder().empty());
}

}  // namespace
}  // namespace phy::genesis
