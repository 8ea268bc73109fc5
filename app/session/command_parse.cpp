// SPDX-License-Identifier: MIT
#include <algorithm>
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
namespace command {
namespace {

/// A command: a first word, or a first and a second one, and what follows it.
struct Form {
  std::string_view name;       ///< "camera orbit"
  std::string_view arguments;  ///< "AZIMUTH ELEVATION"
  std::size_t least, most;     ///< number of arguments
  Result<Command> (*read)(WordReader& reader);
  /// The arguments, a blank before each; none: the command is not of this form.
  std::optional<std::string> (*write)(const Command& command);
};

constexpr std::size_t kAny = 1'000'000;

std::string argument_text(double number) { return " " + number_text(number); }
std::string argument_text(int index) { return " " + std::to_string(index); }
std::string argument_text(bool on) { return on ? " on" : " off"; }
std::string argument_text(const std::string& text) { return " " + command_word(text); }
std::string argument_text(const SourceSpec& source) { return " " + to_text(source); }
std::string argument_text(const FacePoint& point) { return argument_text(SourceSpec(point)); }

template <Named Enum>
std::string argument_text(Enum value) {
  return " " + geotherm::to_text(value);
}

template <class Value>
std::string argument_text(const std::optional<Value>& value) {
  return argument_text(*value);
}

template <class Value>
std::string argument_text(const std::vector<Value>& all) {
  std::string text;
  for (const Value& value : all) text += argument_text(value);
  return text;
}

template <class Kind, class Value>
Kind kind_of(Value Kind::*member);  // for its type alone

template <class Kind, auto... kMembers>
Result<Command> read_members(WordReader& reader) {
  Kind kind;
  Result<void> taken;
  if (!((taken = reader.take(kind.*kMembers)) && ...)) return taken.error();
  return Command(std::move(kind));
}

template <class Kind, auto... kMembers>
std::optional<std::string> write_members(const Command& command) {
  const auto* const kind = std::get_if<Kind>(&command);
  if (kind == nullptr) return std::nullopt;
  return (std::string() + ... + argument_text(kind->*kMembers));
}

/// Without arguments.
template <class Kind>
constexpr Form form_of(std::string_view name) {
  return {name, "", 0, 0, read_members<Kind>, write_members<Kind>};
}

/// An argument for each member; a list, the last one, takes all words that are left.
template <auto kFirst, auto... kMore>
constexpr Form form_of(std::string_view name, std::string_view arguments) {
  using Kind = decltype(kind_of(kFirst));
  const std::size_t least = 1 + sizeof...(kMore);
  const std::size_t most = arguments.ends_with("...") ? kAny : least;
  return {name,
          arguments,
          least,
          most,
          read_members<Kind, kFirst, kMore...>,
          write_members<Kind, kFirst, kMore...>};
}

/// One argument; `none` is what the member is at first.
template <auto kMember, auto kRead = read_members<decltype(kind_of(kMember)), kMember>>
constexpr Form form_or_none(std::string_view name, std::string_view arguments) {
  using Kind = decltype(kind_of(kMember));
  Form form = form_of<kMember>(name, arguments);
  form.read = [](WordReader& reader) -> Result<Command> {
    if (reader.peek() == "none") return Command(Kind());
    return kRead(reader);
  };
  form.write = [](const Command& command) -> std::optional<std::string> {
    const auto* const kind = std::get_if<Kind>(&command);
    if (kind != nullptr && kind->*kMember == Kind().*kMember) return " none";
    return write_members<Kind, kMember>(command);
  };
  return form;
}

Result<Command> read_extend(WordReader& reader) {
  if (reader.peek().starts_with("face:")) {
    auto curve = parse_source("curve:" + reader.next());
    if (!curve) return reader.blame_last(curve.error());
    return Command(ExtendCurve{{}, std::get<SurfaceCurve>(*std::move(curve)).points});
  }
  const auto vertices = reader.vertices();
  if (!vertices) return vertices.error();
  return Command(ExtendCurve{*vertices});
}

std::optional<std::string> write_extend(const Command& command) {
  const auto* const curve = std::get_if<ExtendCurve>(&command);
  if (curve == nullptr) return std::nullopt;
  std::vector<std::string> parts;
  for (const Index v : curve->vertices) parts.push_back(std::to_string(v));
  for (const FacePoint& point : curve->points) parts.push_back(to_text(SourceSpec(point)));
  return argument_text(joined(parts, ","));
}

template <SculptTool kTool>
Result<Command> read_sculpt(WordReader& reader) {
  Stroke stroke;
  stroke.tool = kTool;
  constexpr double kAboveZero = std::numeric_limits<double>::min();
  if (auto taken = reader.take(stroke.radius, kAboveZero); !taken) return taken.error();
  if (auto taken = reader.take(stroke.strength, 0, 1); !taken) return taken.error();
  if (auto taken = reader.take(stroke.points); !taken) return taken.error();
  return Command(Sculpt{std::move(stroke)});
}

template <SculptTool kTool>
std::optional<std::string> write_sculpt(const Command& command) {
  const auto* const sculpt = std::get_if<Sculpt>(&command);
  if (sculpt == nullptr || sculpt->stroke.tool != kTool) return std::nullopt;
  const Stroke& stroke = sculpt->stroke;
  return argument_text(stroke.radius) + argument_text(stroke.strength) +
         argument_text(stroke.points);
}

Result<Command> read_zoom(WordReader& reader) {
  Zoom zoom;
  auto factor = reader.take(zoom.factor, kMinZoom / kMaxZoom, kMaxZoom / kMinZoom);
  if (!factor) return factor.error();
  if (reader.at_end()) return Command(zoom);
  if (reader.left() == 1) return reader.fail("both RIGHT and UP, or neither");
  if (auto taken = reader.take(zoom.right); !taken) return taken.error();
  if (auto taken = reader.take(zoom.up); !taken) return taken.error();
  return Command(zoom);
}

std::optional<std::string> write_zoom(const Command& command) {
  const auto* const zoom = std::get_if<Zoom>(&command);
  if (zoom == nullptr) return std::nullopt;
  const bool in_middle = zoom->right == 0 && zoom->up == 0;
  return argument_text(zoom->factor) +
         (in_middle ? "" : argument_text(zoom->right) + argument_text(zoom->up));
}

Result<Command> read_place(WordReader& reader) {
  Place place;
  if (auto taken = reader.take(place.azimuth, -kMaxAngle, kMaxAngle); !taken) return taken.error();
  if (auto taken = reader.take(place.elevation, -90, 90); !taken) return taken.error();
  if (auto taken = reader.take(place.zoom, kMinZoom, kMaxZoom); !taken) return taken.error();
  if (auto taken = reader.take(place.right, -kMaxPan, kMaxPan); !taken) return taken.error();
  if (auto taken = reader.take(place.up, -kMaxPan, kMaxPan); !taken) return taken.error();
  return Command(place);
}

Result<Command> read_max_distance(WordReader& reader) {
  const auto most = parse_max_distance(reader.next());
  if (!most) return reader.blame_last(most.error());
  return Command(MaxDistance{*most});
}

Result<Command> read_compare(WordReader& reader) {
  return Command(reader.at_end() ? Compare{} : Compare{reader.next()});
}

Result<Command> read_save_picture(WordReader& reader) {
  SavePicture save{reader.next()};
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

std::optional<std::string> write_save_picture(const Command& command) {
  const auto* const save = std::get_if<SavePicture>(&command);
  if (save == nullptr) return std::nullopt;
  return argument_text(save->path) + (save->size ? " " + size_text(*save->size) : "") +
         (save->panels ? " panels" : "");
}

constexpr std::string_view kStroke = "RADIUS STRENGTH POINT...";

using enum SculptTool;

constexpr Form kForms[] = {
    form_of<&Open::model>("open", "MODEL"),
    form_of<Reset>("reset"),
    form_of<&Run::path>("run", "FILE"),
    form_of<&SetSources::sources>("source set", "SOURCE..."),
    form_of<&AddSources::sources>("source add", "SOURCE..."),
    form_of<&MoveSource::index, &MoveSource::source>("source move", "INDEX SOURCE"),
    form_of<&RemoveSource::index>("source remove", "INDEX"),
    {"source extend", "V,V,...|face:ID:b0:b1:b2,...", 1, 1, read_extend, write_extend},
    form_of<ClearSources>("source clear"),
    form_of<MoreSources>("source more"),
    form_of<FewerSources>("source fewer"),
    form_of<ShuffleSources>("source shuffle"),
    form_or_none<&ShowCentre::kind>("source centre", "mean|median|none"),
    {"sculpt pull", kStroke, 3, kAny, read_sculpt<kPull>, write_sculpt<kPull>},
    {"sculpt push", kStroke, 3, kAny, read_sculpt<kPush>, write_sculpt<kPush>},
    {"sculpt smooth", kStroke, 3, kAny, read_sculpt<kSmooth>, write_sculpt<kSmooth>},
    form_of<&ExtendStroke::points>("sculpt extend", "POINT..."),
    form_or_none<&ShowSequence::path>("sequence", "FRAMES|none"),
    form_of<&ShowFrame::index>("frame", "INDEX"),
    form_of<&Play::on>("play", "on|off"),
    form_of<&Loop::on>("loop", "on|off"),
    form_of<&Orbit::azimuth, &Orbit::elevation>("camera orbit", "AZIMUTH ELEVATION"),
    {"camera zoom", "FACTOR [RIGHT UP]", 1, 3, read_zoom, write_zoom},
    form_of<&Pan::right, &Pan::up>("camera pan", "RIGHT UP"),
    form_of<&Centre::x, &Centre::y, &Centre::z>("camera centre", "X Y Z"),
    {"camera place", "AZIMUTH ELEVATION ZOOM RIGHT UP", 5, 5, read_place,
     write_members<Place, &Place::azimuth, &Place::elevation, &Place::zoom, &Place::right,
                   &Place::up>},
    form_of<Frame>("camera frame"),
    form_of<&Rotate::on>("rotate", "on|off"),
    form_of<Keep>("keep"),
    form_of<Forget>("forget"),
    form_of<Swap>("swap"),
    form_of<&Show::shown>("show", "a|b|difference"),
    form_of<Flip>("flip"),
    form_or_none<&Pick::point>("pick", "face:ID:b0:b1:b2|none"),
    form_or_none<&Target::point>("target", "POINT|none"),
    form_or_none<&ShowField::path>("field", "FILE|none"),
    form_or_none<&MaxDistance::most, read_max_distance>("max-distance", "R|none"),
    {"compare", "[all|NAME,NAME...]", 0, 1, read_compare,
     write_members<Compare, &Compare::backends>},
    {"save picture", "FILE [SIZE] [panels]", 1, 3, read_save_picture, write_save_picture},
    form_of<&SaveDistances::path>("save distances", "FILE"),
    form_of<&SaveMesh::path>("save mesh", "FILE"),
    form_of<&SaveSession::path>("save session", "FILE"),
    form_of<&SaveLog::path>("save log", "FILE"),
    form_of<&SaveFigures::path>("save figures", "FILE"),
    form_of<Undo>("undo"),
    form_of<Redo>("redo"),
    form_of<Quit>("quit"),
};

}  // namespace
}  // namespace command

namespace {

using command::Form;
using command::kForms;

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

std::string to_text(const Command& command) {
  if (const auto* const set = std::get_if<command::Set>(&command)) {
    return set->name + " " + command_word(set->value);
  }
  for (const Form& form : kForms) {
    if (const auto arguments = form.write(command)) return std::string(form.name) + *arguments;
  }
  return {};  // not reached: every other command has a form
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
