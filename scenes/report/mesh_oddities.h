// Faces and edges of a mesh that no modeller means: counted by node. (Parts of report_scene.)
#pragma once

#include "scenes/surfaces/surfaces.h"
#include "scenes/surfaces/topology.h"

#include <map>
#include <utility>

namespace meninas {

using CountByNode = std::map<NodeId, std::size_t>;
using CountByNodes = std::map<std::pair<NodeId, NodeId>, std::size_t>;

/// Faces that are there a second time: with the same corners and the same front,
/// or with either front where one of the two has two sides.
/// Two single-sided faces back to back are a sheet, and meant.
/// By the node of the later face and that of the first.
CountByNodes duplicate_faces(const Scene& scene, const Topology& topology);

/// Edges at which more than two faces of one node meet.
CountByNode crowded_edges(const Scene& scene, const Topology& topology);

/// Edges that one face has, with corners of other such edges along them: T-junctions.
/// At least that many in a scene of millions of loose faces that all overlap.
CountByNode divided_edges(const Scene& scene, const Topology& topology, double tolerance);

/// Corners at which over a thousand faces of one node meet:
/// the boxes of such faces overlap, and every ray passes most of them.
CountByNode crowded_corners(const Scene& scene, const Topology& topology);

/// Triangles a thousand times as long as they are high.
CountByNode slivers(const Scene& scene);

} // namespace meninas
