// SPDX-License-Identifier: MIT
// The visit of an edge (docs/numerics.md, "Wavefront"), compiled once for each instruction set. The
// targets of a face are the lanes of a vector. Products and sums are not fused, so that every
// processor gives the same distances.
#include "solver/polyhedral/wave_fit.inl"
#include "solver/polyhedral/wave_kernels.h"

namespace geotherm {
using WaveKernel = std::size_t (*)(WavePass&, std::size_t);
}

namespace geotherm::GEOTHERM_KERNEL_NAMESPACE {
namespace {

/// Where a face is lower than this share of its edge, values behind the edge are at least the least
/// one of the edge. A fitted wave may be lower between the samples; passed round a ring of such
/// faces, values would fall for ever.
constexpr double kThin = 1e-2;

template <int Samples, bool Labels>
class Wave {
 public:
  explicit Wave(WavePass& pass) : p_(pass) {}

  std::size_t run(std::size_t most_visits) {
    WaveBucket& bucket = p_.buckets[p_.current & p_.bucket_mask];
    std::size_t visits = 0;
    // The bucket grows while it is emptied.
    while (p_.place < bucket.size && visits < most_visits) {
      fetch_ahead(bucket, p_.place);
      const Index edge = bucket.edges[p_.place++];
      p_.queued[edge] = 0;
      --p_.waiting;
      visits += visit(edge);
    }
    if (p_.place == bucket.size) bucket.size = 0, p_.place = 0;
    return visits;
  }

 private:
  /// Prefetches in three steps, each of which needs the data of the one before: the sides, then the
  /// faces, then the values. Inlining is forced, because the compiler drops a function that only
  /// prefetches.
  [[gnu::always_inline]] void fetch_ahead(const WaveBucket& bucket, std::int64_t place) const {
    if (place + 8 < bucket.size) __builtin_prefetch(&p_.sides[bucket.edges[place + 8]]);
    if (place + 4 < bucket.size) {
      const auto& sides = p_.sides[bucket.edges[place + 4]];
      __builtin_prefetch(&p_.faces[face_of_code(sides[0])]);
      if (sides[1] >= 0) __builtin_prefetch(&p_.faces[face_of_code(sides[1])]);
    }
    if (place + 2 < bucket.size) {
      const auto& sides = p_.sides[bucket.edges[place + 2]];
      fetch_values(sides[0]);
      if (sides[1] >= 0) fetch_values(sides[1]);
    }
  }
  [[gnu::always_inline]] void fetch_values(SideCode code) const {
    const WaveFace& face = p_.faces[face_of_code(code)];
    for (int k = 0; k < 3; ++k) {
      __builtin_prefetch(&p_.distance[face.vertex[k]]);
      __builtin_prefetch(&p_.sample[Samples * static_cast<std::ptrdiff_t>(face.edge[k])]);
    }
  }

  /// Returns the work done, in visits.
  std::size_t visit(Index edge) {
    const auto& sides = p_.sides[edge];
    const WaveFace& face = p_.faces[face_of_code(sides[0])];
    const int k = corner_of_code(sides[0]);
    const int next = k == 2 ? 0 : k + 1;
    const Index va = face.vertex[k], vb = face.vertex[next];
    const Front<Samples> front = front_of(edge, va, vb, face.length[k]);
    cross(sides[0], front);
    if (sides[1] >= 0) {
      cross_second(sides[1], front);
    } else if (sides[1] != kNoSideCode) {
      const SideCode* list = p_.more - (sides[1] + 2);
      for (SideCode i = 1; i <= list[0]; ++i) cross_second(list[i], front);
    }
    std::size_t visits = 1;
    if (face.touching == 0) return visits;
    if ((face.touching >> k & 1U) != 0) visits += spread(va);
    if ((face.touching >> next & 1U) != 0) visits += spread(vb);
    return visits;
  }

  void cross_second(SideCode code, const Front<Samples>& front) {
    const bool reversed = (p_.faces[face_of_code(code)].reversed >> corner_of_code(code) & 1U) != 0;
    cross(code, reversed ? mirrored(front) : front);
  }

  Front<Samples> front_of(Index edge, Index va, Index vb, double length) {
    double& a = p_.distance[va];
    double& b = p_.distance[vb];
    if (const double from_a = most(a + length, p_.floor); b > from_a) {
      b = from_a;
      if constexpr (Labels) p_.label[vb] = p_.label[va];
    }
    if (const double from_b = most(b + length, p_.floor); a > from_b) {
      a = from_b;
      if constexpr (Labels) p_.label[va] = p_.label[vb];
    }
    Front<Samples> front;
    front.a = a;
    front.b = b;
    const std::ptrdiff_t first = Samples * static_cast<std::ptrdiff_t>(edge);
    const double* w = p_.sample + first;
    if constexpr (Samples == 1) {
      front.fits[0] = fit_wave(0, length / 2, a, w[0], b);
    } else {
      front.fits[0] = fit_wave(-length / 4, length / 4, a, w[0], w[1]);
      front.fits[1] = fit_wave(length / 4, length / 4, w[1], w[2], b);
    }
    if constexpr (Labels) {
      front.label_a = p_.label[va];
      front.label_b = p_.label[vb];
      for (int i = 0; i < Samples; ++i) front.labels[i] = p_.sample_label[first + i];
    }
    return front;
  }

  /// Carries the front to the opposite vertex of a face and to the samples of its other sides.
  void cross(SideCode code, const Front<Samples>& front) {
    const WaveFace& face = p_.faces[face_of_code(code)];
    const int k = corner_of_code(code), next = k == 2 ? 0 : k + 1, previous = k == 0 ? 2 : k - 1;
    const Index vc = face.vertex[previous];
    double nearer = least(least(front.a, front.b), front.fits[0].middle);
    if constexpr (Samples == 3) {
      nearer = least(nearer, least(front.fits[0].right, front.fits[1].middle));
    }
    if (p_.distance[vc] < least(front.a, front.b) && vc != face.vertex[k] &&
        vc != face.vertex[next] && face.vertex[k] != face.vertex[next]) {
      return;  // the wave came from there; large offsets can make all distances equal
    }
    const double length = face.length[k], half = length / 2, inverse = 1 / length;
    const double to_b = face.length[next], to_a = face.length[previous];
    const double cx = (to_a - to_b) * (to_a + to_b) * (0.5 * inverse);
    const double cy = face.twice_area * inverse;
    using Goals = Targets<Samples>;
    constexpr int kWidth = Goals::kLanes < kWidest ? Goals::kLanes : kWidest;
    using Values = typename Register<kWidth>::Values;
    double values[Goals::kLanes];
    for (int i = 0; i < Goals::kLanes; i += kWidth) {
      const auto opposite = load<Values>(Goals::kOpposite + i);
      const Values x = opposite * cx + load<Values>(Goals::kEdge + i) * half, y = opposite * cy;
      store(arrival<kWidth>(front, half, x, y, nearer), values + i);
    }
    const double least_value = cy < kThin * length ? most(nearer, p_.floor) : p_.floor;
    for (double& value : values) value = most(value, least_value);
    Index labels[Goals::kLanes] = {};
    if constexpr (Labels) {
      for (int i = 0; i < 1 + 2 * Samples; ++i) {
        labels[i] = label_of(front, half, Goals::kOpposite[i] * cx + Goals::kEdge[i] * half,
                             Goals::kOpposite[i] * cy, values[i]);
      }
    }

    const double longest = most(length, most(to_a, to_b)), notice = kNotice * longest;
    p_.longest = most(p_.longest, longest);
    const bool vertex_fell = lower_vertex(vc, values[0], labels[0], notice);
    const double dc = p_.distance[vc];
    lower_samples(face, previous, values + 1, labels + 1, notice, vertex_fell, most(dc, front.a));
    lower_samples(face, next, values + 1 + Samples, labels + 1 + Samples, notice, vertex_fell,
                  most(dc, front.b));
  }

  /// Passes the value of a vertex on to all its faces, where no edge does so (WaveFace::touching),
  /// unless they have it already but for a negligible difference. Returns the number of corners.
  std::size_t spread(Index vertex) {
    if (!(p_.distance[vertex] < p_.spread_below[vertex])) return 0;
    const double value = p_.distance[vertex];
    double shortest = kFar;
    for (std::size_t i = p_.corner_start[vertex]; i < p_.corner_start[vertex + 1]; ++i) {
      const SideCode code = p_.corners[i];
      const WaveFace& face = p_.faces[face_of_code(code)];
      const int k = corner_of_code(code), next = k == 2 ? 0 : k + 1;
      const Index label = Labels ? p_.label[vertex] : kNoIndex;
      Front<Samples> front{};
      front.a = p_.distance[vertex];
      front.b = most(front.a + face.length[k], p_.floor);
      front.label_a = front.label_b = label;
      double values[Samples];
      for (int j = 0; j < Samples; ++j) {
        values[j] = most(front.a + face.length[k] * (j + 1) / (Samples + 1), p_.floor);
        front.labels[j] = label;
      }
      for (Fit& fit : front.fits) fit.middle = fit.right = kFar;
      const bool fell = lower_vertex(face.vertex[next], front.b, label, kNotice * face.length[k]);
      lower_samples(face, k, values, front.labels, kNotice * face.length[k], fell, front.b);
      cross(code, front);
      shortest = least(shortest, face.length[k]);
    }
    p_.spread_below[vertex] = value - kNotice * shortest;
    return p_.corner_start[vertex + 1] - p_.corner_start[vertex];
  }

  /// True when the value fell by more than `notice`.
  bool lower_vertex(Index vertex, double value, Index label, double notice) {
    double& now = p_.distance[vertex];
    if (!(value < now)) return false;
    const bool noticed = value < now - notice;
    now = value;
    if constexpr (Labels) p_.label[vertex] = label;
    return noticed;
  }

  void lower_samples(const WaveFace& face, int side, const double* values, const Index* labels,
                     double notice, bool vertex_fell, double ends) {
    const Index edge = face.edge[side];
    const std::ptrdiff_t first = Samples * static_cast<std::ptrdiff_t>(edge);
    const bool reversed = Samples > 1 && (face.reversed >> side & 1U) != 0;
    bool fell = vertex_fell;
    for (int i = 0; i < Samples; ++i) {
      const std::ptrdiff_t at = first + (reversed ? Samples - 1 - i : i);
      double& value = p_.sample[at];
      if (!(values[i] < value)) continue;
      fell = fell || values[i] < value - notice;
      value = values[i];
      if constexpr (Labels) p_.sample_label[at] = labels[i];
    }
    if (fell) enqueue(edge, most(ends, p_.sample[first + Samples / 2]));
  }

  /// Puts an edge into the bucket of `key`, the current one where that is past.
  void enqueue(Index edge, double key) {
    if (p_.queued[edge] != 0) return;
    const std::int64_t last = p_.current + p_.bucket_mask;
    const double place = key * p_.per_length;  // may be beyond all integers
    std::int64_t number = last;
    if (place < static_cast<double>(last)) number = static_cast<std::int64_t>(place);
    if (number < p_.current) number = p_.current;
    if (number > last) number = last;  // where it has more digits than a double
    WaveBucket& bucket = p_.buckets[number & p_.bucket_mask];
    if (bucket.size == bucket.capacity) p_.grow(p_.context, bucket);
    bucket.edges[bucket.size++] = edge;
    p_.queued[edge] = 1;
    ++p_.waiting;
  }

  WavePass& p_;
};

template <int Samples, bool Labels>
std::size_t visit_bucket(WavePass& pass, std::size_t most_visits) {
  return Wave<Samples, Labels>(pass).run(most_visits);
}

}  // namespace

extern const WaveKernel kWaveKernels[2][2];
const WaveKernel kWaveKernels[2][2] = {{visit_bucket<1, false>, visit_bucket<1, true>},
                                       {visit_bucket<3, false>, visit_bucket<3, true>}};

}  // namespace geotherm::GEOTHERM_KERNEL_NAMESPACE
