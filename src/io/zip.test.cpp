// Archives that libzip writes, and damaged ones.
#include "io/zip.hpp"

#include <gtest/gtest.h>
#include <zip.h>

#include "base/in_folder_fixture.hpp"
#include "io/file.hpp"

namespace phy::io {
namespace {

class Zip : public InFolder {
 protected:
  const std::string text = "UCS,105,12\n" + std::string(5000, 'x') + "\n";

  std::string made(zip_int32_t method, const char* comment = nullptr) const {
    zip_t* zip = zip_open(at("a.zip").c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
    for (const auto* name : {"first.txt", "xl/b.xml"}) {
      const auto i = zip_file_add(zip, name, zip_source_buffer(zip, text.data(), text.size(), 0), 0);
      zip_set_file_compression(zip, static_cast<zip_uint64_t>(i), method, 0);
    }
    if (comment != nullptr)
      zip_set_archive_comment(zip, comment, static_cast<zip_uint16_t>(std::string(comment).size()));
    EXPECT_EQ(zip_close(zip), 0);
    return read_file(at("a.zip"));
  }
};

TEST_F(Zip, ReadsWhatIsStoredAndWhatIsDeflated) {
  const std::string stored = made(ZIP_CM_STORE), deflated = made(ZIP_CM_DEFLATE, "a comment behind all");
  EXPECT_GT(stored.size(), 2 * text.size());
  EXPECT_LT(deflated.size(), text.size());
  for (const std::string& bytes : {stored, deflated}) {
    const ZipArchive archive(bytes);
    EXPECT_EQ(archive.read("xl/b.xml", text.size()), text);
    EXPECT_TRUE(archive.has("first.txt"));
    EXPECT_FALSE(archive.has("b.xml"));
    EXPECT_FALSE(archive.read("b.xml", text.size()));
    EXPECT_FALSE(archive.read("first.txt", text.size() - 1)) << "larger than it may be";
  }
}

TEST_F(Zip, GivesTheTextOrNothingOfAnArchiveThatWasCutOrChanged) {
  const std::string bytes = made(ZIP_CM_DEFLATE);
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    EXPECT_FALSE(ZipArchive(std::string_view(bytes).substr(0, n)).has("first.txt")) << n;
    std::string changed = bytes;
    changed[n] = static_cast<char>(changed[n] ^ 0x55);
    const auto read = ZipArchive(changed).read("xl/b.xml", text.size());
    EXPECT_TRUE(!read || *read == text) << n;
  }
}

TEST_F(Zip, HoldsNothingOfWhatIsNoArchive) {
  for (const std::string& bytes : {std::string(), std::string(21, 'P'), text, std::string(100, '\0')})
    EXPECT_FALSE(ZipArchive(bytes).has(""));
}

}  // namespace
}  // namespace phy::io
