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
  /// Opens a flat sheet of so many cells, 3 high.
  void open(int columns, int rows, double width = 4) {
    const auto path = std::filesystem::path(testing::TempDir()) /
                      ("geotherm_sheet_" + std::to_string(columns) + ".obj");
    std::ofstream file(path);
    for (int i = 0; i < (columns + 1) * (rows + 1); ++i) {
      file << "v " << i % (columns + 1) * width / columns << ' ' << i / (columns + 1) * 3.0 / rows
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

  void set(const char* name, const char* value) {
    must(session_.submit(app::command::Set{name, value}));
  }

  app::Session session_;
};

TEST_F(Screen, KeepsItsPictureWhereTheDeviceHasNoMemoryForAnother) {
  const auto screen = must(app::SceneScreen::open_without_window(kExtent, validated(5 * kMiB)));
  const app::PictureArea area{{0, 0}, kExtent};
  const auto pixels = [&] { return must(screen->picture_of_window(kExtent, {})).pixels; };
  set("title", "Sheet");
  open(4, 3);
  must(screen->update(session_, area));
  const auto before = pixels();
  EXPECT_TRUE(screen->has_surface_of(*session_.explored().model));

  open(400, 300);
  const Result<void> refused = screen->update(session_, area);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kOutOfMemory);
  EXPECT_EQ(pixels(), before);
  EXPECT_FALSE(screen->has_surface_of(*session_.explored().model));
  // It stays one: a picture that is saved now would be of another model than the session's.
  EXPECT_FALSE(screen->update(session_, area));
  must(screen->draw({}, app::Detail::kFull));

  must(session_.submit(app::command::Orbit{40, 10}));
  EXPECT_FALSE(screen->update(session_, area));
  EXPECT_NE(pixels(), before) << "the camera goes on";

  must(session_.submit(app::command::Orbit{-40, -10}));
  const app::PictureArea smaller{{0, 0}, {100, 60}};
  EXPECT_FALSE(screen->update(session_, smaller));
  const auto in_smaller = pixels();
  open(4, 3);
  must(screen->update(session_, smaller));
  EXPECT_EQ(pixels(), in_smaller) << "the legend follows the window";
  must(screen->update(session_, area));
  EXPECT_EQ(pixels(), before);
  EXPECT_TRUE(screen->has_surface_of(*session_.explored().model));
  for (const std::string& message : screen->validation_messages()) ADD_FAILURE() << message;
}

TEST_F(Screen, DrawsTheModelAloneWhereTheDeviceHasNoMemoryForItsAnswer) {
  const auto screen = must(app::SceneScreen::open_without_window(kExtent, validated(5 * kMiB)));
  const app::PictureArea area{{0, 0}, kExtent};
  const auto pixels = [&] { return must(screen->picture_of_window(kExtent, {})).pixels; };
  set("bar", "off");
  set("caption", "off");
  open(200, 150);
  must(session_.submit(app::command::SetSources{{must(app::parse_source("15100"))}}));
  must(session_.finish());
  must(screen->update(session_, area));
  const auto answer = pixels();

  set("view", "eikonal-error");  // values of faces need their corners one by one
  must(session_.finish());
  const Result<void> refused = screen->update(session_, area);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kOutOfMemory);
  EXPECT_TRUE(screen->has_surface_of(*session_.explored().model));
  const auto alone = pixels();
  EXPECT_NE(alone, answer);

  must(session_.submit(app::command::ClearSources{}));
  set("view", "smooth");
  must(session_.finish());
  must(screen->update(session_, area));
  EXPECT_EQ(pixels(), alone);
  for (const std::string& message : screen->validation_messages()) ADD_FAILURE() << message;
}

TEST_F(Screen, FitsTheCameraToEachModelWhoseAnswerHasNoMemory) {
  const auto screen = must(app::SceneScreen::open_without_window(kExtent, validated(5 * kMiB)));
  const app::PictureArea area{{0, 0}, kExtent};
  const auto pixels = [&] { return must(screen->picture_of_window(kExtent, {})).pixels; };
  set("bar", "off");
  set("caption", "off");
  set("view", "triangle-quality");
  for (const double width : {4.0, 12.0}) {
    open(200, 150, width);
    set("fit", "tight");
    must(session_.finish());
    ASSERT_FALSE(screen->update(session_, area));
  }
  const auto alone = pixels();
  set("view", "smooth");
  must(session_.finish());
  must(screen->update(session_, area));
  EXPECT_EQ(pixels(), alone);
  for (const std::string& message : screen->validation_messages()) ADD_FAILURE() << message;
}

}  // namespace
}  // namespace geotherm::test
