// SPDX-License-Identifier: MIT
#include <filesystem>
#include <fstream>
#include <string>

#include "app/session/session.h"
#include "app/window/scene_screen.h"
#include "app/window/window_loop.h"
#include "tests/engine/gpu_fixture.h"

namespace geotherm::test {
namespace {

constexpr std::uint64_t kMiB = 1U << 20U;
constexpr glm::ivec2 kExtent{120, 90};

TEST(PanelScale, IsTakenOnceWhereAPointHasItsPixels) {
  EXPECT_EQ(app::panel_scale(2, 1), 2);  // X11
  EXPECT_EQ(app::panel_scale(2, 2), 1);  // Wayland
  EXPECT_EQ(app::panel_scale(1, 1), 1);
  EXPECT_EQ(app::panel_scale(1.5F, 1501.0F / 1001), 1);  // pixels are whole
}

class Screen : public GpuTest {
 protected:
  /// Opens a flat sheet of so many cells.
  void open(int columns, int rows) {
    const auto path = std::filesystem::path(testing::TempDir()) /
                      ("geotherm_sheet_" + std::to_string(columns) + ".obj");
    std::ofstream file(path);
    for (int i = 0; i < (columns + 1) * (rows + 1); ++i) {
      file << "v " << i % (columns + 1) * 4.0 / columns << ' ' << i / (columns + 1) * 3.0 / rows
           << " 0\n";
    }
    for (int i = 0; i < columns * rows; ++i) {
      const int a = 1 + i % columns + i / columns * (columns + 1), b = a + columns + 1;
      file << "f " << a << ' ' << a + 1 << ' ' << b << '\n';
      file << "f " << b + 1 << ' ' << b << ' ' << a + 1 << '\n';
    }
    file.close();
    must(session_.submit(app::command::Open{path.string()}));
    std::filesystem::remove(path);
  }

  app::Session session_;
};

TEST_F(Screen, KeepsItsPictureWhereTheDeviceHasNoMemoryForAnother) {
  const auto screen = must(app::SceneScreen::open_without_window(kExtent, validated(5 * kMiB)));
  const app::PictureArea area{{0, 0}, kExtent};
  const auto pixels = [&] { return must(screen->picture_of_window(kExtent, {})).pixels; };
  open(4, 3);
  must(screen->update(session_, area));
  const auto before = pixels();

  open(400, 300);
  const Result<void> refused = screen->update(session_, area);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kOutOfMemory);
  EXPECT_EQ(pixels(), before);
  // It stays one: a picture that is saved now would be of another model than the session's.
  EXPECT_FALSE(screen->update(session_, area));
  must(screen->draw({}, app::Detail::kFull));

  must(session_.submit(app::command::Orbit{40, 10}));
  EXPECT_FALSE(screen->update(session_, area));
  EXPECT_NE(pixels(), before) << "the camera goes on";

  must(session_.submit(app::command::Orbit{-40, -10}));
  open(4, 3);
  must(screen->update(session_, area));
  EXPECT_EQ(pixels(), before);
  for (const std::string& message : screen->validation_messages()) ADD_FAILURE() << message;
}

}  // namespace
}  // namespace geotherm::test
