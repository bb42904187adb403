#include "radiosity/light/cluster_tree.h"

#include "mirror/median_split.h"

#include <cmath>
#include <map>

namespace meninas {

namespace {

/// The mean of the points of a polygon; of its vertices where it has no area.
Point3 centre_of(std::span<const Point3> vertices) {
  const Vec3 whole = area_vector(vertices);
  const double area2 = glm::dot(whole, whole);
  Point3 mean(0.0);
  if (!(area2 > 0.0)) {
    for (const auto& vertex : vertices)
      mean += vertex / static_cast<double>(vertices.size());
    return mean;
  }
  for (std::size_t k = 2; k < vertices.size(); ++k) {
    const Vec3 a = vertices[k - 1] - vertices[0], b = vertices[k] - vertices[0];
    mean += glm::dot(0.5 * glm::cross(a, b), whole) / area2 * (a + b) / 3.0;
  }
  return vertices[0] + mean;
}

/// A place in the clusters' plane in whole steps of a millionth of their extent:
/// ties stay ties wherever the scene lies.
using Place = glm::vec<2, std::int64_t>;

struct Builder {
  std::span<const Emitter> clusters;
  std::vector<Point3> centres; ///< by cluster
  std::vector<Place> places;   ///< by cluster
  ClusterTree tree;

  double power_of(std::uint32_t c) const {
    return clusters[c].area * largest(clusters[c].radiosity);
  }

  /// Counts places along an edge of the first cluster and across it.
  void set_places(std::span<const std::uint32_t> members) {
    const std::vector<Point3>& first = clusters[members[0]].corners;
    const Vec3 edge = first[1] - first[0];
    const std::array<Vec3, 2> axes{edge, glm::cross(clusters[members[0]].plane.normal, edge)};
    double extent = 0.0;
    for (const auto c : members)
      for (const Vec3& axis : axes)
        extent = std::max(extent, std::abs(glm::dot(axis, centres[c] - centres[members[0]])));
    if (!(extent > 0.0))
      return;
    for (const auto c : members)
      for (int k = 0; k < 2; ++k)
        places[c][k] = std::llround(0x1p20 * (glm::dot(axes[static_cast<std::size_t>(k)],
                                                       centres[c] - centres[members[0]]) /
                                              extent));
  }

  ClusterNode node_over(std::uint32_t first, std::uint32_t count) const {
    ClusterNode node;
    node.first = first;
    node.count = count;
    const auto members = std::span(tree.order).subspan(first, count);
    const Point3& near = centres[members[0]];
    double sent = 0.0;
    Vec3 mean(0.0), sum(0.0);
    std::array<Vec3, 3> weighted{};
    for (const auto c : members) {
      const Vec3 to = centres[c] - near;
      const Rgb power = clusters[c].area * clusters[c].radiosity;
      sent += power_of(c);
      sum += to / static_cast<double>(count);
      mean += power_of(c) * to;
      node.power += power;
      for (int band = 0; band < 3; ++band)
        weighted[static_cast<std::size_t>(band)] += power[band] * to;
    }
    node.middle = near + (sent > 0.0 ? mean / sent : sum);
    for (int band = 0; band < 3; ++band)
      node.centre[static_cast<std::size_t>(band)] =
          node.power[band] > 0.0
              ? near + weighted[static_cast<std::size_t>(band)] / node.power[band]
              : node.middle;
    for (const auto c : members)
      for (const auto& vertex : clusters[c].corners)
        node.radius = std::max(node.radius, glm::distance(vertex, node.middle));
    return node;
  }

  /// Halves the range across its longer side at the median.
  void split(std::uint32_t first, std::uint32_t count) {
    const std::size_t self = tree.nodes.size();
    tree.nodes.push_back(node_over(first, count));
    if (count == 1)
      return;
    const std::uint32_t half =
        split_at_median(std::span(tree.order).subspan(first, count), places, 2);
    split(first, half);
    tree.nodes[self].second_child = static_cast<std::uint32_t>(tree.nodes.size());
    split(first + half, count - half);
  }

  /// The fans of all polygons, each with its share of what the polygon sends.
  void add_triangles() {
    std::vector<std::uint32_t> first_of; // by place in the order
    tree.sent.push_back(0.0);
    for (const auto c : tree.order) {
      first_of.push_back(static_cast<std::uint32_t>(tree.triangles.size()));
      const std::vector<Point3>& vertices = clusters[c].corners;
      const double brightest = largest(clusters[c].radiosity);
      const Rgb colour = brightest > 0.0 ? clusters[c].radiosity / brightest : Rgb(0.0);
      for (std::size_t k = 2; k < vertices.size(); ++k) {
        const Vec3 a = vertices[k - 1] - vertices[0], b = vertices[k] - vertices[0];
        tree.triangles.push_back({vertices[0], a, b, colour});
        tree.sent.push_back(tree.sent.back() + 0.5 * glm::length(glm::cross(a, b)) * brightest);
      }
    }
    first_of.push_back(static_cast<std::uint32_t>(tree.triangles.size()));
    for (ClusterNode& node : tree.nodes) {
      node.first_triangle = first_of[node.first];
      node.triangles = first_of[node.first + node.count] - node.first_triangle;
    }
  }
};

/// Clusters of one plane that face one way; those of no plane class stand alone.
std::vector<std::vector<std::uint32_t>> by_plane(std::span<const Emitter> clusters) {
  std::vector<std::vector<std::uint32_t>> planes;
  std::map<PlaneId, std::vector<std::size_t>> of_class;
  for (std::uint32_t c = 0; c < clusters.size(); ++c) {
    auto& known = of_class[clusters[c].plane_class];
    const auto alike = std::ranges::find_if(known, [&](std::size_t g) {
      return clusters[c].plane_class != none<PlaneId> &&
             clusters[planes[g][0]].coat == clusters[c].coat &&
             glm::dot(clusters[planes[g][0]].plane.normal, clusters[c].plane.normal) > 0.0;
    });
    if (alike != known.end()) {
      planes[*alike].push_back(c);
      continue;
    }
    known.push_back(planes.size());
    planes.push_back({c});
  }
  return planes;
}

} // namespace

ClusterTree make_cluster_tree(std::span<const Emitter> clusters) {
  Builder builder{clusters, {}, std::vector<Place>(clusters.size(), Place(0)), {}};
  for (const auto& cluster : clusters)
    builder.centres.push_back(centre_of(cluster.corners));
  ClusterTree& tree = builder.tree;
  for (const auto& members : by_plane(clusters)) {
    const Emitter& any = clusters[members[0]];
    tree.planes.push_back(
        {any.plane, any.plane_class, any.coat, static_cast<std::uint32_t>(tree.nodes.size())});
    const auto first = static_cast<std::uint32_t>(tree.order.size());
    tree.order.insert(tree.order.end(), members.begin(), members.end());
    builder.set_places(members);
    builder.split(first, static_cast<std::uint32_t>(members.size()));
  }
  builder.add_triangles();
  return std::move(tree);
}

ClusterPoint point_on(const ClusterTree& tree, const ClusterNode& node, Vec2 sample) {
  // The sample falls between two of the sums along the order; its remainder lies evenly between them.
  const double* const begin = tree.sent.data() + node.first_triangle;
  const double at = glm::mix(begin[0], begin[node.triangles], sample.x);
  const double* const after = std::upper_bound(begin + 1, begin + node.triangles, at);
  const double share = after[0] - after[-1];
  const double rest = share > 0.0 ? std::clamp((at - after[-1]) / share, 0.0, 1.0) : 0.5;
  const ClusterTriangle& triangle =
      tree.triangles[static_cast<std::size_t>(after - tree.sent.data()) - 1];
  const double root = std::sqrt(rest);
  return {triangle.corner + root * (1.0 - sample.y) * triangle.along +
              root * sample.y * triangle.across,
          triangle.colour};
}

} // namespace meninas
