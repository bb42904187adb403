// The points that a run is asked about: those of a file, and grids on nodes.
//
// A file has a point a line, x, y, z in metres and the normal of the plane that receives light there,
// nx, ny, nz of any length; without normals planes face up, +Y. Numbers are separated by commas,
// semicolons or blanks. A first line of words is a header and is left out, as are empty lines and
// those that begin with '#'.
#pragma once

#include "radiosity/queries/measuring_grid.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace meninas {

struct PointRequest {
  std::optional<std::filesystem::path> points; ///< read: .csv
  std::vector<std::string> grids;              ///< nodes
  GridSettings grid;
  std::optional<std::filesystem::path> out; ///< written: .csv or .json

  bool asks() const { return points || !grids.empty(); }
};

/// Points that are reported together.
struct PointSet {
  std::string name; ///< "points", "desk", "desk face 2 back"
  std::vector<QueryPoint> points;
  std::optional<MeasuringGrid> grid; ///< where they are one, without its points
};

/// Throws InputError that names the line. `file` is for messages.
std::vector<QueryPoint> parse_points(std::string_view text, const std::string& file);
/// The same of a file. Throws InputError also where it cannot be read.
std::vector<QueryPoint> read_points(const std::filesystem::path& file);

/// Throws UsageError as measuring_grids() does.
std::vector<PointSet> point_sets(std::vector<QueryPoint> points, const PointRequest& request,
                                 const Scene& scene, const SurfaceModel& surfaces);

} // namespace meninas
