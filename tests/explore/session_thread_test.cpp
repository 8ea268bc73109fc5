// SPDX-License-Identifier: MIT
// A session whose work runs on threads of its own, as the window uses it. All names hold "Thread",
// so that the thread sanitizer runs them.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "app/session/session_state.h"
#include "tests/explore/session_thread_fixture.h"
#include "tests/support/sanitized.h"
#include "tests/support/source_texts.h"

namespace geotherm::app {
namespace {

using namespace std::chrono_literals;

TEST_F(SessionThread, SubmitReturnsAtOnceAndTheAnswerFollows) {
  ASSERT_TRUE(threaded.submit(command::Open{small_model()}));
  EXPECT_TRUE(threaded.stale());
  ASSERT_TRUE(threaded.finish());
  EXPECT_FALSE(threaded.stale());
  EXPECT_TRUE(threaded.explored().a);
  EXPECT_GT(wakes, 0);
}

TEST_F(SessionThread, TheLatestOfManyWins) {
  ASSERT_TRUE(threaded.submit(command::Open{small_model()}));
  for (int i = 1; i <= 200; ++i) {
    ASSERT_TRUE(threaded.submit(command::Set{"time-factor", std::to_string(i)}));
    ASSERT_TRUE(threaded.submit(command::SetSources{test::sources_in({std::to_string(i)})}));
    threaded.update();
  }
  ASSERT_TRUE(threaded.finish());
  EXPECT_EQ(threaded.explored().a->options.time_step.factor, 200);
  EXPECT_EQ(test::texts_of(threaded.explored().sources), std::vector<std::string>{"200"});
  EXPECT_FALSE(threaded.stale());
}

TEST_F(SessionThread, ThePictureFollowsADrag) {
  ASSERT_TRUE(threaded.submit(command::Open{small_model()}));
  ASSERT_TRUE(threaded.submit(command::SetSources{test::sources_in({"1"})}));
  ASSERT_TRUE(threaded.finish());
  threaded.set_dragging(true);
  int pictures = 0;
  std::uint64_t version = threaded.explored().version;
  for (int i = 0; i < 2000 && pictures < 20; ++i) {
    ASSERT_TRUE(threaded.submit(command::MoveSource{0, VertexList{{1 + i % 300}}}));
    std::this_thread::sleep_for(200us);
    threaded.update();
    pictures += threaded.explored().version != version ? 1 : 0;
    version = threaded.explored().version;
  }
  EXPECT_EQ(pictures, 20) << "queries whose sources alone have changed are let finish";
  threaded.set_dragging(false);
  ASSERT_TRUE(threaded.finish());
  EXPECT_FALSE(threaded.stale());
  EXPECT_GT(threaded.explored().a->result.quality.eikonal_error_mean, 0) << "after the drag";
}

TEST_F(SessionThread, ThePictureFollowsAStroke) {
  ASSERT_TRUE(threaded.submit(command::Open{small_model()}));
  ASSERT_TRUE(threaded.finish());
  const MeshReport& mesh = *threaded.explored().model->mesh;
  const double radius = 0.1 * (mesh.box_max - mesh.box_min).norm();
  threaded.set_dragging(true);
  ASSERT_TRUE(threaded.submit(
      command::Sculpt{{SculptTool::kPull, radius, 0.01, {FacePoint{7, {0.25, 0.25, 0.5}}}}}));
  int pictures = 0;
  auto shown = threaded.explored().model;
  for (int i = 0; i < 4000 && pictures < 10; ++i) {
    ASSERT_TRUE(
        threaded.submit(command::ExtendStroke{{FacePoint{7 + i % 300, {0.25, 0.25, 0.5}}}}));
    std::this_thread::sleep_for(200us);
    threaded.update();
    pictures += threaded.explored().model != shown ? 1 : 0;
    shown = threaded.explored().model;
  }
  EXPECT_EQ(pictures, 10) << "work on a surface that has moved on is let finish";
  threaded.set_dragging(false);
  ASSERT_TRUE(threaded.finish());
  EXPECT_FALSE(threaded.stale());
  run({"open " + small_model()});
  const Command whole = command::Sculpt{*threaded.state().sculpture.strokes.front()};
  ASSERT_TRUE(session.submit(whole));
  EXPECT_TRUE(std::ranges::equal(session.explored().model->model.mesh->positions(),
                                 threaded.explored().model->model.mesh->positions()));
}

TEST_F(SessionThread, AFailureLeavesTheLastGoodAnswer) {
  ASSERT_TRUE(threaded.submit(command::Open{small_model()}));
  ASSERT_TRUE(threaded.finish());
  ASSERT_TRUE(threaded.submit(command::SetSources{test::sources_in({"99999999"})}));
  const auto finished = threaded.finish();
  ASSERT_FALSE(finished);
  EXPECT_NE(threaded.failure(), "");
  EXPECT_TRUE(threaded.explored().a);
  EXPECT_TRUE(threaded.stale());
}

TEST_F(SessionThread, AScriptWaitsForAnswersBeforeItSaves) {
  const std::string path = folder() + "s.geotherm";
  write(path, "open " + small_model() + "\nsource set 7\nsave distances " + folder() +
                  "d.csv\nsource set 8\nsave distances " + folder() + "e.csv\nquit\n");
  ASSERT_TRUE(threaded.submit(command::Run{path}));
  for (int i = 0; i < 10000 && !threaded.quits(); ++i) {
    threaded.update();
    std::this_thread::sleep_for(1ms);
  }
  ASSERT_TRUE(threaded.quits());
  const auto line_of_zero = [](const std::string& file) {
    std::ifstream in(file);
    std::string line;
    while (std::getline(in, line)) {
      if (line.ends_with(",0")) return line;
    }
    return std::string("none");
  };
  EXPECT_EQ(line_of_zero(folder() + "d.csv"), "7,0");
  EXPECT_EQ(line_of_zero(folder() + "e.csv"), "8,0");
}

/// A model on which the nearest of two sources takes a while.
TEST_F(SessionThread, EndsWhileWorkGoesOn) {
  for (int i = 0; i < 20; ++i) {
    SessionHooks hooks;
    hooks.wake = [] {};
    Session short_lived(std::move(hooks));
    ASSERT_TRUE(short_lived.submit(command::Open{small_model()}));
    std::this_thread::sleep_for(std::chrono::microseconds(300 * i));
  }
}

TEST_F(SessionThread, CancelEndsTheWorkAndTheNextCommandStartsItAgain) {
  ASSERT_TRUE(threaded.submit(command::Open{slow_model()}));
  ASSERT_TRUE(threaded.finish());
  ASSERT_TRUE(threaded.submit(command::Set{"time-factor", "2"}));
  threaded.cancel();
  EXPECT_FALSE(threaded.finish()) << "a script that runs would end";
  EXPECT_NE(threaded.failure(), "");
  EXPECT_TRUE(threaded.stale());
  // The same again is a wish to have it tried again.
  ASSERT_TRUE(threaded.submit(command::Set{"time-factor", "2"}));
  ASSERT_TRUE(threaded.finish());
  EXPECT_FALSE(threaded.stale());
  EXPECT_EQ(threaded.failure(), "");
}

TEST_F(SessionThread, CancelOfACheckLeavesTheDistancesAndIsNoFailure) {
  ASSERT_TRUE(threaded.submit(command::Open{slow_model()}));
  while (threaded.stale()) {
    std::this_thread::sleep_for(1ms);
    threaded.update();
  }
  ASSERT_TRUE(threaded.work().busy) << "the check takes longer than the answer";
  threaded.cancel();
  EXPECT_TRUE(threaded.finish());
  EXPECT_EQ(threaded.failure(), "");
  EXPECT_FALSE(threaded.stale());
  EXPECT_FALSE(threaded.explored().a->error);
}

TEST_F(SessionThread, AStudyThatWasCancelledSaysSoAndBeginsAgain) {
  ASSERT_TRUE(threaded.submit(command::Open{slow_model()}));
  ASSERT_TRUE(threaded.finish());
  threaded.study();
  ASSERT_TRUE(threaded.error_study().running);
  threaded.cancel();
  EXPECT_TRUE(threaded.finish());
  EXPECT_TRUE(threaded.error_study().cancelled);
  EXPECT_FALSE(threaded.error_study().running);
  threaded.study();
  EXPECT_TRUE(threaded.error_study().running);
}

TEST_F(SessionThread, AStudyGivesWayToAComparison) {
  ASSERT_TRUE(threaded.submit(command::Open{slow_model()}));
  ASSERT_TRUE(threaded.finish());
  threaded.study();
  ASSERT_TRUE(threaded.submit(command::Compare{"native"}));
  EXPECT_FALSE(threaded.error_study().running);
  ASSERT_TRUE(threaded.finish());
  EXPECT_EQ(threaded.compare().rows.size(), 1U);
  threaded.study();
  EXPECT_TRUE(threaded.error_study().running) << "it begins again";
}

TEST_F(SessionThread, CancelWhileAModelOpensLeavesNoneOpen) {
  ASSERT_TRUE(threaded.submit(command::Open{"gargoyle"}));
  threaded.cancel();
  EXPECT_FALSE(threaded.finish());
  EXPECT_FALSE(threaded.explored().model);
  ASSERT_TRUE(threaded.submit(command::Open{small_model()}));
  ASSERT_TRUE(threaded.finish());
  EXPECT_TRUE(threaded.explored().a);
}

TEST_F(SessionThread, ComparesBesideTheOtherWork) {
  ASSERT_TRUE(threaded.submit(command::Open{small_model()}));
  ASSERT_TRUE(threaded.finish());
  ASSERT_TRUE(threaded.submit(command::Compare{"eigen-ldlt"}));
  EXPECT_TRUE(threaded.compare().running);
  ASSERT_TRUE(threaded.submit(command::SetSources{test::sources_in({"4"})}));
  ASSERT_TRUE(threaded.finish());
  EXPECT_EQ(threaded.compare().rows.size(), 1U);
  EXPECT_EQ(test::texts_of(threaded.explored().sources), std::vector<std::string>{"4"});
}

TEST_F(SessionThread, AComparisonThatIsReplacedSaysNothingAndEndsNoOther) {
  ASSERT_TRUE(threaded.submit(command::Open{small_model()}));
  ASSERT_TRUE(threaded.finish());
  ASSERT_TRUE(threaded.submit(command::Compare{"exact"}));
  threaded.cancel();
  ASSERT_TRUE(threaded.submit(command::Compare{"exact"}));
  ASSERT_TRUE(threaded.submit(command::Compare{"native"}));
  EXPECT_TRUE(threaded.finish());
  ASSERT_EQ(threaded.compare().rows.size(), 1U);
  EXPECT_EQ(threaded.compare().rows[0].backend, "native");
  const auto is_error = [](const LogLine& line) { return line.kind == LogLine::Kind::kError; };
  EXPECT_TRUE(std::ranges::none_of(threaded.log(), is_error));
}

TEST(WorkerThread, KeepsTheLatestOfWhatWaits) {
  std::mutex mutex;
  std::condition_variable changed;
  bool may_go = false;
  std::vector<int> done;
  Worker worker([] {});
  worker.start(
      [&](const Progress&) {
        std::unique_lock lock(mutex);
        changed.wait(lock, [&] { return may_go; });
        done.push_back(0);
      },
      false);
  while (worker.status().stage.empty() && !worker.status().busy) std::this_thread::yield();
  std::this_thread::sleep_for(5ms);  // the first job has begun, or is replaced: both are legal
  for (int i = 1; i <= 10; ++i) {
    worker.start(
        [&, i](const Progress&) {
          const std::lock_guard lock(mutex);
          done.push_back(i);
        },
        false);
  }
  {
    const std::lock_guard lock(mutex);
    may_go = true;
  }
  changed.notify_all();
  worker.wait();
  ASSERT_FALSE(done.empty());
  EXPECT_EQ(done.back(), 10);
  EXPECT_LE(done.size(), 2U);
}

TEST(WorkerThread, AsksAJobToStop) {
  Worker worker([] {});
  std::atomic<bool> running = false, stopped = false;
  worker.start(
      [&](const Progress& progress) {
        running = true;
        while (progress("long", 0.5)) std::this_thread::sleep_for(100us);
        stopped = true;
      },
      false);
  while (!running) std::this_thread::yield();
  worker.cancel();
  worker.wait();
  EXPECT_TRUE(stopped);
}

}  // namespace
}  // namespace geotherm::app
