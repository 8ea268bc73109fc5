// SPDX-License-Identifier: MIT
#include "ui/file_dialog.h"

#include <cstdlib>
#include <fstream>
#include <utility>
#include <vector>

#include "tests/ui/driver.h"
#include "ui/key_map.h"

namespace geotherm::ui {
namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

void touch(const fs::path& path) { std::ofstream(path) << "x"; }

class FileDialogTest : public UiTest {
 protected:
  void SetUp() override {
    open_square();
    fs::create_directories(folder() / "sub");
    touch(folder() / "a.OBJ");
    touch(folder() / "b.txt");
    touch(folder() / "d.ply.gz");
    touch(folder() / "e.tar.gz");
    touch(folder() / "f.glb");
    touch(folder() / "sub" / "c.ply");
  }
  void control(int letter, bool shift = false) {
    hold(true, shift, false);
    key(letter);
    hold(false, false, false);
    frame();
  }
  void go_to(const fs::path& path) { fill("Files/folder", path.string()); }
  bool is_open() {
    frame();
    return is_drawn("Files/up");
  }
};

TEST_F(FileDialogTest, ListsFoldersAndTheFilesOfItsKind) {
  control('O');
  go_to(folder());
  EXPECT_TRUE(is_drawn("Files/sub"));
  EXPECT_TRUE(is_drawn("Files/a.OBJ"));
  EXPECT_TRUE(is_drawn("Files/square.obj"));
  EXPECT_TRUE(is_drawn("Files/d.ply.gz"));
  EXPECT_TRUE(is_drawn("Files/f.glb"));
  EXPECT_FALSE(is_drawn("Files/b.txt"));
  EXPECT_FALSE(is_drawn("Files/e.tar.gz"));
  click_item("Files/all files");
  frame();
  EXPECT_TRUE(is_drawn("Files/b.txt"));
}

TEST_F(FileDialogTest, OpensWhatIsChosenInAFolder) {
  control('O');
  go_to(folder());
  click_item("Files/sub");
  frame();
  click_item("Files/c.ply");
  click_item("Files/accept");
  EXPECT_EQ(sent(), Texts{"open " + (folder() / "sub" / "c.ply").string()});
  EXPECT_FALSE(is_open());
}

TEST_F(FileDialogTest, OpensWithADoubleClick) {
  control('O');
  go_to(folder());
  wait();
  const ImVec2 at = middle_of("Files/a.OBJ");
  move(at.x, at.y);
  press();
  release();
  press();
  release();
  EXPECT_EQ(sent(), Texts{"open " + (folder() / "a.OBJ").string()});
  EXPECT_FALSE(is_open());
}

TEST_F(FileDialogTest, OpensATypedNameWithEnter) {
  control('O');
  go_to(folder());
  fill("Files/name", "sub/c.ply");
  EXPECT_EQ(sent(), Texts{"open " + (folder() / "sub" / "c.ply").string()});
}

TEST_F(FileDialogTest, EntersATypedFolder) {
  control('O');
  go_to(folder());
  fill("Files/name", "sub");
  frame();
  EXPECT_TRUE(is_drawn("Files/c.ply"));
  EXPECT_EQ(sent(), Texts{});
}

TEST_F(FileDialogTest, StaysOpenWhereThereIsNoSuchFile) {
  control('O');
  go_to(folder());
  fill("Files/name", "nothing.obj");
  EXPECT_TRUE(is_open());
  EXPECT_EQ(sent(), Texts{});
}

TEST_F(FileDialogTest, StaysWhereItWasWhenAFolderCannotBeListed) {
  control('O');
  go_to(folder());
  go_to(folder() / "nowhere");
  EXPECT_TRUE(is_drawn("Files/a.OBJ"));
}

TEST_F(FileDialogTest, ClosesOnEscape) {
  control('O');
  ASSERT_TRUE(is_open());
  key(kKeyEscape);
  EXPECT_FALSE(is_open());
  EXPECT_EQ(sent(), Texts{});
  EXPECT_FALSE(last_.cancel);
}

TEST_F(FileDialogTest, KeepsKeysAndClicksFromThePicture) {
  control('O');
  click(seen(0.02, 0.02).x, seen(0.02, 0.02).y);
  EXPECT_EQ(sent(), Texts{});
  EXPECT_TRUE(is_open());
}

TEST_F(FileDialogTest, CompletesTheNameOfANewFile) {
  control('S');
  go_to(folder());
  fill("Files/name", "work");
  EXPECT_EQ(sent(), Texts{"save session " + (folder() / "work.geotherm").string()});
  EXPECT_TRUE(fs::exists(folder() / "work.geotherm"));
}

TEST_F(FileDialogTest, AsksBeforeItReplacesAFile) {
  touch(folder() / "d.csv");
  control('D');
  go_to(folder());
  fill("Files/name", "d.csv");
  frame();
  EXPECT_EQ(sent(), Texts{});
  ASSERT_TRUE(is_drawn("Files/replace"));
  click_item("Files/keep");
  frames(2);
  EXPECT_TRUE(is_drawn("Files/name"));
  EXPECT_EQ(sent(), Texts{});
  click_item("Files/accept");
  frame();
  click_item("Files/replace");
  EXPECT_EQ(sent(), Texts{"save distances " + (folder() / "d.csv").string()});
  EXPECT_FALSE(is_open());
}

TEST_F(FileDialogTest, AsksByTheNameThatTheFileWillHave) {
  touch(folder() / "d.csv");
  control('D');
  go_to(folder());
  fill("Files/name", "d");
  frame();
  EXPECT_TRUE(is_drawn("Files/replaces d.csv"));
  click_item("Files/replace");
  EXPECT_EQ(sent(), Texts{"save distances " + (folder() / "d.csv").string()});
}

TEST_F(FileDialogTest, EscapeAtTheQuestionKeepsTheFileAndTheDialog) {
  touch(folder() / "d.csv");
  control('D');
  go_to(folder());
  fill("Files/name", "d.csv");
  frame();
  key(kKeyEscape);
  EXPECT_TRUE(is_open());
  EXPECT_EQ(sent(), Texts{});
}

TEST_F(FileDialogTest, ChoosesTheFormatOfDistances) {
  control('D');
  go_to(folder());
  fill("Files/folder", folder().string());
  click_item("Files/.vtp");
  click_item("Files/accept");
  EXPECT_EQ(sent(), Texts{"save distances " + (folder() / "square.vtp").string()});
}

TEST_F(FileDialogTest, SavesThePictureInItsSize) {
  control('P');
  go_to(folder());
  click_item("Files/as shown");
  fill("Files/size", "640x480");
  click_item("Files/panels");
  click_item("Files/accept");
  EXPECT_EQ(sent(),
            Texts{"save picture " + (folder() / "square.png").string() + " 640x480 panels"});
}

TEST_F(FileDialogTest, SavesAFigureInASizeOnPaper) {
  control('P');
  go_to(folder());
  click_item("Files/.pdf");
  click_item("Files/as shown");
  fill("Files/size", "8.5cm");
  click_item("Files/accept");
  EXPECT_EQ(sent(), Texts{}) << "a width alone is no size";
  EXPECT_TRUE(is_open());
  fill("Files/size", "8.5cmx6cm");
  click_item("Files/accept");
  EXPECT_EQ(sent(), Texts{"save picture " + (folder() / "square.pdf").string() + " 8.5cmx6cm"});
}

TEST_F(FileDialogTest, SaysWhatHasBeenWritten) {
  control('S');
  go_to(folder());
  fill("Files/name", "work");
  frames(2);
  EXPECT_TRUE(session_.log().back().has_written);
  EXPECT_TRUE(is_drawn("Status/work"));
  EXPECT_FALSE(is_drawn("Notices/close")) << "nothing is laid over the picture";
}

TEST_F(FileDialogTest, SavesThePictureAsShownWithPanels) {
  control('S', true);
  go_to(folder());
  click_item("Files/panels");
  click_item("Files/accept");
  EXPECT_EQ(sent(), Texts{"save picture " + (folder() / "square.png").string() + " panels"});
}

TEST_F(FileDialogTest, SavesAFigureForAPaperWithoutThePanels) {
  control('P');
  go_to(folder());
  click_item("Files/panels");
  click_item("Files/.pdf");
  click_item("Files/accept");
  EXPECT_EQ(sent(), Texts{"save picture " + (folder() / "square.pdf").string()});
}

TEST_F(FileDialogTest, SaysThatAFolderIsMissing) {
  control('S');
  fill("Files/name", (folder() / "none" / "x.geotherm").string());
  EXPECT_TRUE(is_open());
  EXPECT_EQ(sent(), Texts{});
}

TEST(FolderListing, PutsFoldersFirstInTheOrderOfTheAlphabet) {
  const fs::path folder = fs::path(::testing::TempDir()) / "geotherm_listing";
  fs::remove_all(folder);
  fs::create_directories(folder / "Zoo");
  fs::create_directories(folder / "ant");
  for (const char* name : {"b.ply", "A.PLY", ".hidden.ply", "c.txt"}) touch(folder / name);
  fs::create_symlink(folder / "gone", folder / "dangling.ply");
  constexpr std::string_view kPly[] = {".ply"};
  Texts names;
  for (const FolderEntry& entry : list_folder(folder, kPly).entries) names.push_back(entry.name);
  EXPECT_EQ(names, (Texts{"ant", "Zoo", "A.PLY", "b.ply", "dangling.ply"}));
  EXPECT_EQ(list_folder(folder, {}).entries.size(), 6U);
  EXPECT_NE(list_folder(folder / "none", {}).error, "");
  fs::remove_all(folder);
}

TEST(FolderListing, UnderstandsTypedPaths) {
  EXPECT_EQ(typed_path("a/../b.obj", "/x"), fs::path("/x/b.obj"));
  EXPECT_EQ(typed_path("/y/b.obj", "/x"), fs::path("/y/b.obj"));
  if (const char* home = std::getenv("HOME")) {
    EXPECT_EQ(typed_path("~/b", "/x"), fs::path(home) / "b");
  }
}

TEST(FileTasks, AreThoseOfTheActionsThatAskForAFile) {
  const std::vector<std::pair<Action, std::string>> sent = {
      {Action::kOpenModel, "open a"},           {Action::kOpenSession, "run a"},
      {Action::kOpenSequence, "sequence a"},    {Action::kSaveSession, "save session a"},
      {Action::kSavePicture, "save picture a"}, {Action::kSaveDistances, "save distances a"},
      {Action::kSaveFigures, "save figures a"}, {Action::kSaveMesh, "save mesh a"},
      {Action::kSaveLog, "save log a"}};
  for (const auto& [action, text] : sent) {
    ASSERT_NE(file_task(action), nullptr);
    EXPECT_EQ(app::to_text(file_task(action)->make("a")), text);
  }
  EXPECT_EQ(file_task(Action::kQuit), nullptr);
  EXPECT_EQ(suggested_name("/a/b.c/gear.stl", *file_task(Action::kSavePicture)), "gear.png");
  EXPECT_EQ(suggested_name("gear.stl", *file_task(Action::kSaveMesh)), "gear-sculpted.obj");
  EXPECT_EQ(suggested_name("", *file_task(Action::kSaveFigures)), "geotherm.json");
}

}  // namespace
}  // namespace geotherm::ui
