// Charts: the rectangles of a lightmap, one for each patch that the scene's file shows.
//
// A chart has coordinates (a, b) in [0, 1]^2, those of its patch (scenes/surfaces/surfaces.h): of a quad
// its corners are (0,0), (1,0), (1,1), (0,1), of a triangle (0,0), (1,0), (0,1). Where the scene has been
// triangulated anew (scenes/repair/retriangulation.h) the file's triangle is a chart by itself.
//
// A lightmap has one value for both faces of a double-sided surface: the face that receives more.
#pragma once

#include "radiosity/field/irradiance_field.h"
#include "scenes/gltf/geometry/placed_primitives.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace meninas {

inline constexpr std::uint32_t no_chart = 0xffffffffU;

struct Chart {
  std::vector<TriangleId> triangles; ///< of the scene, whose light it shows
  std::optional<std::array<Point3, 3>> face = std::nullopt; ///< a triangle of the file that is no patch
  Facing facing = Facing::front;
  bool triangle = false;             ///< else a quad
  std::array<int, 2> roots{1, 1};    ///< root cells of the mesh along a and b
  int level = 0;                     ///< how often the finest cell of its surface is divided
  double length = 0.0;               ///< of its longest edge, metres
};

struct ChartPoint {
  std::uint32_t chart = no_chart;
  Vec2 at{0.0};
};

struct FileCharts {
  std::vector<Chart> charts;
  /// By primitive, then triangle: where its corners are. No chart where nothing is lit.
  std::vector<std::vector<std::array<ChartPoint, 3>>> corners;
  std::vector<std::string> two_lit; ///< nodes of surfaces both of whose faces receive much
};

/// The charts of a file's primitives in a solved scene.
FileCharts find_charts(const IrradianceField& field,
                       const std::vector<gltf::PlacedPrimitive>& primitives);

/// A triangle of the scene, and the weights of its second and third corner.
struct ChartPlace {
  TriangleId triangle = none<TriangleId>;
  Vec2 barycentric{0.0};
};
/// The point of the scene that (a, b) stands for, the nearest one for what is outside.
ChartPlace place_in_scene(const LightScene& light, const Chart& chart, Vec2 at);

/// Weights of (a, b) in a triangle of the chart, also outside of it.
Vec2 barycentric_at(const LightScene& light, const Chart& chart, TriangleId triangle, Vec2 at);

/// H there, W/m^2, that a surface which reflects alone would need to look the same: of a translucent
/// one H + (tau / rho) H_behind.
glm::vec3 irradiance_at(const IrradianceField& field, const VertexIrradiance& values,
                        const Chart& chart, const ChartPlace& place);

} // namespace meninas
