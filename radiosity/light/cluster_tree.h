// A tree over secondary emitters, plane by plane:
// each node stands for some clusters of one plane that face one way, below one coat or none.
//
// With A_c, B_c, x_c the area, radiosity and middle of cluster c, and b the brightest channel, a node has
//
//   power P = sum A_c B_c (W),   middle x = sum A_c b_c x_c / sum A_c b_c,   p(y) = b(y) / sum A_c b_c (1/m^2)
//
// with p the density of point_on(). A node is split at the median of its longer side.
// Its splits follow the clusters' own plane, not the axes of space:
// the tree is the same wherever the scene lies and however large it is.
#pragma once

#include "mirror/emitters.h"

#include <span>
#include <vector>

namespace meninas {

struct ClusterNode {
  Point3 middle{
      0.0}; ///< of a sphere around the clusters: their mean by area times the brightest channel
  double radius = 0.0; ///< m
  Rgb power{0.0};      ///< sum of area times radiosity, W
  std::array<Point3, 3>
      centre{}; ///< by channel: the mean of the clusters' points, weighted by what they send
  std::uint32_t first = 0, count = 0;              ///< range of ClusterTree::order
  std::uint32_t first_triangle = 0, triangles = 0; ///< range of ClusterTree::triangles
  std::uint32_t second_child = 0; ///< the first one follows its parent; 0: a leaf, of one cluster
};

struct ClusterTriangle {
  Point3 corner{0.0};
  Vec3 along{0.0}, across{0.0}; ///< the edges from there
  Rgb colour{0.0};              ///< radiosity over that of its brightest channel
};

struct ClusterPlane {
  Plane plane; ///< normal towards the side that sends
  PlaneId plane_class = none<PlaneId>;
  MaterialId coat = none<MaterialId>; ///< above all of them
  std::uint32_t root = 0; ///< index into ClusterTree::nodes
};

struct ClusterTree {
  std::vector<ClusterPlane> planes;
  std::vector<ClusterNode> nodes; ///< depth first, plane after plane
  std::vector<std::uint32_t> order;
  std::vector<ClusterTriangle> triangles; ///< of the clusters in their order
  std::vector<double>
      sent; ///< by triangle: power of the brightest channel of all before it; one longer
};

ClusterTree make_cluster_tree(std::span<const Emitter> clusters);

/// A point of the clusters of a node, with a density in proportion to the brightest
/// channel of what they send. Neighbours in sample.x are so in space.
struct ClusterPoint {
  Point3 position;
  Rgb colour;
};
ClusterPoint point_on(const ClusterTree& tree, const ClusterNode& node, Vec2 sample);

} // namespace meninas
