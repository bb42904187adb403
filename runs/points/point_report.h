// Irradiance and illuminance at sets of points, as a table and as JSON.
//
// Columns: the set's name; x, y, z, m; the normal; illuminance in lux, all of it, the direct part and
// the part that came by way of mirrors (radiosity/queries/point_light.h); the same as irradiance,
// red, green and blue, W/m^2; where lamps are known apart, the illuminance by each of them. Lux are K times luminance
// (photometry.h).
#pragma once

#include "runs/points/point_sets.h"

namespace meninas {

struct MeasuredSet {
  PointSet set;
  std::vector<PointIrradiance> light; ///< by point
  double luminous_efficacy = 683.0;   ///< K, lm/W
  std::size_t inside = 0;             ///< points of a grid that were left out
  std::vector<std::string> lamps = {}; ///< whose light is known apart, by their number
};

/// In lux.
std::vector<double> illuminances(const MeasuredSet& measured);

/// A grid without points that lie inside of things, as of a floor on which a cupboard stands.
MeasuredSet without_points_inside(MeasuredSet measured);

/// Grids on backs that nothing lights are left out, as are fronts beside backs that are lit.
std::vector<MeasuredSet> without_dark_sides(std::vector<MeasuredSet> sets);

std::string points_csv(std::span<const MeasuredSet> sets);
std::string points_json(std::span<const MeasuredSet> sets);

/// "grid desk: 8 x 4 points 0.2 x 0.2 m apart: 312 lx at least, 402 in the mean, 510 at most, U0 0.78"
std::string summary_line(const MeasuredSet& measured);

/// `.csv` or `.json`; throws OutputError for another name.
void check_points_file(const std::filesystem::path& file);
void write_points(const std::filesystem::path& file, std::span<const MeasuredSet> sets);

} // namespace meninas
