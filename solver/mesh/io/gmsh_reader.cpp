// SPDX-License-Identifier: MIT
// Gmsh's .msh, versions 2.x and 4.1, text and binary (Gmsh reference manual, "File formats"). Nodes
// and elements have tags of any size in any order; here a vertex is numbered by its place.
#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <unordered_map>

#include "solver/mesh/io/mixed_scanner.h"
#include "solver/mesh/io/raw_elements.h"

namespace geotherm::io {
namespace {

/// Kinds of elements: the corners of each, by the number of the kind; 0: unknown.
constexpr int kGmshCorners[] = {0, 2,  3,  4,  4, 8,  6,  5,  3,  6,  9, 10, 27, 18, 14, 1,
                                8, 20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5,  6,  20, 35, 56};
constexpr std::int64_t kGmshTriangle = 2, kGmshQuad = 3, kGmshTet = 4;

int gmsh_corners(std::int64_t kind) {
  return kind > 0 && kind < static_cast<std::int64_t>(std::size(kGmshCorners)) ? kGmshCorners[kind]
                                                                               : 0;
}

std::string gmsh_name(std::int64_t kind) {
  static constexpr const char* kNames[] = {"", "edges",     "triangles", "quads",
                                           "", "hexahedra", "prisms",    "pyramids"};
  if (kind == 15) return "points";
  if (kind == 9) return "triangles with 6 corners";
  if (kind == 10 || kind == 16) return kind == 10 ? "quads with 9 corners" : "quads with 8 corners";
  if (kind == 11) return "tetrahedra with 10 corners";
  if (kind > 0 && kind < 8 && kind != kGmshTet) return kNames[kind];
  return "elements of Gmsh's type " + std::to_string(kind);
}

/// From the tags of nodes to their places. Mostly a tag is the place and 1, and no table is made.
class NodeTags {
 public:
  void add(std::int64_t tag, MixedScanner& scanner) {
    const Index place = count_++;
    if (in_order_ && tag == std::int64_t{place} + 1) return;
    if (in_order_) {
      in_order_ = false;
      for (Index i = 0; i < place; ++i) places_.emplace(std::int64_t{i} + 1, i);
    }
    if (!places_.emplace(tag, place).second) {
      scanner.fail("there is a second node " + std::to_string(tag));
    }
  }

  Index place(std::int64_t tag, const MixedScanner& scanner) const {
    if (in_order_) {
      if (tag >= 1 && tag <= count_) return static_cast<Index>(tag - 1);
    } else if (const auto found = places_.find(tag); found != places_.end()) {
      return found->second;
    }
    scanner.fail("node " + std::to_string(tag) + " is used, but there is none before it among " +
                 std::to_string(count_) + " nodes");
  }

  bool in_order() const { return in_order_; }

 private:
  Index count_ = 0;
  bool in_order_ = true;
  std::unordered_map<std::int64_t, Index> places_;
};

/// One file, section by section.
class GmshFile {
 public:
  explicit GmshFile(std::string_view bytes) : scanner_(bytes, '\0') {}

  RawElements read() {
    bool has_nodes = false, has_elements = false;
    read_format();
    while (!scanner_.words().at_end()) {
      scanner_.now_reading("the list of sections");
      const std::string section(scanner_.words().word());
      if (!section.starts_with('$')) {
        scanner_.fail(quoted(section, section.data()) +
                      " stands where a section ($Nodes, ...) should begin");
      }
      if (section == "$Nodes" || section == "$Elements") {
        bool& seen = section == "$Nodes" ? has_nodes : has_elements;
        if (seen) scanner_.fail("there is a second section " + section);
        seen = true;
        if (section == "$Nodes") {
          is_4_ ? read_nodes_4() : read_nodes_2();
        } else {
          is_4_ ? read_elements_4() : read_elements_2();
        }
        expect_end(section);
      } else {
        pass_section(section);
      }
    }
    if (!tags_.in_order()) {
      raw_.notes.emplace_back(
          "vertices are numbered from 0 in the order of the file, which is not that of its tags");
    }
    return std::move(raw_);
  }

 private:
  void read_format() {
    TextScanner& words = scanner_.words();
    words.now_reading("the header");
    std::string_view first = words.word();
    while (first == "$Comments") {  // the one section that may stand in front
      pass_section("$Comments");
      words.now_reading("the header");
      first = words.word();
    }
    if (first == "$NOD") words.fail("version 1 is not supported", {"save it as version 4.1"});
    if (first != "$MeshFormat") words.fail("a file of Gmsh starts with the word $MeshFormat");
    const std::string version(words.word());
    is_4_ = version == "4.1";
    if (!is_4_ && version != "2" && !version.starts_with("2.")) {
      words.fail("version " + quoted(version, version.data()) + " is not supported",
                 {"save it as version 4.1 or 2.2"});
    }
    const std::int64_t binary = words.integer();
    const std::int64_t size = words.integer();
    if (size != 8) words.fail("numbers have " + std::to_string(size) + " bytes instead of 8");
    if (binary != 0) {
      scanner_.be_binary(std::endian::little);
      scanner_.begin_values();
      const std::int64_t one = scanner_.integer<std::int32_t>();
      if (one == 16777216) {
        scanner_.be_binary(std::endian::big);
      } else if (one != 1) {
        scanner_.fail("the number 1 in front of binary sections is " + std::to_string(one));
      }
      scanner_.end_values();
    }
    expect_end("$MeshFormat");
  }

  void expect_end(const std::string& section) {
    const std::string end = "$End" + section.substr(1);
    scanner_.now_reading("the list of sections");
    if (scanner_.words().word() == end) return;
    scanner_.fail("the section " + section + " does not end with " + end + " where it should");
  }

  /// Sections with binary content are passed by looking for their end.
  void pass_section(const std::string& section) {
    if (scanner_.pass("$End" + section.substr(1))) return;
    scanner_.fail("the section " + quoted(section, section.data()) + " has no end");
  }

  void read_node(std::size_t number, std::int64_t tag) {
    tags_.add(tag, scanner_);
    for (int axis = 0; axis < 3; ++axis) {
      raw_.positions[number][axis] = scanner_.coordinate<double>();
    }
  }

  void read_nodes_2() {
    scanner_.now_reading("the section $Nodes");
    const std::size_t count =
        scanner_.checked_count(scanner_.words().integer(), "nodes", scanner_.is_binary() ? 28 : 8);
    scanner_.begin_values();
    raw_.positions.resize(count);
    for (std::size_t v = 0; v < count; ++v) {
      scanner_.now_reading("node", static_cast<std::int64_t>(v) + 1,
                           static_cast<std::int64_t>(count));
      read_node(v, scanner_.integer<std::int32_t>());
    }
    scanner_.end_values();
  }

  void read_nodes_4() {
    scanner_.now_reading("the section $Nodes");
    scanner_.begin_values();
    const std::int64_t blocks = scanner_.integer<std::uint64_t>();
    const std::size_t count = scanner_.checked_count(scanner_.integer<std::uint64_t>(), "nodes",
                                                     scanner_.is_binary() ? 32 : 8);
    scanner_.skip<std::uint64_t>(2);  // least and largest tag
    raw_.positions.resize(count);
    std::vector<std::int64_t> tags;
    std::size_t filled = 0;
    for (std::int64_t block = 0; block < blocks; ++block) {
      scanner_.now_reading("block of nodes", block + 1, blocks);
      const std::int64_t dimension = scanner_.integer<std::int32_t>();
      scanner_.skip<std::int32_t>(1);  // the part of the model
      const std::int64_t parametric = scanner_.integer<std::int32_t>();
      const std::int64_t here = scanner_.integer<std::uint64_t>();
      if (here < 0 || static_cast<std::uint64_t>(here) > count - filled || dimension < 0 ||
          dimension > 3) {
        scanner_.fail("a block of " + std::to_string(here) + " nodes in dimension " +
                      std::to_string(dimension) + " does not fit into " + std::to_string(count) +
                      " nodes");
      }
      tags.resize(static_cast<std::size_t>(here));
      for (std::int64_t& tag : tags) tag = scanner_.integer<std::uint64_t>();
      for (const std::int64_t tag : tags) {
        scanner_.now_reading("node", static_cast<std::int64_t>(filled) + 1,
                             static_cast<std::int64_t>(count));
        read_node(filled++, tag);
        if (parametric != 0) scanner_.skip<double>(dimension);
      }
    }
    raw_.positions.resize(filled);
    scanner_.end_values();
  }

  template <class Tag>
  void read_tet() {
    std::array<Index, 4> tet;
    for (Index& corner : tet) corner = tags_.place(scanner_.integer<Tag>(), scanner_);
    raw_.tets.push_back(tet);
  }

  /// An element behind its tags: of one that is no tet or face the corners are passed over.
  template <class Tag>
  void read_element(std::int64_t kind) {
    if (kind == kGmshTet) return read_tet<Tag>();
    const int corners = gmsh_corners(kind);
    if (kind == kGmshTriangle || kind == kGmshQuad) {
      ++raw_.others[gmsh_name(kind)];
      for (int k = 0; k < corners; ++k) fan_.add(tags_.place(scanner_.integer<Tag>(), scanner_));
      return fan_.end(raw_.polygons);
    }
    if (scanner_.is_binary()) {
      if (corners == 0) scanner_.fail("the type " + std::to_string(kind) + " is unknown");
      scanner_.skip<Tag>(corners);
    } else {
      scanner_.words().skip_line();
    }
    ++raw_.others[gmsh_name(kind)];
  }

  void read_elements_2() {
    scanner_.now_reading("the section $Elements");
    const std::int64_t count = scanner_.words().integer();
    scanner_.checked_count(count, "elements", 8);
    scanner_.begin_values();
    for (std::int64_t e = 0; e < count;) {
      scanner_.now_reading("element", e + 1, count);
      std::int64_t here = 1;
      std::int64_t kind = 0, tags = 0;
      if (scanner_.is_binary()) {
        kind = scanner_.integer<std::int32_t>();
        here = scanner_.integer<std::int32_t>();
        tags = scanner_.integer<std::int32_t>();
        if (here < 1 || here > count - e) {
          scanner_.fail("a block of " + std::to_string(here) + " elements does not fit into " +
                        std::to_string(count));
        }
      }
      for (std::int64_t i = 0; i < here; ++i, ++e) {
        scanner_.now_reading("element", e + 1, count);
        scanner_.integer<std::int32_t>();  // its tag
        if (!scanner_.is_binary()) {
          kind = scanner_.words().integer();
          tags = scanner_.words().integer();
        }
        if (tags < 0 || static_cast<std::uint64_t>(tags) > scanner_.bytes_left()) {
          scanner_.fail("an element cannot have " + std::to_string(tags) + " tags");
        }
        scanner_.skip<std::int32_t>(tags);
        read_element<std::int32_t>(kind);
      }
    }
    scanner_.end_values();
  }

  void read_elements_4() {
    scanner_.now_reading("the section $Elements");
    scanner_.begin_values();
    const std::int64_t blocks = scanner_.integer<std::uint64_t>();
    const std::int64_t count = scanner_.integer<std::uint64_t>();
    scanner_.checked_count(count, "elements", 4);
    scanner_.skip<std::uint64_t>(2);
    std::int64_t e = 0;
    for (std::int64_t block = 0; block < blocks; ++block) {
      scanner_.now_reading("block of elements", block + 1, blocks);
      scanner_.skip<std::int32_t>(2);  // dimension and part of the model
      const std::int64_t kind = scanner_.integer<std::int32_t>();
      const std::int64_t here = scanner_.integer<std::uint64_t>();
      if (here < 0 || here > count - e) {
        scanner_.fail("a block of " + std::to_string(here) + " elements does not fit into " +
                      std::to_string(count));
      }
      for (std::int64_t i = 0; i < here; ++i) {
        scanner_.now_reading("element", ++e, count);
        scanner_.integer<std::uint64_t>();  // its tag
        read_element<std::uint64_t>(kind);
      }
    }
    scanner_.end_values();
  }

  MixedScanner scanner_;
  bool is_4_ = false;
  NodeTags tags_;
  RawElements raw_;
  FanBuilder fan_{raw_.faces};
};

}  // namespace

RawElements read_gmsh(std::string_view bytes) { return GmshFile(bytes).read(); }

}  // namespace geotherm::io
