#include "radiosity/hierarchical/node_edges.h"

#include <algorithm>
#include <optional>

namespace meninas {

namespace {

constexpr Vec2 corner_st[4] = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};

/// The edge of a node that has the point within it, if any.
std::optional<std::size_t> edge_at(Vec2 st) {
  constexpr double margin = 1e-6;
  const auto inside = [](double x) { return x > margin && x < 1.0 - margin; };
  if (inside(st.x))
    return st.y <= margin         ? std::optional<std::size_t>(0)
           : st.y >= 1.0 - margin ? std::optional<std::size_t>(2)
                                  : std::nullopt;
  if (inside(st.y))
    return st.x >= 1.0 - margin ? std::optional<std::size_t>(1)
           : st.x <= margin     ? std::optional<std::size_t>(3)
                                : std::nullopt;
  return std::nullopt;
}

std::optional<MidpointStencil> cross_of(const ElementMesh& mesh, const NodeTree& tree, TreeNodeId id) {
  const TreeNode& node = tree.nodes[index(id)];
  constexpr auto unknown = none<ElementVertexId>;
  if (node.triangle || node.child_count != 4)
    return std::nullopt;
  MidpointStencil cross{id,         corners_of(mesh, node),
                  unknown,    {unknown, unknown, unknown, unknown},
                  node.side,  Vec2(0.5),
                  node.extent};
  for (std::uint32_t k = 0; k < 4; ++k) {
    const TreeNode& part = tree.nodes[index(node.first_child) + k];
    const ElementCorners corners = corners_of(mesh, part);
    for (std::size_t c = 0; c < 4; ++c) {
      const Vec2 st = (part.uv + corner_st[c] * part.extent - node.uv) / node.extent;
      if (const auto edge = edge_at(st)) {
        cross.of_edges[*edge] = corners[c];
      } else if (glm::all(glm::lessThan(glm::abs(st - Vec2(0.5)), Vec2(0.499)))) {
        cross.middle = corners[c];
        cross.st = st;
      }
    }
  }
  const bool is_whole = cross.middle != unknown && std::ranges::count(cross.of_edges, unknown) == 0;
  return is_whole ? std::optional(cross) : std::nullopt;
}

/// The data about the middle of an edge from one of the nodes beside it.
struct EdgeSide {
  std::uint32_t cross = 0;
  std::uint32_t edge = 0;
};

/// The distances of a cross's middle to one of its edges and to the one opposite, in (u, v).
Vec2 distances(const MidpointStencil& cross, std::size_t edge) {
  const double along = edge % 2 == 0 ? cross.st.y : cross.st.x;
  const double width = edge % 2 == 0 ? cross.extent.y : cross.extent.x;
  const double low = along * width, high = (1.0 - along) * width;
  return edge == 0 || edge == 3 ? Vec2(low, high) : Vec2(high, low);
}

/// Bends of the edges of crosses, from values at vertices.
class EdgeBends {
public:
  EdgeBends(std::span<const MidpointStencil> crosses, std::span<const std::uint8_t> valid,
            std::span<const glm::vec3> values)
      : crosses_(crosses), valid_(valid), values_(values) {}

  /// The surplus in the middle of an edge over the linear mean of its ends, if it is known.
  glm::vec3 beyond_line(const EdgeSide& side, glm::vec3 middle) const {
    return middle - between_ends(side);
  }

  bool is_known(const MidpointStencil& cross) const {
    return is_valid(cross.middle) &&
           std::ranges::all_of(cross.corners, [&](ElementVertexId c) { return is_valid(c); });
  }

  bool have_same_ends(const EdgeSide& a, const EdgeSide& b) const {
    const auto [a0, a1] = ends(a);
    const auto [b0, b1] = ends(b);
    return crosses_[a.cross].side == crosses_[b.cross].side &&
           ((a0 == b0 && a1 == b1) || (a0 == b1 && a1 == b0));
  }

  /// By the nodes on both sides of the edge.
  glm::vec3 between(const EdgeSide& a, const EdgeSide& b) const {
    const Vec2 at_a = distances(crosses_[a.cross], a.edge),
               at_b = distances(crosses_[b.cross], b.edge);
    const double product = at_a.x * at_b.x, k = 0.5 * (at_a.x * at_a.y + at_b.x * at_b.y);
    const auto share_of_b = float(at_a.x / (at_a.x + at_b.x));
    const glm::vec3 across =
        glm::mix(at(crosses_[a.cross].middle), at(crosses_[b.cross].middle), share_of_b);
    const glm::vec3 d = 0.5F * (off_corners(crosses_[a.cross]) + off_corners(crosses_[b.cross]));
    return (float(k) * (across - between_ends(a)) + float(product) * d) / float(product + k);
  }

private:
  const glm::vec3& at(ElementVertexId v) const { return values_[index(v)]; }
  bool is_valid(ElementVertexId v) const { return valid_[index(v)] != 0; }

  std::pair<ElementVertexId, ElementVertexId> ends(const EdgeSide& side) const {
    const MidpointStencil& cross = crosses_[side.cross];
    return {cross.corners[side.edge], cross.corners[(side.edge + 1) % 4]};
  }

  glm::vec3 between_ends(const EdgeSide& side) const {
    const auto [from, to] = ends(side);
    const Vec2 st = crosses_[side.cross].st;
    const double along = side.edge % 2 == 0 ? st.x : st.y;
    return glm::mix(at(from), at(to), float(side.edge < 2 ? along : 1.0 - along));
  }

  glm::vec3 off_corners(const MidpointStencil& cross) const {
    const auto s = float(cross.st.x), t = float(cross.st.y);
    return at(cross.middle) - glm::mix(glm::mix(at(cross.corners[0]), at(cross.corners[1]), s),
                                       glm::mix(at(cross.corners[3]), at(cross.corners[2]), s), t);
  }

  std::span<const MidpointStencil> crosses_;
  std::span<const std::uint8_t> valid_;
  std::span<const glm::vec3> values_;
};

} // namespace

std::vector<MidpointStencil> crosses_of(const ElementMesh& mesh, const NodeTree& tree,
                                  std::span<const TreeNodeId> nodes) {
  std::vector<MidpointStencil> crosses;
  for (const TreeNodeId id : nodes)
    if (const auto cross = cross_of(mesh, tree, id))
      crosses.push_back(*cross);
  return crosses;
}

std::vector<glm::vec3> edge_bends(std::span<const MidpointStencil> crosses,
                                  std::span<const std::uint8_t> gathered,
                                  std::span<const glm::vec3> values) {
  const EdgeBends edges(crosses, gathered, values);
  std::vector<glm::vec3> bends(values.size(), glm::vec3(0.0F));
  std::vector<std::uint8_t> found(values.size(), 0);

  // Edges with a node of the same size on both sides.
  std::vector<std::optional<EdgeSide>> first(values.size());
  for (std::uint32_t c = 0; c < crosses.size(); ++c)
    for (std::uint32_t k = 0; k < 4; ++k) {
      const ElementVertexId middle = crosses[c].of_edges[k];
      if (gathered[index(middle)] != 0 || !edges.is_known(crosses[c]))
        continue;
      const EdgeSide side{c, k};
      std::optional<EdgeSide>& other = first[index(middle)];
      if (other && edges.have_same_ends(*other, side)) {
        bends[index(middle)] = edges.between(*other, side);
        found[index(middle)] = 1;
      }
      other = side;
    }

  // The others take from the edge opposite: what was found there, or what its middle gathered.
  std::vector<glm::vec3> beside = bends;
  for (std::uint32_t c = 0; c < crosses.size(); ++c)
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::size_t middle = index(crosses[c].of_edges[k]);
      const std::uint32_t across = (k + 2) % 4;
      const std::size_t opposite = index(crosses[c].of_edges[across]);
      if (gathered[middle] != 0 || found[middle] != 0 || !edges.is_known(crosses[c]))
        continue;
      if (found[opposite] != 0)
        beside[middle] = bends[opposite];
      else if (gathered[opposite] != 0)
        beside[middle] = edges.beyond_line({c, across}, values[opposite]);
    }
  return beside;
}

} // namespace meninas
