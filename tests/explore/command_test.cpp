// SPDX-License-Identifier: MIT
#include "app/session/command.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <set>
#include <string_view>

#include "app/session/settings.h"

namespace geotherm::app {
namespace {

using namespace command;  // NOLINT: the tests are about nothing else

struct TextCase {
  const char* name;
  Command command;
  std::string text;
};

void PrintTo(const TextCase& c, std::ostream* out) { *out << c.name; }

constexpr PictureSize kPixels = {{{640, PaperUnit::kPixel}, {480, PaperUnit::kPixel}}};
constexpr PictureSize kOnPaper = {{{8.5, PaperUnit::kCentimetre}, {60, PaperUnit::kMillimetre}}};

class CommandText : public testing::TestWithParam<TextCase> {};

TEST_P(CommandText, IsWrittenAsDocumented) {
  EXPECT_EQ(to_text(GetParam().command), GetParam().text);
}

TEST_P(CommandText, ReadsBackAsTheSameCommand) {
  const auto parsed = parse_command(GetParam().text);
  ASSERT_TRUE(parsed) << parsed.error().message;
  EXPECT_EQ(*parsed, GetParam().command);
}

INSTANTIATE_TEST_SUITE_P(
    EveryCommand, CommandText,
    testing::Values(
        TextCase{"Open", Open{"a/b.obj"}, "open a/b.obj"},
        TextCase{"Target", Target{FacePoint{3, {0.25, 0.25, 0.5}}}, "target face:3:0.25:0.25:0.5"},
        TextCase{"TargetVertex", Target{VertexList{{17}}}, "target 17"},
        TextCase{"NoTarget", Target{}, "target none"},
        TextCase{"Mean", ShowCentre{CentreKind::kMean}, "source centre mean"},
        TextCase{"Median", ShowCentre{CentreKind::kMedian}, "source centre median"},
        TextCase{"NoCentre", ShowCentre{}, "source centre none"},
        TextCase{"Field", ShowField{"a map.npy"}, R"(field "a map.npy")"},
        TextCase{"NoField", ShowField{}, "field none"},
        TextCase{"MaxDistance", MaxDistance{0.5}, "max-distance 0.5"},
        TextCase{"AllDistances", MaxDistance{}, "max-distance none"},
        TextCase{"OpenWithBlanks", Open{"my \"best\" model #1.ply"},
                 R"(open "my \"best\" model #1.ply")"},
        TextCase{"OpenWithBackslashes", Open{"C:\\a b\\c"}, R"(open "C:\\a b\\c")"},
        TextCase{"OpenWithLineEnd", Open{"a\nb"}, R"(open "a\nb")"},
        TextCase{"OpenShellText", Open{"$(a)`b`!c;d|e"}, R"(open "\x24(a)\x60b\x60\x21c;d|e")"},
        TextCase{"OpenControls", Open{"a\rb\x1b[1mc\xc2\x9b\x7f"},
                 R"(open "a\x0db\x1b[1mc\xc2\x9b\x7f")"},
        TextCase{"OpenNotUtf8", Open{"gr\xfc\xdf.obj"}, R"(open "gr\xfc\xdf.obj")"},
        TextCase{"OpenUnicode", Open{"Größe/ü.obj"}, "open Größe/ü.obj"},
        TextCase{"Run", Run{"x.geotherm"}, "run x.geotherm"},
        TextCase{"Set", Set{"time-factor", "2.5"}, "time-factor 2.5"},
        TextCase{"SetSources", SetSources{{VertexList{{17}}, FacePoint{3, {0.25, 0.25, 0.5}}}},
                 "source set 17 face:3:0.25:0.25:0.5"},
        TextCase{"AddSources", AddSources{{VertexCurve{{1, 2, 3}, {}}}}, "source add curve:1,2,3"},
        TextCase{"AddBoundary", AddSources{{WholeBoundary{}}}, "source add boundary"},
        TextCase{"AddSpacePoint", AddSources{{SpacePoint{Vec3(0.1, -2, 1e-30)}}},
                 "source add xyz:0.1:-2:1e-30"},
        TextCase{"MoveSource", MoveSource{2, RandomVertices{5, 7}}, "source move 2 random:5:7"},
        TextCase{"RemoveSource", RemoveSource{0}, "source remove 0"},
        TextCase{"ExtendCurve", ExtendCurve{{4, 5, 6}}, "source extend 4,5,6"},
        TextCase{"ExtendAcross", ExtendCurve{{}, {{3, {0.25, 0.25, 0.5}}, {4, {0, 1, 0}}}},
                 "source extend face:3:0.25:0.25:0.5,face:4:0:1:0"},
        TextCase{"ClearSources", ClearSources{}, "source clear"},
        TextCase{"MoreSources", MoreSources{}, "source more"},
        TextCase{"FewerSources", FewerSources{}, "source fewer"},
        TextCase{"ShuffleSources", ShuffleSources{}, "source shuffle"},
        TextCase{"Pull", Sculpt{{SculptTool::kPull, 0.5, 0.25, {{3, {0.25, 0.25, 0.5}}}}},
                 "sculpt pull 0.5 0.25 face:3:0.25:0.25:0.5"},
        TextCase{"Push", Sculpt{{SculptTool::kPush, 1e-3, 1, {{3, {1, 0, 0}}, {4, {0, 1, 0}}}}},
                 "sculpt push 0.001 1 face:3:1:0:0 face:4:0:1:0"},
        TextCase{"Smooth", Sculpt{{SculptTool::kSmooth, 2, 0, {{0, {0, 0, 1}}}}},
                 "sculpt smooth 2 0 face:0:0:0:1"},
        TextCase{"ExtendStroke", ExtendStroke{{{3, {1, 0, 0}}, {4, {0, 1, 0}}}},
                 "sculpt extend face:3:1:0:0 face:4:0:1:0"},
        TextCase{"Sequence", ShowSequence{"walk.pc2"}, "sequence walk.pc2"},
        TextCase{"SequenceNumbered", ShowSequence{"f_%04d.obj"}, "sequence f_%04d.obj"},
        TextCase{"NoSequence", ShowSequence{}, "sequence none"},
        TextCase{"ShowFrame", ShowFrame{12}, "frame 12"}, TextCase{"PlayOn", Play{true}, "play on"},
        TextCase{"PlayOff", Play{false}, "play off"}, TextCase{"LoopOff", Loop{false}, "loop off"},
        TextCase{"LoopOn", Loop{true}, "loop on"},
        TextCase{"Orbit", Orbit{10, -5.5}, "camera orbit 10 -5.5"},
        TextCase{"Zoom", Zoom{1.25}, "camera zoom 1.25"},
        TextCase{"ZoomAt", Zoom{0.5, 0.1, -0.2}, "camera zoom 0.5 0.1 -0.2"},
        TextCase{"Pan", Pan{0.3, 0}, "camera pan 0.3 0"},
        TextCase{"Centre", Centre{1, 2, -3e5}, "camera centre 1 2 -3e+05"},
        TextCase{"Place", Place{30, 20, 2, 0.1, 0}, "camera place 30 20 2 0.1 0"},
        TextCase{"Frame", Frame{}, "camera frame"}, TextCase{"RotateOn", Rotate{true}, "rotate on"},
        TextCase{"RotateOff", Rotate{false}, "rotate off"}, TextCase{"Keep", Keep{}, "keep"},
        TextCase{"Forget", Forget{}, "forget"}, TextCase{"Swap", Swap{}, "swap"},
        TextCase{"ShowA", Show{Shown::kA}, "show a"}, TextCase{"ShowB", Show{Shown::kB}, "show b"},
        TextCase{"ShowDifference", Show{Shown::kDifference}, "show difference"},
        TextCase{"Flip", Flip{}, "flip"},
        TextCase{"Pick", Pick{FacePoint{7, {1, 0, 0}}}, "pick face:7:1:0:0"},
        TextCase{"PickNone", Pick{}, "pick none"}, TextCase{"Compare", Compare{}, "compare all"},
        TextCase{"CompareSome", Compare{"cholmod,cg"}, "compare cholmod,cg"},
        TextCase{"SavePicture", SavePicture{"a.png"}, "save picture a.png"},
        TextCase{"SavePictureSize", SavePicture{"a.png", kPixels}, "save picture a.png 640x480"},
        TextCase{"SavePictureOnPaper", SavePicture{"a.pdf", kOnPaper},
                 "save picture a.pdf 8.5cmx60mm"},
        TextCase{"SavePicturePanels", SavePicture{"a b.png", kPixels, true},
                 "save picture \"a b.png\" 640x480 panels"},
        TextCase{"SavePictureOnlyPanels", SavePicture{"a.png", {}, true},
                 "save picture a.png panels"},
        TextCase{"SaveDistances", SaveDistances{"d.npy"}, "save distances d.npy"},
        TextCase{"SaveMesh", SaveMesh{"m.obj"}, "save mesh m.obj"},
        TextCase{"SaveSession", SaveSession{"s.geotherm"}, "save session s.geotherm"},
        TextCase{"SaveLog", SaveLog{"l.geotherm"}, "save log l.geotherm"},
        TextCase{"SaveFigures", SaveFigures{"f.json"}, "save figures f.json"},
        TextCase{"Reset", Reset{}, "reset"}, TextCase{"Undo", Undo{}, "undo"},
        TextCase{"Redo", Redo{}, "redo"}, TextCase{"Quit", Quit{}, "quit"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(Command, EveryKindHasATextCase) {
  // The list above must grow with the variant.
  EXPECT_EQ(std::variant_size_v<Command>, 46U);
}

class SettingText : public testing::TestWithParam<std::string> {};

TEST_P(SettingText, EveryValueItNamesIsACommandThatReadsBack) {
  const Setting& setting = *find_setting(GetParam());
  const ViewerState start = initial_state();
  std::vector<std::string> values;
  if (setting.values != nullptr) values = setting.values();
  values.push_back(setting.get(start));
  for (const std::string& value : values) {
    const Command command = Set{GetParam(), value};
    const auto parsed = parse_command(to_text(command));
    ASSERT_TRUE(parsed) << parsed.error().message;
    EXPECT_EQ(*parsed, command);
  }
}

TEST_P(SettingText, AWordThatIsNoValueIsRefusedWithItsColumn) {
  const auto parsed = parse_command(GetParam() + " ?!");
  ASSERT_FALSE(parsed);
  const std::string column = "column " + std::to_string(GetParam().size() + 2) + ": ";
  EXPECT_EQ(sentence(parsed.error()).find(column), 0U) << parsed.error().message;
}

INSTANTIATE_TEST_SUITE_P(
    AllSettings, SettingText, testing::ValuesIn([] {
      std::vector<std::string> names;
      const std::set<std::string_view> any = {"title", "bar-label", "units", "mask"};
      for (const Setting& s : settings()) {
        if (!any.contains(s.name)) names.emplace_back(s.name);
      }
      return names;
    }()),
    [](const auto& test) {
      std::string name = test.param;
      std::erase(name, '-');
      return name;
    });

TEST(Command, NumbersReadBackExactly) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> angle(-360, 360);
  for (int i = 0; i < 200; ++i) {
    const Orbit orbit = {angle(random), angle(random) * 1e-9};
    const auto parsed = parse_command(to_text(orbit));
    ASSERT_TRUE(parsed);
    EXPECT_EQ(std::get<Orbit>(*parsed).azimuth, orbit.azimuth);
    EXPECT_EQ(std::get<Orbit>(*parsed).elevation, orbit.elevation);
  }
}

TEST(Command, WeightsOfFacePointsReadBackExactly) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> weight(0, 1);
  for (int i = 0; i < 500; ++i) {
    double a = weight(random), b = weight(random) * (1 - a);
    const auto first =
        parse_command("source set face:" + std::to_string(i) + ":" + std::to_string(a) + ":" +
                      std::to_string(b) + ":" + std::to_string(1 - a - b));
    ASSERT_TRUE(first) << first.error().message;
    const auto again = parse_command(to_text(*first));
    ASSERT_TRUE(again);
    EXPECT_EQ(std::get<SetSources>(*again).sources, std::get<SetSources>(*first).sources);
  }
}

struct BadCase {
  const char* name;
  const char* line;
  const char* begins;  ///< of the message
  const char* expects;
};
void PrintTo(const BadCase& c, std::ostream* out) { *out << c.name; }

class BadCommand : public testing::TestWithParam<BadCase> {};

TEST_P(BadCommand, SaysColumnAndWhatWasExpected) {
  const auto parsed = parse_command(GetParam().line);
  ASSERT_FALSE(parsed);
  const std::string message = sentence(parsed.error());
  EXPECT_EQ(message.find(GetParam().begins), 0U) << message;
  EXPECT_NE(message.find(GetParam().expects), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Lines, BadCommand,
    testing::Values(
        BadCase{"Empty", "", "column 1: ", "a command"},
        BadCase{"Unknown", "  fly away", "column 3: ", "there is no command 'fly'"},
        BadCase{"UnknownSecond", "camera fly", "column 8: ", "orbit, zoom, pan"},
        BadCase{"NothingSecond", "camera", "column 7: ", "orbit, zoom, pan"},
        BadCase{"NoNumber", "camera orbit 10 x", "column 17: ", "a number"},
        BadCase{"NotFinite", "camera orbit inf 0", "column 14: ", "a number"},
        BadCase{"NotANumber", "camera orbit nan 0", "column 14: ", "a number"},
        BadCase{"TooFew", "camera orbit 10", "column 16: ", "AZIMUTH ELEVATION"},
        BadCase{"TooMany", "camera frame now", "column 14: ", "nothing after camera frame"},
        BadCase{"ZoomOfZero", "camera zoom 0", "column 13: ", "a number from"},
        BadCase{"RadiusBelowZero", "sculpt pull -1 0.5 face:0:0:0:1",
                "column 13: ", "a number above 0"},
        BadCase{"HalfAPlace", "camera zoom 2 0.5", "column 15: ", "both RIGHT and UP"},
        BadCase{"SteepPlace", "camera place 0 91 1 0 0", "column 16: ", "-90 to 90"},
        BadCase{"OpenNothing", "open", "column 5: ", "open MODEL"},
        BadCase{"OpenTwo", "open a b", "column 8: ", "open MODEL"},
        BadCase{"QuoteNotClosed", "open \"a b", "column 6: ", "not closed"},
        BadCase{"QuoteWithin", "open a\"b", "column 7: ", "double quotes"},
        BadCase{"ZeroByteInAPath", "save session \"new.sh\\x00.geotherm\"",
                "column 14: ", "zero byte"},
        BadCase{"ZeroByteInAModel", "open \"a\\x00b\"", "column 6: ", "zero byte"},
        BadCase{"TextAfterQuote", "open \"a\"b", "column 9: ", "blank"},
        BadCase{"StrangeEscape", "open \"a\\q\"", "column 8: ", "\\\\"},
        BadCase{"BadSource", "source set 17 -3", "column 15: ", "is no source"},
        BadCase{"BadIndex", "source remove -1", "column 15: ", "number of a source"},
        BadCase{"BadCurve", "source extend 1,x", "column 15: ", "vertex ids"},
        BadCase{"PickAVertex", "pick 17", "column 6: ", "face:ID:b0:b1:b2"},
        BadCase{"ShowWhat", "show c", "column 6: ", "a or b or difference"},
        BadCase{"RotateWhat", "rotate maybe", "column 8: ", "on or off"},
        BadCase{"PictureSizeInParts", "save picture a.png 1e3x20", "column 20: ", "is no size"},
        BadCase{"PictureSizeOfTwoKinds", "save picture a.png 8cmx600", "column 20: ", "is no size"},
        BadCase{"PictureSize", "save picture a.png 0x3", "column 20: ", "is no size"},
        BadCase{"PictureWord", "save picture a.png 3x3 all", "column 24: ", "panels"},
        BadCase{"SettingWithout", "view", "column 5: ", "one value"},
        BadCase{"SettingTwo", "view flat smooth", "column 6: ", "one value"},
        BadCase{"SettingValue", "constraint glue", "column 12: ", "pin-sources"},
        BadCase{"BackendName", "backend gpu", "column 9: ", "eigen-ldlt"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(Script, SkipsBlankLinesAndComments) {
  const auto lines = parse_script("# head\n\n  open bunny # here\r\n\t\nview flat", "s");
  ASSERT_TRUE(lines) << lines.error().message;
  ASSERT_EQ(lines->size(), 2U);
  EXPECT_EQ((*lines)[0].number, 3);
  EXPECT_EQ((*lines)[0].command, Command(Open{"bunny"}));
  EXPECT_EQ((*lines)[1].number, 5);
}

TEST(Script, ABadLineNamesFileLineAndColumn) {
  const auto lines = parse_script("open bunny\ncamera orbit 1 b\n", "dir/s.txt");
  ASSERT_FALSE(lines);
  EXPECT_EQ(sentence(lines.error()).find("dir/s.txt: line 2, column 16: "), 0U)
      << lines.error().message;
  EXPECT_EQ(lines.error().code, ErrorCode::kBadFile);
}

TEST(Script, AnyBytesGiveCommandsOrOneLineOfError) {
  std::mt19937 random(11);
  const std::string alphabet = "open \"\\#\n\t0 1.5:,xface:camera-\xff\x01";
  std::uniform_int_distribution<std::size_t> letter(0, alphabet.size() - 1);
  for (int i = 0; i < 3000; ++i) {
    std::string text;
    for (int k = 0; k < 40; ++k) text += alphabet[letter(random)];
    const auto lines = parse_script(text, "fuzz");
    if (!lines) {
      EXPECT_EQ(sentence(lines.error()).find('\n'), std::string::npos);
    }
  }
}

using Words = std::vector<std::string>;

TEST(Completions, AreCommandsAndSettingsThatBeginSo) {
  EXPECT_EQ(completions("ope"), Words{"open"});
  EXPECT_EQ(completions("time-f"), Words{"time-factor"});
  const Words all = completions("s");
  EXPECT_NE(std::ranges::find(all, "source"), all.end());
  EXPECT_NE(std::ranges::find(all, "save"), all.end());
  EXPECT_NE(std::ranges::find(all, "slice"), all.end());
  EXPECT_EQ(completions("nothing"), Words{});
}

TEST(Completions, AreSecondWordsAndValues) {
  EXPECT_EQ(completions("source s"), (Words{"set", "shuffle"}));
  EXPECT_EQ(completions("show "), (Words{"a", "b", "difference"}));
  EXPECT_EQ(completions("rotate o"), (Words{"on", "off"}));
  EXPECT_EQ(completions("view con"), Words{"contours"});
  EXPECT_EQ(completions("bar o"), (Words{"on", "off"}));
  EXPECT_EQ(completions("target "), Words{});
  EXPECT_EQ(completions("open gargo"), Words{"gargoyle"});
  EXPECT_EQ(completions("source set ra"), Words{"random:"});
  EXPECT_EQ(completions("source set sa"), Words{"sample:"});
  EXPECT_EQ(completions("source add 3 bou"), Words{"boundary"});
  const std::string folder = testing::TempDir() + "geotherm_completions/";
  std::filesystem::create_directories(folder + "inner");
  std::ofstream(folder + "walk.geotherm") << "reset\n";
  EXPECT_EQ(completions("run " + folder), (Words{folder + "inner/", folder + "walk.geotherm"}));
  std::filesystem::remove_all(folder);
  EXPECT_EQ(completions("open bun"), Words{"bunny"});
}

}  // namespace
}  // namespace geotherm::app
