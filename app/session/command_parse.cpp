// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "app/picture/picture_text.h"
#include "app/session/command.h"
#include "app/session/command_words.h"
#include "app/session/model.h"
#include "app/session/settings.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/core/text.h"

namespace geotherm::app {
namespace {

/// A first word, or a first and a second one, and what follows it.
struct Form {
  std::string_view name;       ///< "camera orbit"
  std::string_view arguments;  ///< "AZIMUTH ELEVATION"
  std::size_t least, most;     ///< number of arguments
  Result<Command> (*read)(WordReader& reader);
};

template <class Kind>
Result<Command> plain(WordReader&) {
  return Command(Kind{});
}

template <class Kind>
Result<Command> with_text(WordReader& reader) {
  return Command(Kind{reader.next()});
}

template <class Kind>
Result<Command> with_list(WordReader& reader) {
  Kind kind;
  while (!reader.at_end()) {
    auto source = reader.source();
    if (!source) return source.error();
    kind.sources.push_back(*std::move(source));
  }
  return Command(kind);
}

/// As many numbers as there are words.
Result<std::vector<double>> all_numbers(WordReader& reader) {
  std::vector<double> numbers;
  while (!reader.at_end()) {
    const auto number = reader.number(-kLargestNumber, kLargestNumber);
    if (!number) return number.error();
    numbers.push_back(*number);
  }
  return numbers;
}

Result<Command> read_move(WordReader& reader) {
  const auto index = reader.whole();
  if (!index) return index.error();
  const auto source = reader.source();
  if (!source) return source.error();
  return Command(command::MoveSource{*index, *source});
}

Result<Command> read_remove(WordReader& reader) {
  const auto index = reader.whole();
  if (!index) return index.error();
  return Command(command::RemoveSource{*index});
}

Result<Command> read_extend(WordReader& reader) {
  if (reader.peek().starts_with("face:")) {
    auto curve = parse_source("curve:" + reader.next());
    if (!curve) return reader.blame_last(curve.error());
    return Command(command::ExtendCurve{{}, std::get<SurfaceCurve>(*std::move(curve)).points});
  }
  const auto vertices = reader.vertices();
  if (!vertices) return vertices.error();
  return Command(command::ExtendCurve{*vertices});
}

/// As many points as there are words.
Result<std::vector<FacePoint>> all_points(WordReader& reader) {
  std::vector<FacePoint> points;
  while (!reader.at_end()) {
    const auto point = reader.face_point();
    if (!point) return reader.fail("a point in a face, face:ID:b0:b1:b2");
    if (point->offset != 0) {
      return reader.blame_last({ErrorCode::kBadInput, "a touch has no offset"});
    }
    points.push_back(*point);
  }
  return points;
}

template <SculptTool kTool>
Result<Command> read_sculpt(WordReader& reader) {
  const auto radius = reader.number(std::numeric_limits<double>::min(), kLargestNumber);
  if (!radius) return radius.error();
  const auto strength = reader.number(0, 1);
  if (!strength) return strength.error();
  auto points = all_points(reader);
  if (!points) return points.error();
  return Command(command::Sculpt{{kTool, *radius, *strength, *std::move(points)}});
}

Result<Command> read_extend_stroke(WordReader& reader) {
  auto points = all_points(reader);
  if (!points) return points.error();
  return Command(command::ExtendStroke{*std::move(points)});
}

template <class Kind>
Result<Command> with_path(WordReader& reader) {
  const std::string& path = reader.next();
  return Command(Kind{path == "none" ? "" : path});
}

Result<Command> read_frame(WordReader& reader) {
  const auto index = reader.whole("the number of a frame, from 0");
  if (!index) return index.error();
  return Command(command::ShowFrame{*index});
}

template <class Kind>
Result<Command> read_switch(WordReader& reader) {
  const auto on = reader.one_of({"on", "off"});
  if (!on) return on.error();
  return Command(Kind{*on == "on"});
}

template <class Kind, std::size_t... k>
Result<Command> of_numbers(WordReader& reader, std::index_sequence<k...>) {
  const auto n = all_numbers(reader);
  if (!n) return n.error();
  return Command(Kind{(*n)[k]...});
}

template <class Kind, std::size_t kCount>
Result<Command> with_numbers(WordReader& reader) {
  return of_numbers<Kind>(reader, std::make_index_sequence<kCount>());
}

Result<Command> read_zoom(WordReader& reader) {
  const auto factor = reader.number(kMinZoom / kMaxZoom, kMaxZoom / kMinZoom);
  if (!factor) return factor.error();
  if (reader.left() == 1) return reader.fail("both RIGHT and UP, or neither");
  const auto n = all_numbers(reader);
  if (!n) return n.error();
  return Command(n->empty() ? command::Zoom{*factor} : command::Zoom{*factor, (*n)[0], (*n)[1]});
}

Result<Command> read_place(WordReader& reader) {
  const auto azimuth = reader.number(-kMaxAngle, kMaxAngle);
  if (!azimuth) return azimuth.error();
  const auto elevation = reader.number(-90, 90);
  if (!elevation) return elevation.error();
  const auto zoom = reader.number(kMinZoom, kMaxZoom);
  if (!zoom) return zoom.error();
  const auto right = reader.number(-kMaxPan, kMaxPan);
  if (!right) return right.error();
  const auto up = reader.number(-kMaxPan, kMaxPan);
  if (!up) return up.error();
  return Command(command::Place{*azimuth, *elevation, *zoom, *right, *up});
}

Result<Command> read_show(WordReader& reader) {
  const auto shown = reader.one_of(all_names<Shown>());
  if (!shown) return shown.error();
  return Command(command::Show{*parse<Shown>(*shown)});
}

Result<Command> read_pick(WordReader& reader) {
  if (reader.peek() == "none") return Command(command::Pick{});
  const auto point = reader.face_point();
  if (!point) return point.error();
  return Command(command::Pick{*point});
}

Result<Command> read_target(WordReader& reader) {
  if (reader.peek() == "none") return Command(command::Target{});
  const auto point = reader.single_point();
  if (!point) return point.error();
  return Command(command::Target{*point});
}

Result<Command> read_source_centre(WordReader& reader) {
  std::vector<std::string> kinds = all_names<CentreKind>();
  kinds.emplace_back("none");
  const auto kind = reader.one_of(kinds);
  if (!kind) return kind.error();
  if (*kind == "none") return Command(command::ShowCentre{});
  return Command(command::ShowCentre{*parse<CentreKind>(*kind)});
}

Result<Command> read_max_distance(WordReader& reader) {
  if (reader.peek() == "none") return Command(command::MaxDistance{});
  const auto most = parse_max_distance(reader.next());
  if (!most) return reader.blame_last(most.error());
  return Command(command::MaxDistance{*most});
}

Result<Command> read_compare(WordReader& reader) {
  return Command(reader.at_end() ? command::Compare{} : command::Compare{reader.next()});
}

Result<Command> read_save_picture(WordReader& reader) {
  command::SavePicture save{reader.next()};
  if (!reader.at_end() && reader.peek() != "panels") {
    const auto size = parse_size(reader.next());
    if (!size) {
      Error error = reader.blame_last(size.error());
      error.hint.emplace_back(", or panels");
      return error;
    }
    save.size = *size;
  }
  if (!reader.at_end()) {
    if (auto panels = reader.one_of({"panels"}); !panels) return panels.error();
    save.panels = true;
  }
  return Command(save);
}

constexpr std::size_t kAny = 1'000'000;

const Form kForms[] = {
    {"open", "MODEL", 1, 1, with_text<command::Open>},
    {"reset", "", 0, 0, plain<command::Reset>},
    {"run", "FILE", 1, 1, with_text<command::Run>},
    {"source set", "SOURCE...", 1, kAny, with_list<command::SetSources>},
    {"source add", "SOURCE...", 1, kAny, with_list<command::AddSources>},
    {"source move", "INDEX SOURCE", 2, 2, read_move},
    {"source remove", "INDEX", 1, 1, read_remove},
    {"source extend", "V,V,...|face:ID:b0:b1:b2,...", 1, 1, read_extend},
    {"source clear", "", 0, 0, plain<command::ClearSources>},
    {"source more", "", 0, 0, plain<command::MoreSources>},
    {"source fewer", "", 0, 0, plain<command::FewerSources>},
    {"source shuffle", "", 0, 0, plain<command::ShuffleSources>},
    {"source centre", "mean|median|none", 1, 1, read_source_centre},
    {"sculpt pull", "RADIUS STRENGTH POINT...", 3, kAny, read_sculpt<SculptTool::kPull>},
    {"sculpt push", "RADIUS STRENGTH POINT...", 3, kAny, read_sculpt<SculptTool::kPush>},
    {"sculpt smooth", "RADIUS STRENGTH POINT...", 3, kAny, read_sculpt<SculptTool::kSmooth>},
    {"sculpt extend", "POINT...", 1, kAny, read_extend_stroke},
    {"sequence", "FRAMES|none", 1, 1, with_path<command::ShowSequence>},
    {"frame", "INDEX", 1, 1, read_frame},
    {"play", "on|off", 1, 1, read_switch<command::Play>},
    {"loop", "on|off", 1, 1, read_switch<command::Loop>},
    {"camera orbit", "AZIMUTH ELEVATION", 2, 2, with_numbers<command::Orbit, 2>},
    {"camera zoom", "FACTOR [RIGHT UP]", 1, 3, read_zoom},
    {"camera pan", "RIGHT UP", 2, 2, with_numbers<command::Pan, 2>},
    {"camera centre", "X Y Z", 3, 3, with_numbers<command::Centre, 3>},
    {"camera place", "AZIMUTH ELEVATION ZOOM RIGHT UP", 5, 5, read_place},
    {"camera frame", "", 0, 0, plain<command::Frame>},
    {"rotate", "on|off", 1, 1, read_switch<command::Rotate>},
    {"keep", "", 0, 0, plain<command::Keep>},
    {"forget", "", 0, 0, plain<command::Forget>},
    {"swap", "", 0, 0, plain<command::Swap>},
    {"show", "a|b|difference", 1, 1, read_show},
    {"flip", "", 0, 0, plain<command::Flip>},
    {"pick", "face:ID:b0:b1:b2|none", 1, 1, read_pick},
    {"target", "POINT|none", 1, 1, read_target},
    {"field", "FILE|none", 1, 1, with_path<command::ShowField>},
    {"max-distance", "R|none", 1, 1, read_max_distance},
    {"compare", "[all|NAME,NAME...]", 0, 1, read_compare},
    {"save picture", "FILE [SIZE] [panels]", 1, 3, read_save_picture},
    {"save distances", "FILE", 1, 1, with_text<command::SaveDistances>},
    {"save mesh", "FILE", 1, 1, with_text<command::SaveMesh>},
    {"save session", "FILE", 1, 1, with_text<command::SaveSession>},
    {"save log", "FILE", 1, 1, with_text<command::SaveLog>},
    {"save figures", "FILE", 1, 1, with_text<command::SaveFigures>},
    {"undo", "", 0, 0, plain<command::Undo>},
    {"redo", "", 0, 0, plain<command::Redo>},
    {"quit", "", 0, 0, plain<command::Quit>},
};

/// The first words of all forms, or the second words after `first`.
std::vector<std::string> names(std::string_view first) {
  std::vector<std::string> all;
  for (const Form& form : kForms) {
    const std::size_t blank = form.name.find(' ');
    const std::string_view head = form.name.substr(0, blank);
    if (!first.empty() && head != first) continue;
    std::string name(first.empty() ? head : form.name.substr(blank + 1));
    if (std::ranges::find(all, name) == all.end()) all.push_back(std::move(name));
  }
  return all;
}

/// What a word that is no command may have been: settings are too many to list.
std::string known_commands(std::string_view word) {
  std::vector<std::string> all = names("");
  for (const Setting& setting : settings()) all.emplace_back(setting.name);
  const std::string near = nearest_word(word, all);
  if (!near.empty()) return "did you mean " + near + "?";
  return "there are " + joined(names("")) + " and the settings, such as method or view";
}

Result<Command> read_setting(const Setting& setting, WordReader& reader) {
  const std::string name(setting.name);
  if (reader.left() != 1) return reader.fail("one value: " + name + " VALUE");
  const std::string value = reader.next();
  ViewerState scratch = initial_state();
  if (auto set = setting.set(scratch, value); !set) {
    return reader.blame_last(set.error());
  }
  return Command(command::Set{name, setting.get(scratch)});
}

/// The words that "on|off" or "FILE|none" allow.
std::vector<std::string> words_in(std::string_view arguments) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : std::string(arguments) + "|") {
    if (c >= 'a' && c <= 'z') {
      word += c;
    } else if (c == '|' && !word.empty()) {
      words.push_back(std::exchange(word, {}));
    } else if (c != '[' && c != ']') {
      return words;  // what follows is no fixed word
    }
  }
  return words;
}

}  // namespace

std::vector<std::string> completions(std::string_view line) {
  const std::size_t blank = line.rfind(' ');
  const bool first = blank == std::string_view::npos;
  const std::string_view begun = first ? line : line.substr(blank + 1);
  const std::string before(trimmed(first ? "" : line.substr(0, blank)));
  std::vector<std::string> all;
  if (first) {
    all = names("");
    for (const Setting& setting : settings()) all.emplace_back(setting.name);
  } else if (const Setting* setting = find_setting(before)) {
    if (setting->values != nullptr) all = setting->values();
    if (setting->kind == SettingKind::kSwitch) all = {"on", "off"};
  } else {
    const auto form = std::ranges::find(kForms, std::string_view(before), &Form::name);
    const bool whole = form != std::end(kForms);
    const bool group = std::ranges::any_of(
        kForms, [&](const Form& f) { return f.name.starts_with(before + ' '); });
    if (whole) all = words_in(form->arguments);
    if (group) all = names(before);
    if (before == "open") {
      for (const BundledModel& model : bundled_models()) all.emplace_back(model.name);
    }
    if (before == "open" || before == "run" || before == "sequence" || before == "field") {
      for (std::string& path : paths_that_begin(begun)) all.push_back(std::move(path));
    }
    if (before.starts_with("source set") || before.starts_with("source add")) {
      all = {"random:", "boundary", "curve:", "face:", "xyz:", "sample:"};
    }
  }
  std::erase_if(all, [&](const std::string& word) { return !word.starts_with(begun); });
  return all;
}

Result<Command> parse_command(std::string_view line) {
  auto made = WordReader::of(line);
  if (!made) return made.error();
  WordReader& reader = *made;
  if (reader.at_end()) return reader.fail("a command: " + joined(names("")));
  const std::string first = reader.next();
  if (const Setting* setting = find_setting(first)) return read_setting(*setting, reader);
  const bool is_group = std::ranges::any_of(
      kForms, [&first](const Form& form) { return form.name.starts_with(first + " "); });
  if (is_group && reader.at_end()) return reader.fail("what to do: " + joined(names(first)));
  const std::string name = is_group ? first + " " + reader.next() : first;
  const auto form = std::ranges::find(kForms, std::string_view(name), &Form::name);
  if (form == std::end(kForms)) {
    return reader.blame_last({ErrorCode::kBadInput,
                              "there is no command '" + one_line(name) + "'",
                              {is_group ? known_words(name.substr(first.size() + 1), names(first))
                                        : known_commands(first)}});
  }
  if (reader.left() < form->least || reader.left() > form->most) {
    reader.skip(std::min(reader.left(), form->most));  // to what is too much, or missing
    return reader.fail(form->arguments.empty() ? "nothing after " + name
                                               : name + " " + std::string(form->arguments));
  }
  return form->read(reader);
}

}  // namespace geotherm::app
