// SPDX-License-Identifier: MIT
#include "app/session/outputs.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <functional>

#include "solver/mesh/output_file.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

using app::Outputs;

TEST(OutputFiles, AreRemovedWhenALaterOneFailsButNotThoseThatWereThere) {
  const TemporaryDirectory folder;
  const std::string old = folder.write("old", "before");
  Outputs outputs;
  ASSERT_TRUE(outputs.expect(old, "-o"));
  ASSERT_TRUE(outputs.expect(folder.path("new"), "-o"));
  ASSERT_TRUE(outputs.expect(folder.path("last"), "-o"));
  EXPECT_TRUE(outputs.write(old, [&] { return write_file(old, "after"); }));
  EXPECT_TRUE(
      outputs.write(folder.path("new"), [&] { return write_file(folder.path("new"), "x"); }));
  const auto failed = outputs.write(folder.path("last"), []() -> Result<void> {
    return Error{ErrorCode::kBadFile, "the disk is full"};
  });
  EXPECT_FALSE(failed);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"old"});
  EXPECT_EQ(bytes_of(old), "after");
}

/// What `check` says in a process that is not the superuser's, to whom nothing is forbidden.
bool holds_without_privileges(const std::function<bool()>& check) {
  constexpr uid_t kNobody = 65534;
  const pid_t child = ::fork();
  if (child == 0) ::_exit((::geteuid() != 0 || ::setuid(kNobody) == 0) && check() ? 0 : 1);
  int status = 1;
  return child > 0 && ::waitpid(child, &status, 0) == child && status == 0;
}

TEST(OutputFiles, InAFolderWithoutPermissionAreRefusedBeforeTheWork) {
  const TemporaryDirectory folder;
  ::chmod(folder.path(".").c_str(), 0755);
  ::mkdir(folder.path("closed").c_str(), 0555);
  EXPECT_TRUE(holds_without_privileges([&] {
    Outputs outputs;
    const auto expected = outputs.expect(folder.path("closed/d.csv"), "-o");
    return !expected && expected.error().code == ErrorCode::kBadFile &&
           sentence(expected.error()).find("Permission denied") != std::string::npos;
  }));
}

TEST(OutputFiles, WithoutPermissionAreRefusedBeforeTheWork) {
  const TemporaryDirectory folder;
  ::chmod(folder.path(".").c_str(), 0755);
  ::chmod(folder.write("d.csv", "x").c_str(), 0444);
  EXPECT_TRUE(holds_without_privileges([&] {
    Outputs outputs;
    return !outputs.expect(folder.path("d.csv"), "-o");
  }));
}

TEST(OutputFiles, ThatFailSayWhatToDo) {
  Outputs outputs;
  ASSERT_TRUE(outputs.expect("/dev/full", "-o"));
  std::string unused;
  const auto failed = outputs.write_text("/dev/full", "x", unused);
  ASSERT_FALSE(failed);
  EXPECT_TRUE(sentence(failed.error()).ends_with("; make room there, or choose another place"))
      << failed.error().message;
}

TEST(OutputFiles, ThatWereMadeAreListedWithoutThoseThatWereThere) {
  const TemporaryDirectory folder;
  const std::string old = folder.write("old", "before");
  const std::string made = folder.path("new");
  Outputs outputs;
  std::string text;
  for (const std::string& path : {old, made, std::string("-")}) {
    ASSERT_TRUE(outputs.expect(path, "-o"));
    ASSERT_TRUE(outputs.write_text(path, "x", text));
  }
  EXPECT_EQ(outputs.made(), std::vector<std::string>{made});
  EXPECT_EQ(text, "x");
}

TEST(OutputFiles, MayUseStandardOutputOnce) {
  Outputs outputs;
  EXPECT_FALSE(outputs.uses_stdout());
  EXPECT_TRUE(outputs.expect("-", "-o"));
  EXPECT_TRUE(outputs.uses_stdout());
  EXPECT_EQ(outputs.expect("-", "--json").error().code, ErrorCode::kBadInput);
}

TEST(OutputFiles, AreFoundToBeTheModelUnderAnotherName) {
  const TemporaryDirectory folder;
  const std::string model = folder.write("m.ply", "x");
  ASSERT_EQ(::symlink(model.c_str(), folder.path("link.ply").c_str()), 0);
  Outputs outputs;
  outputs.protect("", "nothing");
  outputs.protect(model, "the model itself");
  const auto refused = outputs.expect(folder.path("link.ply"), "-o");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kBadInput);
  EXPECT_NE(sentence(refused.error()).find("is the model itself; give"), std::string::npos);
  EXPECT_TRUE(outputs.expect(folder.path("other.ply"), "-o"));
}

TEST(OutputFiles, AreFoundToBeInputsHoweverThoseAreNamed) {
  const TemporaryDirectory folder;
  const std::string mask = folder.write("mask.ply", "x"), frame = folder.write("f_0012.obj", "x");
  folder.write("f_12.obj", "x");
  ASSERT_EQ(::link(mask.c_str(), folder.path("hard.ply").c_str()), 0);
  const auto refuses = [&](const std::string& input, const std::string& output) {
    Outputs outputs;
    outputs.protect(input, "the input");
    return !outputs.expect(folder.path(output), "-o");
  };
  EXPECT_TRUE(refuses(mask, "mask.ply"));
  EXPECT_TRUE(refuses(mask, "hard.ply"));
  EXPECT_FALSE(refuses(mask, "f_12.obj"));
  EXPECT_TRUE(refuses(folder.path("f_%04d.obj"), "f_0012.obj"));
  EXPECT_FALSE(refuses(folder.path("f_%04d.obj"), "f_12.obj")) << "no frame: too few digits";
  EXPECT_FALSE(refuses(folder.path("f_%04d.obj"), "f_0013.obj")) << "there is none";
}

TEST(OutputFiles, BehindALinkIntoNoFolderAreRefusedBeforeTheWork) {
  const TemporaryDirectory folder;
  std::filesystem::create_symlink(folder.path("none/x.csv"), folder.path("link.csv"));
  const auto refused = Outputs().expect(folder.path("link.csv"), "-o");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("there is no folder"), std::string::npos);
}

TEST(OutputFiles, OfOneOptionAreNotThoseOfAnother) {
  const TemporaryDirectory folder;
  const std::string path = folder.write("a.csv", "x");
  app::remember_files({{app::files_named(path).front(), "the file of --pairs", "--pairs"}});
  Outputs outputs;
  const auto refused = outputs.expect(path, "--output");
  EXPECT_TRUE(Outputs().expect(path, "save session")) << "not of the command line";
  EXPECT_TRUE(Outputs().expect(path, "--pairs")) << "its own";
  app::remember_files({});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kBadInput);
  EXPECT_NE(refused.error().message.find("a.csv is the file of --pairs"), std::string::npos);
  EXPECT_TRUE(outputs.expect(path, "--output"));
}

TEST(OutputFiles, BehindALinkAreWrittenWhereItLeads) {
  const TemporaryDirectory folder;
  const std::string link = folder.path("link"), target = folder.path("target");
  ASSERT_EQ(::symlink("target", link.c_str()), 0);  // nothing is there yet
  Outputs outputs;
  ASSERT_TRUE(outputs.expect(link, "-o"));
  std::string unused;
  ASSERT_TRUE(outputs.write_text(link, "x", unused));
  EXPECT_EQ(bytes_of(target), "x");
  struct stat found {};
  ASSERT_EQ(::lstat(link.c_str(), &found), 0);
  EXPECT_TRUE(S_ISLNK(found.st_mode));
  EXPECT_EQ(outputs.made(), std::vector<std::string>{std::filesystem::canonical(target).string()});
}

}  // namespace
}  // namespace geotherm::test
