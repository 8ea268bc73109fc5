// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <imgui.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "ui/interface.h"

// Plays mouse and keys to the panels, without a window.
namespace geotherm::ui {

/// Cells along a side of the test model: a unit square in the plane z = 0, its vertices numbered
/// row by row from the origin, two faces a cell.
inline constexpr int kCells = 8;

/// A key that fields alone know, by the number that window systems give it.
inline constexpr int kKeyUp = 265;

/// A camera that looks straight at the square. Its side is 0.8 of the shorter side of the canvas.
class FlatCanvas : public Canvas {
 public:
  const Interface* panels = nullptr;
  std::optional<SurfacePoint> front;  ///< lies under every pixel, before all else

  std::optional<InsidePoint> inside;  ///< lies under every pixel, and no surface does

  std::optional<SurfacePoint> surface_at(float x, float y) const override;
  std::optional<InsidePoint> inside_at(float, float) const override { return inside; }
  std::optional<std::array<float, 2>> place_of(const Vec3& point) const override;
  std::array<float, 2> lens_centre() const override;
  float title = 0;  ///< height of one over the picture, pixels
  float title_height() const override { return title; }
  double fps() const override { return 60; }
  std::vector<std::string> colour_maps() const override { return {"red-blue", "viridis"}; }
  std::string device() const override { return "a test, in software"; }
};

/// A session on the square with panels so high that all sections are seen at once.
class UiTest : public ::testing::Test {
 protected:
  explicit UiTest(app::SessionHooks hooks = {});
  ~UiTest() override;

  /// Panels anew, with another layout. All sections are open unless it says otherwise.
  void restart(Layout layout, float scale = 1);
  /// Opens the square; the mouse is far from everything, nothing has been sent.
  void open_square();
  /// Runs a command of the session, in its text form; a failure of it fails the test.
  void run(const std::string& command);

  /// One frame. What it sends is noted and carried out.
  FrameOutput frame();
  void frames(int count);
  /// So much later that the next click is no double click.
  void wait();

  void move(float x, float y);
  void press(int button = 0);
  void release(int button = 0);
  void click(float x, float y, int button = 0);
  /// In a few steps from place to place.
  void drag(ImVec2 from, ImVec2 to, int button = 0);
  void hold(bool ctrl, bool shift, bool alt);
  void type(const std::string& characters);
  /// A key by its number, down and up again.
  void key(int code);

  /// Clicks on an item by its name; fails the test where it was not drawn.
  void click_item(const std::string& name);
  ImVec2 middle_of(const std::string& name);
  bool is_drawn(const std::string& name) const { return panels_->place_of_item(name).has_value(); }
  /// Into a field: what it held is replaced, Enter at the end.
  void fill(const std::string& name, const std::string& text);

  /// Where a point of the square is seen.
  ImVec2 seen(double x, double y) const;
  /// The commands that were sent since the last call, in their text form.
  std::vector<std::string> sent();
  /// A folder of this test alone.
  std::filesystem::path folder() const { return folder_; }

  app::Session session_;
  FlatCanvas canvas_;
  std::unique_ptr<Interface> panels_;
  FrameOutput last_;

 private:
  std::filesystem::path folder_;
  std::vector<std::string> sent_;
};

/// A layout with every section open.
Layout everything_open();

}  // namespace geotherm::ui
