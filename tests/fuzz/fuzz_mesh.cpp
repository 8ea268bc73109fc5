// SPDX-License-Identifier: MIT
#include "tests/fuzz/fuzz_mesh.h"

#include <algorithm>
#include <cmath>

#include "geotherm/backend.h"

namespace geotherm::test {
namespace {

constexpr int kMaxVertices = 40, kMaxFaces = 80, kMaxSources = 5;

/// Takes numbers off the front; behind the end there are zeros.
class ByteReader {
 public:
  explicit ByteReader(Bytes bytes) : rest_(bytes) {}

  bool at_end() const { return rest_.empty(); }

  int byte() {
    if (rest_.empty()) return 0;
    const int value = rest_.front();
    rest_ = rest_.subspan(1);
    return value;
  }

  int below(int bound) { return byte() % bound; }

  template <class Kind>
  Kind one_of(Kind last) {
    return static_cast<Kind>(below(static_cast<int>(last) + 1));
  }

  /// -1 to 1, in steps of 2^-15.
  double fraction() {
    const int high = byte();
    return (high * 256 + byte() - 32768) / 32768.0;
  }

 private:
  Bytes rest_;
};

/// The options, and what is welded.
void read_options(ByteReader& reader, FuzzCase& out) {
  constexpr double kFactors[] = {1, 1, 1, 1e-6, 0.01, 30, 1e4, 1e12};
  constexpr double kTightMb = 1e-3;
  MethodOptions& options = out.options;
  options.threads = 1;
  const std::vector<std::string> backends = backend_names();
  options.backend = backends[reader.below(static_cast<int>(backends.size()))];
  options.time_step.rule = reader.one_of(TimeRule::kAbsolute);
  options.time_step.factor = kFactors[reader.below(8)];
  options.time_step.absolute = std::ldexp(1, reader.below(128) - 64);
  options.constraint.mode = reader.one_of(ConstraintMode::kPseudoInverse);
  options.constraint.penalty = options.time_step.factor;
  options.heat = reader.one_of(HeatMode::kHold);
  options.boundary = reader.one_of(BoundaryRule::kAverage);
  options.laplacian = reader.one_of(LaplacianKind::kTufted);
  const int bits = reader.byte();
  options.variant = (bits & 1) != 0 ? Variant::kClassic : Variant::kCorrected;
  options.refine = (bits & 2) != 0 ? 1 : 0;
  options.strict = (bits & 4) != 0;
  if ((bits & 8) != 0) options.memory_limit_mb = kTightMb;
  out.welding = static_cast<Welding>(bits >> 4 & 3);
  if ((bits & 64) != 0) options.precision = Precision::kRefined;
}

std::vector<Vec3> read_positions(ByteReader& reader, int count) {
  // Half of the meshes are of ordinary size; the others come close to the ends of the doubles.
  constexpr int kExponents[] = {0, 0, 0, 0, 30, -30, 480, -480};
  constexpr double kPlaces[] = {0, 0, 0, 1, 1e3, 1e8};
  const int kind = reader.byte();
  const double scale = std::ldexp(1, kExponents[kind % 8]);
  const double place = scale * kPlaces[reader.below(6)];
  const bool flat = (kind & 8) != 0, anywhere = (kind & 16) != 0;
  constexpr int kGrid = 5;
  std::vector<Vec3> positions;
  for (int v = 0; v < count; ++v) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == 2 && flat) {
        p[axis] = place;
        continue;
      }
      p[axis] = place + scale * (anywhere ? reader.fraction() : reader.below(kGrid));
    }
    positions.push_back(p);
  }
  return positions;
}

std::vector<Face> read_faces(ByteReader& reader, int vertices) {
  std::vector<Face> faces;
  while (!reader.at_end() && static_cast<int>(faces.size()) < kMaxFaces) {
    Face face;
    for (Index& corner : face) corner = reader.below(vertices);
    faces.push_back(face);
  }
  return faces;
}

/// Now and then one that does not exist, a weight that is wrong or an offset.
SourceSet read_sources(ByteReader& reader, int vertices) {
  SourceSet set;
  for (int count = 1 + reader.below(kMaxSources); count > 0; --count) {
    const int kind = reader.below(8);
    if (kind < 4) {
      set.points.push_back(SurfacePoint::at_vertex(reader.byte() % (vertices + (kind == 3))));
    } else if (kind < 6) {
      const int face = reader.below(kMaxFaces);
      const double a = reader.below(9) / 8.0, b = (1 - a) * reader.below(9) / 8.0;
      set.points.push_back(SurfacePoint::in_face(face, {a, b, kind == 4 ? 1 - a - b : b}));
    } else {
      const int from = reader.below(vertices);
      set.edges.push_back({from, reader.below(vertices)});
    }
  }
  if (reader.below(8) == 0) {
    for (std::size_t i = 0; i < set.points.size(); ++i) set.offsets.push_back(reader.below(16));
  }
  return set;
}

}  // namespace

FuzzCase decode_case(Bytes bytes) {
  ByteReader reader(bytes);
  FuzzCase result;
  read_options(reader, result);
  const int vertices = 3 + reader.below(kMaxVertices - 2);
  result.sources = read_sources(reader, vertices);
  std::vector<Vec3> positions = read_positions(reader, vertices);
  auto mesh = TriangleMesh::build(std::move(positions), read_faces(reader, vertices));
  if (mesh) result.mesh = std::make_shared<const TriangleMesh>(*std::move(mesh));
  return result;
}

}  // namespace geotherm::test
