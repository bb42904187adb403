#include "scenes/surfaces/patch_pairs.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>

namespace meninas {
namespace {

/// Sine of the least turn at a corner of a strictly convex quad; below it three corners are nearly
/// in a line.
constexpr double min_turn = 1e-3;

/// Steps of |cosine| in which shapes differ: rounding must not decide between quads that are equal
/// by construction.
constexpr double quality_steps = 1000.0;

/// Partners that are tried across one edge: more of them are duplicates of one another.
constexpr int max_partners = 8;

struct Candidate {
  int deviation = 0; ///< from a rectangle: the largest |cosine| of a corner, in steps
  std::array<VertexId, 4> sorted_vertices{};
  QuadPair pair;
};

/// The largest |cosine| at a corner of the quad, nothing when it is not strictly convex about the
/// normal.
std::optional<double> deviation_from_rectangle(const std::array<Point3, 4>& quad,
                                               const Direction& normal) {
  double largest = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 in = quad[k] - quad[(k + 3) % 4];
    const Vec3 out = quad[(k + 1) % 4] - quad[k];
    const double lengths = glm::length(in) * glm::length(out);
    if (!(glm::dot(glm::cross(in, out), normal) > min_turn * lengths)) {
      return std::nullopt;
    }
    largest = std::max(largest, std::abs(glm::dot(in, out)) / lengths);
  }
  return largest;
}

/// The quad of the triangles on both sides of an edge: apex of one, start of the edge, apex of the
/// other, end.
Candidate join(const Scene& scene, EdgeUse a, EdgeUse b) {
  if (b.triangle < a.triangle) {
    std::swap(a, b);
  }
  const auto vertex = [&](const EdgeUse& use, std::size_t steps) {
    return scene.triangles[index(use.triangle)].vertices[(use.side + steps) % 3];
  };
  Candidate candidate;
  QuadPair& pair = candidate.pair;
  pair.first = a.triangle;
  pair.second = b.triangle;
  // Where the two triangles have vertices of their own at a shared corner, the earlier one stands
  // for it.
  pair.vertices = {vertex(a, 2), std::min(vertex(a, 0), vertex(b, 1)), vertex(b, 2),
                   std::min(vertex(a, 1), vertex(b, 0))};
  // The earliest vertex begins the quad, so that it does not matter which diagonal cut it.
  std::rotate(pair.vertices.begin(), std::min_element(pair.vertices.begin(), pair.vertices.end()),
              pair.vertices.end());
  candidate.sorted_vertices = pair.vertices;
  std::sort(candidate.sorted_vertices.begin(), candidate.sorted_vertices.end());
  return candidate;
}

/// A triangle at an edge can only be paired with one of its
/// region and node that runs along the edge the other way.
struct Kind {
  std::uint32_t region = 0;
  std::uint32_t node = 0;
  bool forward = true;
  auto operator<=>(const Kind&) const = default;
};

struct UseOfKind {
  Kind kind;
  EdgeUse use;
};

void sort_by_kind(const Scene& scene, const std::vector<std::uint32_t>& region_of,
                  std::span<const EdgeUse> uses, std::vector<UseOfKind>& sorted) {
  sorted.clear();
  for (const EdgeUse& use : uses) {
    const std::size_t t = index(use.triangle);
    sorted.push_back({{region_of[t], index(scene.triangles[t].node), use.forward}, use});
  }
  std::ranges::sort(sorted, [](const UseOfKind& a, const UseOfKind& b) {
    return std::tie(a.kind, a.use.triangle) < std::tie(b.kind, b.use.triangle);
  });
}

/// The first later triangles that one at an edge can be paired with, in the order of triangles:
/// found without a look at all the others,
/// of which a pile of copies or a fan of sheets has as many as there are triangles.
std::span<const UseOfKind> partners_of(const UseOfKind& one, std::span<const UseOfKind> sorted) {
  Kind kind = one.kind;
  kind.forward = !kind.forward;
  const auto first =
      std::upper_bound(sorted.begin(), sorted.end(), std::tie(kind, one.use.triangle),
                       [](const auto& key, const UseOfKind& other) {
                         return key < std::tie(other.kind, other.use.triangle);
                       });
  const auto end =
      std::find_if(first, first + std::min<std::ptrdiff_t>(max_partners, sorted.end() - first),
                   [&](const UseOfKind& other) { return other.kind != kind; });
  return {first, end};
}

/// The quad of two triangles, if it is strictly convex.
std::optional<Candidate> candidate_of(const Scene& scene, const EdgeUse& a, const EdgeUse& b,
                                      const Direction& normal) {
  Candidate candidate = join(scene, a, b);
  std::array<Point3, 4> quad{};
  for (std::size_t k = 0; k < 4; ++k) {
    quad[k] = position(scene, candidate.pair.vertices[k]);
  }
  const auto deviation = deviation_from_rectangle(quad, normal);
  if (!deviation) {
    return std::nullopt;
  }
  candidate.deviation = static_cast<int>(std::lround(quality_steps * *deviation));
  return candidate;
}

std::vector<Candidate> find_candidates(const Scene& scene, const Regions& regions,
                                       const std::vector<std::uint32_t>& region_of,
                                       const Topology& topology) {
  std::vector<Candidate> candidates;
  std::vector<UseOfKind> sorted;
  for (std::uint32_t edge = 0; edge + 1 < topology.first_use.size(); ++edge) {
    sort_by_kind(scene, region_of, uses_of(topology, edge), sorted);
    for (const UseOfKind& one : sorted) {
      const Direction& normal = regions.regions[one.kind.region].plane.normal;
      for (const UseOfKind& other : partners_of(one, sorted)) {
        if (const auto candidate = candidate_of(scene, one.use, other.use, normal)) {
          candidates.push_back(*candidate);
        }
      }
    }
  }
  return candidates;
}

} // namespace

std::vector<QuadPair> pair_triangles(const Scene& scene, const Regions& regions,
                                     const Topology& topology) {
  std::vector<std::uint32_t> region_of(scene.triangles.size());
  for (std::size_t r = 0; r < regions.regions.size(); ++r) {
    for (const TriangleId triangle : triangles_of(regions, regions.regions[r])) {
      region_of[index(triangle)] = static_cast<std::uint32_t>(r);
    }
  }
  auto candidates = find_candidates(scene, regions, region_of, topology);
  // Ties by vertices do not depend on the order of the triangles; duplicates are left to their
  // indices.
  tbb::parallel_sort(
      candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
        return std::tie(a.deviation, a.sorted_vertices, a.pair.first, a.pair.second) <
               std::tie(b.deviation, b.sorted_vertices, b.pair.first, b.pair.second);
      });
  std::vector<std::uint8_t> paired(scene.triangles.size(), 0);
  std::vector<QuadPair> pairs;
  for (const Candidate& candidate : candidates) {
    std::uint8_t& first = paired[index(candidate.pair.first)];
    std::uint8_t& second = paired[index(candidate.pair.second)];
    if (first == 0 && second == 0) {
      first = second = 1;
      pairs.push_back(candidate.pair);
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const QuadPair& a, const QuadPair& b) { return a.first < b.first; });
  return pairs;
}

} // namespace meninas
