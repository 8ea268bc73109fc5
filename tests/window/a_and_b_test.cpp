// SPDX-License-Identifier: MIT
#include "tests/window/played_window.h"

namespace geotherm::test {
namespace {

using AAndB = PlayedWindow;

TEST_F(AAndB, TabFlipsAndTheDifferenceIsAnotherPicture) {
  start({"bunny", "-s", "17"});
  press("k");
  run({"time-factor 100"});
  const Picture a = canvas_on_screen();
  press("Tab");
  const Picture b = canvas_on_screen();
  press("Tab");
  const Picture again = canvas_on_screen();
  press("d");
  const Picture difference = canvas_on_screen();
  EXPECT_LE(share_that_differs(a, again), kSamePicture);
  EXPECT_GT(share_that_differs(a, b), kSamePicture);
  EXPECT_GT(share_that_differs(a, difference), kSamePicture);
  EXPECT_GT(share_that_differs(b, difference), kSamePicture);
  quit();
}

}  // namespace
}  // namespace geotherm::test
