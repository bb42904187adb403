// The hemicube:
// half a cube about a point, its five faces divided into cells (Cohen and Greenberg 1985).
//
// The half cube [-1, 1] x [-1, 1] x [0, 1] stands on the plane of the point, z along its normal.
// A cell sees the part of the hemisphere that lies behind it,
// and its delta form factor is the form factor from the point to the cell,
//   dF = int_cell cos(theta_x) cos(theta_c) / (pi r^2) dA,  on the top  1/pi int 1 / (1 + x^2 + y^2)^2 dx dy,
//                                                        on a side  1/pi int z / (1 + y^2 + z^2)^2 dy dz,
// here in closed form instead of the classic value at the cell's centre times its area. With
//   T(x, y) = 1/(2 pi) ( x / sqrt(1 + x^2) atan(y / sqrt(1 + x^2)) + y / sqrt(1 + y^2)
//   atan(x / sqrt(1 + y^2)) ), S(y, z) = -1/(2 pi) atan(y / sqrt(1 + z^2)) / sqrt(1 + z^2)
// (Hamilton and Morgan 1952:
// a rectangle parallel or at right angles to the point's plane) the integral over [x0, x1] x [y0,
// y1] is T(x1, y1) - T(x0, y1) - T(x1, y0) + T(x0, y0), and the same of S on a side:
// neighbours share their corners, so all cells of the five faces add up to one, to rounding.
//
// Each cell is looked up by one ray through its centre (hemisphere_rays.h),
// so a form factor is the sum of the dF of the cells whose ray lands.
// Its error is that of the cells along the outline, each of which counts as a whole or not at all:
// at most their sum / 2, of order 1 in 1 / resolution when an outline runs along the rows of cells,
// of order 3/2 when it crosses them at random.
#pragma once

#include "radiosity/transport/hemisphere_samples.h"

namespace meninas {

/// T of the cells of the top and S of those of a side, by the coordinates above; form factors, dimensionless.
double top_corner_integral(double x, double y);
double side_corner_integral(double y, double z);

/// Sixteen cells, lane by lane: the direction through the centre in the frame of the point (not
/// of unit length), and the delta form factor times the number of all cells: a weight of mean 1.
struct alignas(64) HemicubePacket {
  LaneDirections direction;
  LaneFloats weight;
};

struct Hemicube {
  int resolution = 0;                  ///< cells along an edge of the top; sides are half as high
  std::size_t cells = 0;               ///< 3 resolution^2
  std::vector<HemicubePacket> packets; ///< blocks of 4 x 4 cells; the last may not be full
};

/// `resolution` is even.
Hemicube make_hemicube(int resolution);

/// Puts the rays of a packet of cells,
/// from the corner of the source's area, into all lanes but `count`.
void set_rays(const HemicubePacket& cells, const RaySource& source, RayPacket& packet);

} // namespace meninas
