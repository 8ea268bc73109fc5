// SPDX-License-Identifier: MIT
#include "tests/ui/driver.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include "ui/key_map.h"

namespace geotherm::ui {
namespace {

struct Square {
  float left = 0, bottom = 0, side = 1;
};
Square square_on(const Interface& panels) {
  const Rect canvas = panels.canvas();
  const float side = 0.8F * std::min(canvas.width, canvas.height);
  return {canvas.x + (canvas.width - side) / 2, canvas.y + (canvas.height + side) / 2, side};
}

void write_square(const std::filesystem::path& path) {
  std::ofstream file(path);
  const int row = kCells + 1;
  for (int i = 0; i < row * row; ++i) {
    file << "v " << double(i % row) / kCells << ' ' << double(i / row) / kCells << " 0\n";
  }
  for (int i = 0; i < kCells * kCells; ++i) {
    const int a = 1 + i % kCells + i / kCells * row;
    file << "f " << a << ' ' << a + 1 << ' ' << a + row << '\n';
    file << "f " << a + row + 1 << ' ' << a + row << ' ' << a + 1 << '\n';
  }
}

}  // namespace

std::optional<SurfacePoint> FlatCanvas::surface_at(float x, float y) const {
  const Square square = square_on(*panels);
  const double u = (x - square.left) / square.side * kCells;
  const double v = (square.bottom - y) / square.side * kCells;
  if (inside) return std::nullopt;
  if (front) return front;
  if (!(u >= 0 && v >= 0 && u < kCells && v < kCells)) return std::nullopt;
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const double s = u - i, t = v - j;
  const Index face = 2 * (i + j * kCells);
  if (s + t <= 1) return SurfacePoint::in_face(face, {1 - s - t, s, t});
  return SurfacePoint::in_face(face + 1, {s + t - 1, 1 - s, 1 - t});
}

std::optional<std::array<float, 2>> FlatCanvas::place_of(const Vec3& point) const {
  const Square square = square_on(*panels);
  return std::array<float, 2>{square.left + static_cast<float>(point.x()) * square.side,
                              square.bottom - static_cast<float>(point.y()) * square.side};
}

std::array<float, 2> FlatCanvas::lens_centre() const {
  const Rect canvas = panels->canvas();
  return {canvas.x + canvas.width / 2, canvas.y + canvas.height / 2};
}

Layout everything_open() {
  Layout layout;
  for (const char* section : {"Model", "Size and triangles", "Sources", "Solver", "A and B", "View",
                              "Timings", "Quality", "Exact error", "Point", "Compare backends",
                              "More of the view", "Camera", "Advanced settings"}) {
    layout.open[section] = true;
  }
  return layout;
}

UiTest::UiTest(app::SessionHooks hooks) : session_(std::move(hooks)) {
  const ::testing::TestInfo& test = *::testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test.test_suite_name()) + "." + test.name();
  std::replace(name.begin(), name.end(), '/', '_');
  folder_ = std::filesystem::path(::testing::TempDir()) / ("geotherm_" + name);
  std::filesystem::remove_all(folder_);
  std::filesystem::create_directories(folder_);
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {1600, 2600};
  io.DeltaTime = 1.0F / 60;
  const std::pair<ImGuiKey, int> editing[] = {
      {ImGuiKey_Tab, kKeyTab},     {ImGuiKey_UpArrow, kKeyUp},  {ImGuiKey_Delete, kKeyDelete},
      {ImGuiKey_Space, kKeySpace}, {ImGuiKey_Enter, kKeyEnter}, {ImGuiKey_Escape, kKeyEscape},
      {ImGuiKey_A, 'A'},           {ImGuiKey_Y, 'Y'},           {ImGuiKey_Z, 'Z'}};
  for (const auto& [key, code] : editing) io.KeyMap[key] = code;
  restart(everything_open());
}

UiTest::~UiTest() {
  panels_.reset();
  ImGui::DestroyContext();
  std::filesystem::remove_all(folder_);
}

void UiTest::restart(Layout layout, float scale) {
  panels_ = std::make_unique<Interface>(std::move(layout), std::span<const std::byte>(), scale);
  canvas_.panels = panels_.get();
  frames(2);
}

void UiTest::open_square() {
  const auto path = folder_ / "square.obj";
  write_square(path);
  run("open \"" + path.string() + "\"");
  run("source set 0");
  move(-100, -100);
  frames(3);
  sent_.clear();
}

void UiTest::run(const std::string& text) {
  const auto command = app::parse_command(text);
  ASSERT_TRUE(command) << command.error().message;
  const auto done = session_.submit(*command);
  ASSERT_TRUE(done) << done.error().message;
}

FrameOutput UiTest::frame() {
  ImGui::NewFrame();
  last_ = panels_->draw(session_, canvas_);
  ImGui::Render();
  for (const app::Command& command : last_.commands) {
    sent_.push_back(app::to_text(command));
    // What fails is in the log, as in the window.
    if (!session_.submit(command)) continue;
  }
  if (last_.cancel) session_.cancel();
  if (last_.study) session_.study();
  session_.update();
  return last_;
}

void UiTest::frames(int count) {
  for (int i = 0; i < count; ++i) frame();
}

void UiTest::wait() {
  ImGuiIO& io = ImGui::GetIO();
  const float usual = std::exchange(io.DeltaTime, 1.0F);
  frame();
  io.DeltaTime = usual;
}

void UiTest::move(float x, float y) {
  ImGui::GetIO().MousePos = {x, y};
  frame();
}

void UiTest::press(int button) {
  ImGui::GetIO().MouseDown[button] = true;
  frame();
}

void UiTest::release(int button) {
  ImGui::GetIO().MouseDown[button] = false;
  frame();
}

void UiTest::click(float x, float y, int button) {
  wait();
  move(x, y);
  press(button);
  release(button);
  frame();
}

void UiTest::drag(ImVec2 from, ImVec2 to, int button) {
  constexpr int kSteps = 4;
  move(from.x, from.y);
  press(button);
  for (int i = 1; i <= kSteps; ++i) {
    const float share = static_cast<float>(i) / kSteps;
    move(from.x + share * (to.x - from.x), from.y + share * (to.y - from.y));
  }
  release(button);
}

void UiTest::hold(bool ctrl, bool shift, bool alt) {
  ImGuiIO& io = ImGui::GetIO();
  io.KeyCtrl = ctrl;
  io.KeyShift = shift;
  io.KeyAlt = alt;
}

void UiTest::type(const std::string& characters) {
  ImGui::GetIO().AddInputCharactersUTF8(characters.c_str());
  frame();
}

void UiTest::key(int code) {
  ImGui::GetIO().KeysDown[code] = true;
  frame();
  ImGui::GetIO().KeysDown[code] = false;
  frame();
}

ImVec2 UiTest::middle_of(const std::string& name) {
  const auto place = panels_->place_of_item(name);
  EXPECT_TRUE(place) << "there is no item " << name;
  if (!place) return {-1, -1};
  return {place->x + place->width / 2, place->y + place->height / 2};
}

void UiTest::click_item(const std::string& name) {
  const ImVec2 at = middle_of(name);
  click(at.x, at.y);
}

void UiTest::fill(const std::string& name, const std::string& text) {
  click_item(name);  // ImGui selects all of it
  hold(true, false, false);
  key('A');
  hold(false, false, false);
  key(kKeyDelete);
  type(text);
  key(kKeyEnter);
}

ImVec2 UiTest::seen(double x, double y) const {
  const auto place = *canvas_.place_of(Vec3(x, y, 0));
  return {std::floor(place[0]), std::floor(place[1])};  // as ImGui reads the mouse
}

std::vector<std::string> UiTest::sent() { return std::exchange(sent_, {}); }

}  // namespace geotherm::ui
