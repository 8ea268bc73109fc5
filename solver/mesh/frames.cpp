// SPDX-License-Identifier: MIT
#include "solver/mesh/frames.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <new>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "solver/core/text.h"
#include "solver/mesh/io/formats.h"
#include "solver/mesh/io/frame_array.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/raw_mesh.h"

namespace geotherm {
namespace {

namespace fs = std::filesystem;

Error no_numbers(const std::string& text, const std::string& why) {
  return {ErrorCode::kBadInput,
          io::printable(text) + ": " + why,
          {"write %d, or %04d for four digits, once in the file's name, such as frame_%04d.obj"}};
}

}  // namespace

bool is_numbered(const std::string& path) { return path.find('%') != std::string::npos; }

Result<NumberedPath> NumberedPath::parse(const std::string& text) {
  NumberedPath out;
  const std::size_t at = text.find('%');
  if (at == std::string::npos) return no_numbers(text, "has no place for a number");
  std::size_t end = at + 1;
  if (end + 1 < text.size() && text[end] == '0' && text[end + 1] >= '1' && text[end + 1] <= '9') {
    out.digits_ = text[end + 1] - '0';
    end += 2;
  }
  if (end >= text.size() || text[end] != 'd') {
    return no_numbers(text, "the number's place cannot be read");
  }
  out.text_ = text;
  out.before_ = text.substr(0, at);
  out.after_ = text.substr(end + 1);
  if (out.after_.find('%') != std::string::npos) {
    return no_numbers(text, "has several places for numbers");
  }
  if (out.after_.find('/') != std::string::npos) {
    return no_numbers(text, "has the number in the name of a folder");
  }
  return out;
}

std::string NumberedPath::path(std::int64_t number) const {
  const std::string digits = std::to_string(number);
  const auto missing = std::max<std::ptrdiff_t>(0, digits_ - std::ssize(digits));
  return before_ + std::string(static_cast<std::size_t>(missing), '0') + digits + after_;
}

Result<NumberedPath::Range> NumberedPath::find_files() const {
  const std::size_t slash = before_.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : before_.substr(0, slash + 1);
  const std::string start = slash == std::string::npos ? before_ : before_.substr(slash + 1);
  std::error_code failed;
  std::optional<Range> range;
  for (fs::directory_iterator entry(folder, failed), none; !failed && entry != none;
       entry.increment(failed)) {
    const std::string name = entry->path().filename().string();
    if (name.size() <= start.size() + after_.size() || !name.starts_with(start) ||
        !name.ends_with(after_)) {
      continue;
    }
    const std::string_view digits =
        std::string_view(name).substr(start.size(), name.size() - start.size() - after_.size());
    std::int64_t number = -1;
    const auto [end, wrong] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    const bool whole = wrong == std::errc() && end == digits.data() + digits.size();
    if (!whole || number < 0 || !path(number).ends_with(name)) continue;
    range = range ? Range{std::min(range->first, number), std::max(range->last, number)}
                  : Range{number, number};
  }
  if (failed) {
    return Error{
        ErrorCode::kBadFile,
        io::printable(text_) + ": folder " + io::printable(folder) + ": " + failed.message(),
        {"check the path"}};
  }
  if (range) return *range;
  return Error{ErrorCode::kBadFile,
               io::printable(text_) + ": there is no such file, whatever the number",
               {"check the path and how many digits the numbers have"}};
}

namespace {

Error other_mesh(const std::string& what) {
  return {ErrorCode::kBadFile, what, {"all frames have the vertices and faces of the model"}};
}

/// Whether so many triangles have the same corners, one polygon's.
bool same_corners(std::span<const Face> fan, std::span<const Face> cut, const TriangleMesh& mesh) {
  std::vector<Index> a, b;
  for (const Face& face : fan) {
    for (const Index v : face) a.push_back(mesh.standing_for(v));
  }
  for (const Face& face : cut) b.insert(b.end(), face.begin(), face.end());
  for (auto* all : {&a, &b}) {
    std::ranges::sort(*all);
    all->erase(std::unique(all->begin(), all->end()), all->end());
  }
  return a == b;
}

/// Whether the faces of a file are those of the mesh, in their order, however its polygons were
/// cut: that depends on where the vertices are. Errors: kBadFile.
Result<void> check_faces(const io::RawMesh& raw, const TriangleMesh& mesh) {
  const auto counts = [](std::size_t vertices, std::size_t faces) {
    return std::to_string(vertices) + " vertices and " + std::to_string(faces) + " triangles";
  };
  if (raw.positions.size() != mesh.positions().size() || raw.faces.size() != mesh.faces().size()) {
    return other_mesh("the frame has " + counts(raw.positions.size(), raw.faces.size()) +
                      ", and the model " + counts(mesh.positions().size(), mesh.faces().size()));
  }
  auto polygon = raw.polygons.begin();
  for (std::size_t f = 0; f < raw.faces.size();) {
    const bool begins = polygon != raw.polygons.end() && polygon->first_face == f;
    const std::size_t count = begins ? (polygon++)->face_count : 1;
    const std::span fan = std::span(raw.faces).subspan(f, count);
    const auto here = mesh.faces().subspan(f, count);
    const bool same = begins ? same_corners(fan, here, mesh)
                             : std::ranges::equal(fan[0], here[0], {},
                                                  [&](Index v) { return mesh.standing_for(v); });
    if (!same) {
      return other_mesh("triangle " + std::to_string(f) + " has other corners than in the model");
    }
    f += count;
  }
  return {};
}

}  // namespace

struct Frames::Source {
  explicit Source(std::shared_ptr<const TriangleMesh> moving) : mesh(std::move(moving)) {}
  virtual ~Source() = default;
  virtual std::int64_t count() const = 0;
  virtual std::int64_t number(std::int64_t k) const = 0;
  virtual std::string name(std::int64_t k) const = 0;
  /// Errors: with the name of the file, not always of the frame.
  virtual Result<std::vector<Vec3>> positions(std::int64_t k) const = 0;

  std::shared_ptr<const TriangleMesh> mesh;
};

struct Frames::Files final : Source {
  Files(std::shared_ptr<const TriangleMesh> moving, NumberedPath numbered,
        NumberedPath::Range numbers)
      : Source(std::move(moving)), paths(std::move(numbered)), range(numbers) {}

  std::int64_t count() const override { return range.last - range.first + 1; }
  std::int64_t number(std::int64_t k) const override { return range.first + k; }
  std::string name(std::int64_t k) const override { return io::printable(paths.path(number(k))); }
  Result<std::vector<Vec3>> positions(std::int64_t k) const override {
    auto raw = io::read_raw_mesh(paths.path(number(k)));
    if (!raw) return raw.error();
    if (auto same = check_faces(*raw, *mesh); !same) {
      return Error{same.error().code, name(k) + ": " + same.error().message, same.error().hint};
    }
    return std::move(raw->positions);
  }

  NumberedPath paths;
  NumberedPath::Range range;
};

struct Frames::Array final : Source {
  Array(std::shared_ptr<const TriangleMesh> moving, std::string path, io::InputFile opened,
        const io::FrameArray& layout)
      : Source(std::move(moving)), shown(std::move(path)), file(std::move(opened)), array(layout) {}

  std::int64_t count() const override { return array.frames; }
  std::int64_t number(std::int64_t k) const override { return k; }
  std::string name(std::int64_t k) const override { return shown + ": frame " + std::to_string(k); }
  Result<std::vector<Vec3>> positions(std::int64_t k) const override try {
    auto read = io::read_frame(file, array, k);
    if (auto same = file.check_unchanged(); !same) return same.error();
    return read;
  } catch (const io::ReadFailure& failure) {
    return Error{ErrorCode::kBadFile, name(k) + ": " + failure.message, failure.hint};
  }

  std::string shown;  ///< the path, for messages
  io::InputFile file;
  io::FrameArray array;
};

namespace {

/// The frames of a scene for a mesh. Errors: those of Frames::open().
Result<io::MovingScene> scene_for(const io::InputFile& file, const std::string& path,
                                  const TriangleMesh& mesh) {
  auto scene =
      io::read_unchanged(file, io::printable(path), "mesh",
                         [&]() -> Result<io::MovingScene> { return io::read_moving_scene(file); });
  if (!scene) return scene.error();
  if (auto same = check_faces(scene->mesh, mesh); !same) {
    return Error{same.error().code, io::printable(path) + ": " + same.error().message,
                 same.error().hint};
  }
  return scene;
}

/// The header of an array for a mesh. Errors: those of Frames::open().
Result<io::FrameArray> array_for(const io::InputFile& file, const std::string& path,
                                 const TriangleMesh& mesh) {
  return io::read_unchanged(file, io::printable(path), "frames", [&]() -> Result<io::FrameArray> {
    const io::FrameArray array = io::read_frame_array(file, file.extension());
    if (array.vertices == mesh.vertex_count()) return array;
    return other_mesh(io::printable(path) + ": its frames have " + std::to_string(array.vertices) +
                      " vertices, and the model " + std::to_string(mesh.vertex_count()));
  });
}

}  // namespace

Result<Frames> Frames::open(const std::string& path, std::shared_ptr<const TriangleMesh> mesh) {
  if (io::is_frame_array(io::model_extension(path))) {
    auto file = io::InputFile::open(path);
    if (!file) return file.error();
    const auto array = array_for(*file, path, *mesh);
    if (!array) return array.error();
    return Frames(std::make_shared<const Array>(std::move(mesh), io::printable(path),
                                                *std::move(file), *array));
  }
  if (!is_numbered(path) && io::is_moving_scene(io::model_extension(path))) {
    auto file = io::InputFile::open(path);
    if (!file) return file.error();
    auto scene = scene_for(*file, path, *mesh);
    if (!scene) return scene.error();
    return Frames(std::make_shared<const Array>(std::move(mesh), io::printable(path),
                                                std::move(scene->file), scene->frames));
  }
  if (!is_numbered(path)) {
    return Error{ErrorCode::kBadInput,
                 io::printable(path) + ": is no sequence of frames",
                 {"give numbered meshes, such as frame_%04d.obj, positions as .npy, .pc2 or .mdd, "
                  "or an animated .glb"}};
  }
  auto numbered = NumberedPath::parse(path);
  if (!numbered) return numbered.error();
  const auto range = numbered->find_files();
  if (!range) return range.error();
  return Frames(std::make_shared<const Files>(std::move(mesh), *std::move(numbered), *range));
}

std::int64_t Frames::count() const { return source_->count(); }
std::int64_t Frames::number(std::int64_t k) const { return source_->number(k); }
std::string Frames::name(std::int64_t k) const { return source_->name(k); }

Result<TriangleMesh> Frames::read(std::int64_t k) const try {
  auto positions = source_->positions(k);
  if (!positions) return positions.error();
  auto moved = source_->mesh->moved(*std::move(positions));
  if (moved) return moved;
  return Error{ErrorCode::kBadFile, name(k) + ": " + moved.error().message, moved.error().hint};
} catch (const std::bad_alloc&) {
  return Error{ErrorCode::kOutOfMemory, name(k) + ": not enough memory to read it"};
}

}  // namespace geotherm
