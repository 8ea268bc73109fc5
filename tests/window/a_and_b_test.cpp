// SPDX-License-Identifier: MIT
#include "tests/window/played_window.h"

namespace geotherm::test {
namespace {

class AAndB : public PlayedWindow {
 protected:
  Picture now() {
    move_to(kPanel);
    return canvas_on_screen();
  }
};

TEST_F(AAndB, TabFlipsAndTheDifferenceIsAnotherPicture) {
  start({"bunny", "-s", "17"});
  press("k");
  run({"time-factor 100"});
  const Picture a = now();
  press("Tab");
  const Picture b = now();
  press("Tab");
  const Picture again = now();
  press("d");
  const Picture difference = now();
  EXPECT_LE(share_that_differs(a, again), kSamePicture);
  EXPECT_GT(share_that_differs(a, b), kSamePicture);
  EXPECT_GT(share_that_differs(a, difference), kSamePicture);
  EXPECT_GT(share_that_differs(b, difference), kSamePicture);
  quit();
}

}  // namespace
}  // namespace geotherm::test
