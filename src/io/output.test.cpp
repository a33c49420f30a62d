// What is replaced and what stays? (tests/failure/own_files.test.cpp asks every verb.)
#include "io/output.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/check.hpp"
#include "base/in_folder_fixture.hpp"
#include "io/file.hpp"

namespace phy::io {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Outputs : public InFolder {
 protected:
  bool is_refused(const std::string& name) const {
    return message_of<InputError>([&] { check_outputs({at(name)}); }) != "no error";
  }
};

TEST_F(Outputs, OfTheProgramAreReplacedAsLongAsNobodyChangesThem) {
  for (const char* content : {"first", "second", "second", "first"}) {
    EXPECT_FALSE(is_refused("new/a"));
    write_output(at("new/a"), content);
    EXPECT_EQ(read(at("new/a")), content);
  }
  const std::string list = read(folder / "new" / written_list);
  EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), 2) << "each content once: " << list;
  write("new/a", "third");
  EXPECT_TRUE(is_refused("new/a"));
  EXPECT_THROW(write_output(at("new/a"), "fourth"), IoError);
  EXPECT_EQ(read(at("new/a")), "third");
}

TEST_F(Outputs, AnotherNameOrPlaceIsNotTheFileThatWasWritten) {
  write_output(at("a"), "text");
  fs::copy(folder / "a", folder / "b");
  fs::create_directories(folder / "sub");
  fs::copy(folder / "a", folder / "sub/a");
  fs::create_symlink(folder / "none", folder / "dangling");
  for (const char* name : {"b", "sub/a", "dangling", "sub"}) EXPECT_TRUE(is_refused(name)) << name;
  write_output(at("b"), "text");  // nothing to change, so nothing to refuse
  EXPECT_TRUE(is_refused("b"));
}

TEST_F(Outputs, WhatWasReadStaysByWhateverName) {
  write_output(at("a"), "text");
  fs::create_hard_link(folder / "a", folder / "hard");
  fs::create_symlink(folder / "a", folder / "soft");
  EXPECT_FALSE(was_read(at("hard")));
  EXPECT_EQ(read_file(at("a")), "text");
  for (const char* name : {"a", "hard", "soft"}) {
    EXPECT_TRUE(was_read(at(name))) << name;
    EXPECT_THAT(message_of<InputError>([&] { check_outputs({at(name)}); }), HasSubstr("those that are read"));
  }
}

TEST_F(Outputs, AllInTheWayAreToldAndStreamsNever) {
  write("a", ""), write("b", "");
  const std::string message = message_of<InputError>([&] {
    check_outputs({at("a"), at("free"), "/dev/stdout", "/dev/null", at("b")}, "csv");
  });
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << message;
  EXPECT_THAT(message, testing::AllOf(HasSubstr("--csv = " + at("a")), HasSubstr("--csv = " + at("b")),
                                      HasSubstr("or use another --csv")));
}

}  // namespace
}  // namespace phy::io
