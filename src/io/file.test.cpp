// Files: whole or not at all, and every failure told with its remedy.
#include "io/file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <thread>

#include "base/check.hpp"
#include "base/in_folder_fixture.hpp"
#include "base/parallel.hpp"
#include "io/new_folder.hpp"
#include "io/output.hpp"

namespace phy::io {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class Files : public InFolder {
 protected:
  std::ptrdiff_t n_entries() const { return std::distance(fs::directory_iterator(folder), {}); }
};

TEST_F(Files, AreReadBackByteByByte) {
  std::string all;
  for (int i = 0; i < 200000; ++i) all += static_cast<char>(i * 7 % 256);
  write_file(at("a/b/c.bin"), all);
  EXPECT_EQ(read_file(at("a/b/c.bin")), all);
  write_file(at("a/b/c.bin"), "");
  EXPECT_EQ(read_file(at("a/b/c.bin")), "");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "a" / "b"), {}), 1);
}

// As root a rename would put a file in the place of the device itself.
TEST_F(Files, APipeIsWrittenToAndStays) {
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  EXPECT_TRUE(is_stream(at("pipe")));
  std::jthread writer([&] { write_output(at("pipe"), "through the pipe"); });
  EXPECT_EQ(read(at("pipe")), "through the pipe");
  writer.join();
  EXPECT_TRUE(fs::is_fifo(at("pipe")));
  EXPECT_EQ(n_entries(), 1);
  for (const char* name : {"/dev/stdout", "/dev/null"}) EXPECT_TRUE(is_stream(name)) << name;
  write_file(at("file"), "x");
  for (const std::string& name : {at("file"), at("none"), folder.string()})
    EXPECT_FALSE(is_stream(name)) << name;
}

TEST_F(Files, AFolderIsListedInOrder) {
  for (const char* name : {"b", "a", "c"}) write_file(at(name), "");
  EXPECT_EQ(list_folder(folder.string()), (std::vector<std::string>{at("a"), at("b"), at("c")}));
  EXPECT_THAT(message_of<IoError>([&] { list_folder(at("none")); }), HasSubstr("check the name"));
  EXPECT_THAT(message_of<IoError>([&] { list_folder(at("a")); }), HasSubstr("name a folder"));
}

TEST_F(Files, AFileInTheWayIsToldWithARemedy) {
  write_file(at("file"), "x");
  for (const char* name : {"file/out", "file"})
    EXPECT_THAT(message_of<IoError>([&] { check_writable(at(name)); }),
                HasSubstr("a file of that name is in the way"));
  EXPECT_THAT(message_of<IoError>([&] { write_file(at("file/x"), ""); }),
              HasSubstr("a file of that name is in the way"));
}

TEST_F(Files, AFullDiskLeavesNothingBehind) {
  fs::create_symlink("/dev/full", at("full.csv"));
  const std::string message = message_of<IoError>([&] { write_output(at("full.csv"), "some text"); });
  EXPECT_THAT(message, HasSubstr("free some space"));
  EXPECT_THAT(message, HasSubstr(at("full.csv") + ": cannot be written"));
  // As a disk that is full after four bytes.
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{4, before.rlim_max};
  const auto usual = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string cut = message_of<IoError>([&] { write_file(at("cut.csv"), "some text"); });
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, usual);
  EXPECT_THAT(cut, HasSubstr(at("cut.csv") + ": cannot be written"));
  EXPECT_EQ(n_entries(), 1) << "the link";
}

// A name of that form can be foreseen.
TEST_F(Files, WhatStandsUnderATemporaryNameIsNotOpened) {
  write_file(at("target"), "mine");
  fs::create_symlink(at("target"), at("a.phyllite-part-" + std::to_string(::getpid())));
  write_file(at("a"), "text");
  EXPECT_EQ(read(at("target")), "mine");
  EXPECT_EQ(read(at("a")), "text");
  EXPECT_FALSE(fs::is_symlink(at("a")));
}

TEST_F(Files, ThreadsMayWriteTheSameFile) {
  const std::string text(100000, 'x');
  for_all(200, 4, [&] {
    return [&](std::size_t) {
      write_file(at("same"), text);
      ASSERT_EQ(read_file(at("same")), text);
    };
  });
  EXPECT_EQ(n_entries(), 1);
}

TEST_F(Files, AReadOnlyFolderIsToldWithARemedy) {
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_exec);
  const bool root = ::geteuid() == 0;  // root may write everywhere: be somebody else for a moment
  if (root) {
    ASSERT_EQ(::seteuid(65534), 0);
  }
  const std::string check = message_of<IoError>([&] { check_writable(folder.string()); });
  const std::string result = message_of<IoError>([&] { NewFolder(at("x"), "mark", "thing"); });
  if (root) {
    ASSERT_EQ(::seteuid(0), 0);
  }
  EXPECT_THAT(check, HasSubstr("check the permissions"));
  EXPECT_THAT(result, HasSubstr("check the permissions"));
}

// /proc refuses new files to everybody, root included.
TEST_F(Files, AFolderThatTakesNoFilesIsFoundBeforehand) {
  const std::string message = message_of<IoError>([] { check_writable("/proc"); });
  EXPECT_THAT(message, HasSubstr("/proc: cannot be written"));
}

TEST_F(Files, WhatCannotBeReadIsTold) {
  EXPECT_THAT(message_of<IoError>([&] { read_file(at("none")); }), HasSubstr("check the name"));
  EXPECT_THAT(message_of<IoError>([&] { read_file(folder.string()); }),
              HasSubstr("name a file, not a folder"));
  EXPECT_THAT(message_of<IoError>([] { read_file("/dev/zero"); }), HasSubstr("cannot be read"));
}

/// Ends the tests where something waits after all.
struct Deadline {
  Deadline() { ::alarm(60); }
  ~Deadline() { ::alarm(0); }
};

TEST_F(Files, WhatIsNoFileIsRefusedByItsKindAndNotWaitedFor) {
  const Deadline deadline;
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  sockaddr_un place{};
  place.sun_family = AF_UNIX;
  at("socket").copy(place.sun_path, sizeof place.sun_path - 1);
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(::bind(socket, reinterpret_cast<sockaddr*>(&place), sizeof place), 0);
  fs::create_symlink("/dev/zero", at("zero"));
  fs::create_symlink(at("pipe"), at("link"));
  const std::pair<std::string, std::string> kinds[] = {{at("pipe"), "it is a named pipe, not a file"},
                                                       {at("link"), "it is a named pipe, not a file"},
                                                       {at("socket"), "it is a socket, not a file"},
                                                       {at("zero"), "it is a device, not a file"},
                                                       {folder.string(), "name a file, not a folder"}};
  for (const auto& [name, kind] : kinds) {
    EXPECT_THAT(message_of<IoError>([&] { read_file(name); }), HasSubstr(kind)) << name;
    EXPECT_THAT(message_of<IoError>([&] { refuse_unless_file(name); }), HasSubstr(kind)) << name;
    EXPECT_EQ(read_if_file(name), std::nullopt) << name;
  }
  EXPECT_NO_THROW(refuse_unless_file(at("none")));
  ::close(socket);
}

// Sparse: it has no blocks, and reading even a part of it would show in the memory.
TEST_F(Files, TheSizeIsKnownBeforeReading) {
  write_file(at("large"), "x");
  fs::resize_file(at("large"), std::uintmax_t{6} << 30U);
  rusage before{}, after{};
  ::getrusage(RUSAGE_SELF, &before);
  EXPECT_THAT(message_of<IoError>([&] { read_file(at("large")); }),
              AllOf(HasSubstr("it has 6144 MB"), HasSubstr("1024 MB")));
  EXPECT_EQ(read_if_file(at("large")), std::nullopt);
  ::getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 64 << 10);  // KiB
  EXPECT_EQ(InputFile(at("large")).read((std::size_t{6} << 30U) - 3, 10), std::string(3, '\0'));
  write_file(at("ten"), "0123456789");
  EXPECT_EQ(read_file(at("ten"), 10), "0123456789");
  EXPECT_THAT(message_of<IoError>([&] { read_file(at("ten"), 9); }), HasSubstr("cannot be read"));
  EXPECT_EQ(InputFile(at("ten")).read(4, 3), "456");
  EXPECT_EQ(InputFile(at("ten")).read(11, 3), "");
}

// Under a name that the program chooses.
TEST_F(Files, AFileTakesThePlaceOfAPipeAndOfALinkButNotOfItsTarget) {
  const Deadline deadline;
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  write_file(at("target"), "mine");
  fs::create_symlink(at("target"), at("link"));
  write_file(at("pipe"), "a"), write_file(at("link"), "b");
  EXPECT_EQ(read(at("pipe")), "a");
  EXPECT_EQ(read(at("link")), "b");
  EXPECT_EQ(read(at("target")), "mine");
  fs::remove(at("pipe"));
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  write_passing(at("pipe"), "c");
  EXPECT_EQ(read(at("pipe")), "c");
  EXPECT_EQ(n_entries(), 3);
}

TEST_F(Files, APipeThatNobodyReadsIsTold) {
  const Deadline deadline;
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  EXPECT_THAT(message_of<IoError>([&] { write_output(at("pipe"), "x"); }), HasSubstr("nobody reads"));
}

TEST_F(Files, AListThatIsAPipeIsPassedOver) {
  const Deadline deadline;
  ASSERT_EQ(::mkfifo(at(written_list).c_str(), 0600), 0);
  write_output(at("a"), "text");
  EXPECT_EQ(read(at("a")), "text");
  EXPECT_EQ(read_written(at("a")), "text");
  // And so is one in the place of what a killed process has left.
  ASSERT_EQ(::mkfifo(at("a.phyllite-part-99999999").c_str(), 0600), 0);
  remove_leftovers(folder.string());
  EXPECT_FALSE(fs::exists(at("a.phyllite-part-99999999")));
}

TEST_F(Files, ANewFolderAppearsWholeOrNotAtAll) {
  {
    NewFolder made(at("x"), "mark", "thing");
    made.add("sub/a", "1");
    made.add("mark", "");
    EXPECT_FALSE(fs::exists(folder / "x"));
  }
  EXPECT_EQ(n_entries(), 0) << "not published: nothing is left";
  NewFolder made(at("x/"), "mark", "thing");
  made.add("sub/a", "1");
  made.add("mark", "");
  made.publish();
  EXPECT_EQ(read_file(at("x/sub/a")), "1");
  EXPECT_EQ(n_entries(), 1);
}

TEST_F(Files, AnOlderFolderIsExchangedAndRemoved) {
  for (const char* content : {"old", "new"}) {
    NewFolder made(at("x"), "mark", "thing");
    made.add("mark", content);
    if (content[0] == 'o') made.add("only-old", "");
    made.publish();
  }
  EXPECT_EQ(read_file(at("x/mark")), "new");
  EXPECT_FALSE(fs::exists(folder / "x" / "only-old"));
  EXPECT_EQ(n_entries(), 1);
}

TEST_F(Files, AFolderIsRemovedWithAllThatIsInIt) {
  write_file(at("old/deep/file"), "x");
  remove_folder(at("old"));
  EXPECT_TRUE(fs::is_empty(folder));
  EXPECT_THROW(remove_folder(at("old")), IoError);
}

TEST_F(Files, AFailureKeepsTheOlderFolder) {
  const auto make = [&](const char* content) {
    NewFolder made(at("x"), "mark", "thing");
    made.add("mark", content);
    made.add("mark/below-a-file", "");
    made.publish();
  };
  write_file(at("x/mark"), "old");
  EXPECT_THAT(message_of<IoError>([&] { make("new"); }), HasSubstr("in the way"));
  EXPECT_EQ(read_file(at("x/mark")), "old");
  EXPECT_EQ(n_entries(), 1);
}

TEST_F(Files, ForeignFoldersAndFilesAreNotReplaced) {
  write_file(at("thesis/chapter1.tex"), "years of work");
  write_file(at("file"), "x");
  EXPECT_THAT(message_of<IoError>([&] { NewFolder(at("thesis"), "mark", "thing"); }),
              HasSubstr("holds no thing (no mark)"));
  EXPECT_THAT(message_of<IoError>([&] { NewFolder(at("file"), "mark", "thing"); }), HasSubstr("in the way"));
  EXPECT_EQ(read_file(at("thesis/chapter1.tex")), "years of work");
  fs::create_directories(folder / "empty");
  NewFolder made(at("empty"), "mark", "thing");
  made.add("mark", "");
  made.publish();
  EXPECT_TRUE(fs::exists(folder / "empty" / "mark"));
}

}  // namespace
}  // namespace phy::io
