// SPDX-License-Identifier: MIT
#include "app/text/text.h"

#include <gtest/gtest.h>

#include <limits>

#include "app/session/progress.h"
#include "app/session/report.h"

namespace geotherm::test {
namespace {

using namespace geotherm::app;

TEST(NumbersInText, AreGroupedInThrees) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(-1234567), "-1,234,567");
}

TEST(NumbersInText, ShowThreeDigitsOfATime) {
  EXPECT_EQ(milliseconds(0.0123), "0.012");
  EXPECT_EQ(milliseconds(0.9996), "1.00");
  EXPECT_EQ(milliseconds(9.996), "10.0");
  EXPECT_EQ(milliseconds(34.56), "34.6");
  EXPECT_EQ(milliseconds(99.96), "100");
  EXPECT_EQ(milliseconds(2329.6), "2,330");
  EXPECT_EQ(milliseconds(0), "0");
}

TEST(NumbersInText, AreReadWholeOrNotAtAll) {
  EXPECT_EQ(number_in<int>("12"), 12);
  EXPECT_EQ(number_in<int>("+12"), 12);
  EXPECT_EQ(number_in<double>("-1.5e3"), -1500.0);
  for (const char* text : {"", "+", "+-1", "12x", " 12", "1,5", "0x1"}) {
    EXPECT_FALSE(number_in<double>(text)) << text;
  }
}

TEST(TextLines, AreWrappedAtBlanks) {
  EXPECT_EQ(wrapped("aa bb cc dd", 6), "aa bb\ncc dd");
  EXPECT_EQ(wrapped("a-long-word b", 4), "a-long-word\nb");
  EXPECT_EQ(wrapped("short", 40), "short");
}

TEST(TextLines, HoldNoControlCharacters) {
  EXPECT_EQ(one_line("a\nb\tc\x7f"), "a?b?c?");
  EXPECT_EQ(one_line("a\xc2\x9b"
                     "31mb"),
            "a??31mb")
      << "U+009B begins commands of a terminal";
  EXPECT_EQ(one_line("a\xe2\x80\xae"
                     "b\xe2\x80\xa8"),
            "a???b???")
      << "turns the line, ends it";
}

TEST(TextLines, AreUtf8) {
  const std::string good = "\xc3\xa4 \xc2\xa0 \xe6\xbc\xa2 \xf0\x9f\x90\x87 \xee\x80\x80";
  EXPECT_EQ(one_line(good), good);
  for (const char* const bad : {"\xff", "\xc3", "\xe6\xbc", "\xc0\xaf", "\xe0\x80\xaf",
                                "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xef\xbf\xbf"}) {
    const std::string shown = one_line(std::string("a") + bad + "b");
    EXPECT_EQ(shown, "a" + std::string(std::string_view(bad).size(), '?') + "b");
  }
}

TEST(Markup, HoldsNothingThatXmlForbids) {
  EXPECT_EQ(escaped("<a\x01\xff&\xc2\x85\">"), "&lt;a??&amp;??&quot;&gt;");
}

TEST(TextTables, AlignTheirColumns) {
  TextTable table({{"name", TextTable::Align::kLeft}, {"ms", TextTable::Align::kRight}});
  table.add_row({"a", "1,000"});
  table.add_row({"\xc3\xa4\xc3\xb6", "2"});  // two characters of two bytes each
  EXPECT_EQ(table.text(), "name     ms\na     1,000\n\xc3\xa4\xc3\xb6        2\n");
}

TEST(ShellCommand, QuotesWhatAShellWouldTakeApart) {
  EXPECT_EQ(shell_command("geotherm", {"render", "a b.obj", "it's", "", "-s", "3,9"}),
            "geotherm render 'a b.obj' 'it'\\''s' '' -s 3,9");
  EXPECT_EQ(shell_command("g", {"\xc3\xa4.obj"}), "g '\xc3\xa4.obj'");
  EXPECT_EQ(shell_command("g", {"=a.obj", "b=a"}), "g '=a.obj' b=a") << "zsh: the path of a.obj";
  EXPECT_EQ(shell_command("g", {"new\nline", "a\xff\\b"}), "g $'new\\012line' $'a\\377\\\\b'");
}

TEST(ProgressLines, ShowTheShareThatIsDone) {
  EXPECT_EQ(ProgressBar::line("solve", -1), "solve ...");
  const std::string half = ProgressBar::line("solve", 0.5);
  EXPECT_EQ(std::count(half.begin(), half.end(), '='), 15);
  EXPECT_TRUE(half.ends_with("]  50 %")) << half;
  EXPECT_TRUE(ProgressBar::line("solve", 7).ends_with("] 100 %"));
}

TEST(JsonText, ReadsBackAsTheSameDoublesAndHasNullForWhatIsNotFinite) {
  const double third = 1.0 / 3;
  const Json json = {{"a", {{"b", third}, {"c", {1, 2}}, {"d", std::nan("")}}},
                     {"e", std::numeric_limits<double>::infinity()}};
  const std::string text = app::to_text(json);
  const Json back = Json::parse(text);
  EXPECT_EQ(back["a"]["b"].get<double>(), third);
  EXPECT_TRUE(back["a"]["d"].is_null());
  EXPECT_TRUE(back["e"].is_null());
  EXPECT_NE(text.find("\"c\": [1,2]"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("}\n"));
}

TEST(JsonText, SurvivesNamesThatAreNoUtf8) {
  EXPECT_TRUE(Json::accept(app::to_text(Json{{"name", "a\xff\"b"}})));
}

}  // namespace
}  // namespace geotherm::test
