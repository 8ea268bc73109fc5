// SPDX-License-Identifier: MIT
// Distances that a session writes while it goes on.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <string>
#include <thread>

#include "tests/explore/session_thread_fixture.h"
#include "tests/support/source_texts.h"

namespace geotherm::app {
namespace {

class SessionThreadSaves : public SessionThread {
 protected:
  void begin() {
    ASSERT_TRUE(threaded.submit(command::Open{small_model()}));
    ASSERT_TRUE(threaded.submit(command::SetSources{test::sources_in({"7", "190"})}));
    ASSERT_TRUE(threaded.finish());
  }
  /// A name that no file can have, which only writing finds.
  std::string too_long() const { return folder() + std::string(300, 'd') + ".ply"; }
  bool is_there(const std::string& name) const { return std::filesystem::exists(folder() + name); }
  std::string bytes_of(const std::string& name) const {
    std::ifstream file(folder() + name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
};

TEST_F(SessionThreadSaves, WriteWhatWasShownWhileTheSessionGoesOn) {
  begin();
  std::unique_lock held(gate);
  ASSERT_TRUE(threaded.submit(command::SaveDistances{folder() + "a.ply"}));
  EXPECT_TRUE(threaded.work().busy);
  ASSERT_TRUE(threaded.submit(command::SaveDistances{folder() + "a.csv"}));
  EXPECT_FALSE(threaded.submit(command::SaveMesh{folder() + "a.csv"})) << "it would be replaced";
  EXPECT_FALSE(threaded.submit(command::Open{folder() + "a.ply"}));
  EXPECT_FALSE(is_there("a.ply"));
  held.unlock();
  ASSERT_TRUE(threaded.submit(command::SetSources{test::sources_in({"4"})}));
  ASSERT_TRUE(threaded.finish());
  EXPECT_EQ(test::texts_of(threaded.explored().sources), std::vector<std::string>{"4"});
  run({"open " + small_model(), "source set 7 190", "save distances " + folder() + "b.ply",
       "save distances " + folder() + "b.csv"});
  EXPECT_FALSE(bytes_of("b.ply").empty());
  EXPECT_EQ(bytes_of("a.ply"), bytes_of("b.ply"));
  EXPECT_EQ(bytes_of("a.csv"), bytes_of("b.csv"));
}

TEST_F(SessionThreadSaves, HoldBackTheEnd) {
  begin();
  for (const char* const name : {"a.ply", "b.vtp"}) {
    ASSERT_TRUE(threaded.submit(command::SaveDistances{folder() + name}));
  }
  ASSERT_TRUE(threaded.submit(command::Quit{}));
  EXPECT_FALSE(threaded.quits());
  ASSERT_TRUE(threaded.finish());
  EXPECT_TRUE(threaded.quits());
  EXPECT_TRUE(is_there("a.ply") && is_there("b.vtp"));
}

TEST_F(SessionThreadSaves, ThatFailAreSeenBeforeTheEnd) {
  begin();
  ASSERT_TRUE(threaded.submit(command::SaveDistances{too_long()}));
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(threaded.submit(command::Quit{}));
  const auto finished = threaded.finish();
  ASSERT_FALSE(finished);
  EXPECT_FALSE(threaded.quits()) << "its user would not see why there is no file";
  for (const char* const word : {"save", "quit"}) {
    EXPECT_EQ(threaded.script().find(word), std::string::npos) << threaded.script();
  }
  run({"open " + small_model(), "source set 7 190"});
  EXPECT_EQ(sentence(finished.error()), refused("save distances " + too_long()));
}

TEST_F(SessionThreadSaves, OfAUserThatFailEndNoScript) {
  begin();
  write(folder() + "s.geotherm", "time-factor 2\n");
  std::unique_lock held(gate);
  ASSERT_TRUE(threaded.submit(command::SaveDistances{too_long()}));
  ASSERT_TRUE(threaded.submit(command::Run{folder() + "s.geotherm"}));
  held.unlock();
  EXPECT_TRUE(threaded.finish());
  EXPECT_EQ(threaded.state().options.time_step.factor, 2);
}

TEST_F(SessionThreadSaves, EndAScriptAsWithoutThreads) {
  const std::string path = folder() + "s.geotherm";
  const std::string lines = "open " + small_model() + "\nsource set 7 190\nsave distances " +
                            folder() + "a.ply\nsave distances " + too_long() +
                            "\nsource set 8\nquit\n";
  write(path, lines);
  ASSERT_TRUE(threaded.submit(command::Run{path}));
  const auto finished = threaded.finish();
  ASSERT_FALSE(finished);
  EXPECT_TRUE(is_there("a.ply"));
  std::filesystem::remove(folder() + "a.ply");
  const auto ran = session.submit(command::Run{path});
  ASSERT_FALSE(ran);
  EXPECT_EQ(sentence(finished.error()), sentence(ran.error()));
  EXPECT_EQ(threaded.script(), session.script());
  EXPECT_EQ(threaded.state(), session.state()) << "lines behind the one that fails are left out";
  EXPECT_FALSE(threaded.quits());
  EXPECT_EQ(threaded.log().back().text, session.log().back().text);
}

TEST_F(SessionThreadSaves, AreCancelledAndBeginAgain) {
  begin();
  for (const bool begun : {false, true}) {
    const std::size_t said = threaded.log().size();
    std::unique_lock held(gate);
    for (const char* const name : {"a.ply", "b.ply", "c.csv"}) {
      ASSERT_TRUE(threaded.submit(command::SaveDistances{folder() + name}));
    }
    while (begun && threaded.work().stage.empty()) std::this_thread::yield();
    threaded.cancel();
    held.unlock();
    const auto finished = threaded.finish();
    ASSERT_FALSE(finished);
    EXPECT_EQ(finished.error().code, ErrorCode::kCancelled);
    EXPECT_FALSE(is_there("a.ply") || is_there("b.ply") || is_there("c.csv"));
    const auto is_error = [](const LogLine& line) { return line.kind == LogLine::Kind::kError; };
    EXPECT_EQ(std::ranges::count_if(threaded.log().subspan(said), is_error), 3) << "each is named";
  }
  EXPECT_FALSE(threaded.stale()) << "what is shown is right";
  EXPECT_EQ(threaded.failure(), "");
  ASSERT_TRUE(threaded.submit(command::SaveDistances{folder() + "a.ply"}));
  ASSERT_TRUE(threaded.finish());
  EXPECT_TRUE(is_there("a.ply"));
}

}  // namespace
}  // namespace geotherm::app
