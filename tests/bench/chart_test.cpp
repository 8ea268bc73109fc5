// SPDX-License-Identifier: MIT
#include "bench/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "app/picture/chart.h"
#include "tests/bench/bench_fixture.h"

namespace geotherm::test {
namespace {

using bench::BenchRun;
using bench::performance_chart;

struct Element {
  std::string name;
  std::string content = {};
  std::map<std::string, std::string> attributes = {};
};

/// All elements in order, or a failure where tags do not match, attributes are not quoted or a
/// character is not escaped.
std::vector<Element> elements_of(const std::string& text) {
  static const std::regex kTag(R"re(<(/?)([a-z]+)((?: [a-zA-Z0-9-]+="[^"<>]*")*)(/?)>)re");
  static const std::regex kAttribute(R"re( ([a-zA-Z0-9-]+)="([^"]*)")re");
  static const std::regex kEntity("&(amp|lt|gt|quot);");
  constexpr auto kHere = std::regex_constants::match_continuous;
  std::vector<Element> out;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < text.size();) {
    std::smatch match;
    const auto begin = text.begin() + static_cast<std::ptrdiff_t>(i);
    if (text[i] == '<') {
      if (!std::regex_search(begin, text.end(), match, kTag, kHere)) {
        ADD_FAILURE() << "not a tag: " << text.substr(i, 80);
        return {};
      }
      if (match[1].length() > 0) {
        if (open.empty() || out[open.back()].name != match[2]) {
          ADD_FAILURE() << "nothing to close at " << text.substr(i, 80);
          return {};
        }
        open.pop_back();
      } else {
        Element element{.name = match[2]};
        const std::string attributes = match[3];
        for (std::sregex_iterator a(attributes.begin(), attributes.end(), kAttribute), end;
             a != end; ++a) {
          EXPECT_TRUE(element.attributes.emplace((*a)[1], (*a)[2]).second)
              << "twice: " << *a->begin();
        }
        out.push_back(std::move(element));
        if (match[4].length() == 0) open.push_back(out.size() - 1);
      }
      i += static_cast<std::size_t>(match.length());
      continue;
    }
    if (text[i] == '&') {
      EXPECT_TRUE(std::regex_search(begin, text.end(), match, kEntity, kHere))
          << text.substr(i, 20);
    }
    if (!open.empty()) out[open.back()].content += text[i];
    ++i;
  }
  EXPECT_TRUE(open.empty()) << "not closed";
  return out;
}

/// Every number in the attributes that are places is finite, and on the page.
void expect_places_on_page(const std::vector<Element>& elements) {
  ASSERT_FALSE(elements.empty());
  const double width = std::stod(elements[0].attributes.at("width"));
  const double height = std::stod(elements[0].attributes.at("height"));
  static const std::regex kNumber(R"(^-?[0-9]+\.[0-9]$)");
  const auto expect_place = [](const std::string& text, double most) {
    ASSERT_TRUE(std::regex_match(text, kNumber)) << text;
    EXPECT_GE(std::stod(text), 0);
    EXPECT_LE(std::stod(text), most);
  };
  for (const Element& e : elements) {
    for (const auto& [name, value] : e.attributes) {
      if (name == "x" || name == "x1" || name == "x2" || name == "cx") expect_place(value, width);
      if (name == "y" || name == "y1" || name == "y2" || name == "cy") expect_place(value, height);
      if (name != "points") continue;
      static const std::regex kPoint("([^ ,]+),([^ ,]+)");
      for (std::sregex_iterator p(value.begin(), value.end(), kPoint), end; p != end; ++p) {
        expect_place((*p)[1], width);
        expect_place((*p)[2], height);
      }
    }
  }
}

std::vector<std::string> labels(const std::vector<Element>& elements, const std::string& kind) {
  std::vector<std::string> out;
  for (const Element& e : elements) {
    const auto found = e.attributes.find("class");
    if (e.name == "text" && found != e.attributes.end() && found->second == kind) {
      out.push_back(e.content);
    }
  }
  return out;
}

TEST(PerformanceChart, IsWellFormedAndOnThePage) {
  expect_places_on_page(elements_of(performance_chart(sample_run())));
}

TEST(PerformanceChart, IsWellFormedWhateverIsMissing) {
  for (unsigned hole = 0; hole < 64; ++hole) {
    BenchRun run = sample_run();
    unsigned bits = hole * 2654435761u;
    for (bench::SolveGroup& group : run.groups) {
      for (bench::Figures& f : group.figures) {
        for (double* figure : {&f.setup_ms, &f.query_ms, &f.batch_ms_per_source, &f.factor_mb}) {
          bits = bits * 1664525u + 1013904223u;
          if (bits >> 30 == 0) *figure = bench::kNotMeasured;
          if (bits >> 30 == 1) *figure = 0;
          if (bits >> 29 == 4) *figure = INFINITY;
        }
      }
    }
    expect_places_on_page(elements_of(performance_chart(run)));
  }
}

TEST(PerformanceChart, OfNothingSaysThatNothingWasMeasured) {
  const auto elements = elements_of(performance_chart(BenchRun{}));
  expect_places_on_page(elements);
  const std::vector<std::string> said = labels(elements, "soft");
  EXPECT_EQ(std::ranges::count(said, "not measured"), 4);
}

TEST(PerformanceChart, OfOneMeshHasAPlaceForIt) {
  BenchRun run = sample_run();
  run.groups.resize(1);
  expect_places_on_page(elements_of(performance_chart(run)));
}

TEST(PerformanceChart, SaysAtEachEndHowItIsToTheBaseline) {
  const std::vector<std::string> ends = labels(elements_of(performance_chart(sample_run())), "end");
  EXPECT_EQ(std::ranges::count(ends, "quick 4.0\u00d7"), 3);
  EXPECT_EQ(std::ranges::count(ends, "quick 50 %"), 1);
  EXPECT_EQ(std::ranges::count(ends, "slow 1.3\u00d7"), 3);  // where its line ends, not later
  EXPECT_EQ(std::ranges::count(ends, "baseline"), 4);
}

TEST(PerformanceChart, NamesOfAnyKindAreEscaped) {
  BenchRun run = sample_run();
  run.machine.cpu = "a <fast> & \"good\" one";
  for (bench::SolveGroup& group : run.groups) group.figures[0].name = "<&\">";
  expect_places_on_page(elements_of(performance_chart(run)));
}

class Panel : public testing::TestWithParam<double> {};

TEST_P(Panel, LabelsOfLinesThatEndTogetherStandApart) {
  app::chart::Panel panel{"title",
                          "x",
                          [](double) { return std::string("1"); },
                          [](double) { return std::string("1"); },
                          {}};
  for (int k = 0; k < 6; ++k) {
    app::chart::Series series{.kind = "k" + std::to_string(k)};
    series.joined = {{1e4, 10.0 + k}, {GetParam(), 1000 + 0.1 * k}};
    series.end_label = "label";
    panel.series.push_back(series);
  }
  panel.series.push_back(
      {.kind = "base", .joined = {{1e4, 1e-3}, {1e6, 1e-3}}, .end_label = "low"});
  const auto elements =
      elements_of("<svg>" + app::chart::panel_svg(panel, {100, 100, 300, 200}) + "</svg>");
  std::vector<double> heights;
  for (const Element& e : elements) {
    const auto kind = e.attributes.find("class");
    if (e.name == "text" && kind != e.attributes.end() && kind->second == "end") {
      heights.push_back(std::stod(e.attributes.at("y")));
    }
  }
  ASSERT_EQ(heights.size(), 7u);
  std::ranges::sort(heights);
  constexpr double kLetters = 13;  // pixels
  for (std::size_t i = 1; i < heights.size(); ++i) {
    EXPECT_GE(heights[i] - heights[i - 1], kLetters);
  }
}

TEST(PanelLabels, ThatReachTheRightStandApartFromThoseThere) {
  app::chart::Panel panel{"title",
                          "x",
                          [](double) { return std::string("1"); },
                          [](double) { return std::string("1"); },
                          {}};
  panel.series.push_back({.kind = "a", .joined = {{1e4, 1}, {1e6, 100}}, .end_label = "right"});
  panel.series.push_back(
      {.kind = "b", .joined = {{1e4, 10}, {5e5, 100}}, .end_label = "a long label"});
  panel.series.push_back({.kind = "c", .joined = {{1e4, 100}}, .end_label = "left"});
  std::map<std::string, double> height;
  const auto elements =
      elements_of("<svg>" + app::chart::panel_svg(panel, {100, 100, 300, 200}) + "</svg>");
  for (const Element& e : elements) {
    const auto kind = e.attributes.find("class");
    if (e.name == "text" && kind != e.attributes.end() && kind->second == "end") {
      height[e.content] = std::stod(e.attributes.at("y"));
    }
  }
  ASSERT_EQ(height.size(), 3u);
  EXPECT_GE(std::abs(height["right"] - height["a long label"]), 13);
  EXPECT_EQ(height["left"], std::min(height["right"], height["a long label"]));  // not moved
}

// At the right border, and half way there.
INSTANTIATE_TEST_SUITE_P(Ends, Panel, testing::Values(1e6, 1e5));

}  // namespace
}  // namespace geotherm::test
