#include "radiosity/transport/hemicube.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// A face as seen from the point: a cell at (a, b) lies in the direction  out + a along + b up.
struct CubeFace {
  Vec3 out, along, up;
  double lowest; ///< of b; a begins at -1
  double (*corner_integral)(double, double);
};

/// The top and the four sides.
std::array<CubeFace, 5> faces_of_cube() {
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  return {CubeFace{z, x, y, -1.0, top_corner_integral},
          {x, y, z, 0.0, side_corner_integral},
          {-x, y, z, 0.0, side_corner_integral},
          {y, x, z, 0.0, side_corner_integral},
          {-y, x, z, 0.0, side_corner_integral}};
}

struct Cell {
  glm::vec3 direction;
  float weight;
};

Cell cell_of(const CubeFace& face, int resolution, int column, int row) {
  const double size = 2.0 / resolution;
  const double a0 = -1.0 + size * column, a1 = -1.0 + size * (column + 1);
  const double b0 = face.lowest + size * row, b1 = face.lowest + size * (row + 1);
  const auto& integral = face.corner_integral;
  const double delta =
      (integral(a1, b1) - integral(a0, b1)) - (integral(a1, b0) - integral(a0, b0));
  const Vec3 direction = face.out + 0.5 * (a0 + a1) * face.along + 0.5 * (b0 + b1) * face.up;
  return {glm::vec3(direction), static_cast<float>(delta * 3.0 * resolution * resolution)};
}

/// Cells in blocks of 4 x 4, so that those of a packet look the same way.
std::vector<Cell> cells_in_blocks(int resolution) {
  constexpr int block = 4;
  std::vector<Cell> cells;
  cells.reserve(3 * static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution));
  for (const CubeFace& face : faces_of_cube()) {
    const int rows = face.lowest < 0.0 ? resolution : resolution / 2;
    for (int top = 0; top < rows; top += block)
      for (int left = 0; left < resolution; left += block)
        for (int row = top; row < std::min(top + block, rows); ++row)
          for (int column = left; column < std::min(left + block, resolution); ++column)
            cells.push_back(cell_of(face, resolution, column, row));
  }
  return cells;
}

} // namespace

double top_corner_integral(double x, double y) {
  const double of_x = std::sqrt(1.0 + x * x), of_y = std::sqrt(1.0 + y * y);
  return (x / of_x * std::atan(y / of_x) + y / of_y * std::atan(x / of_y)) / two_pi;
}

double side_corner_integral(double y, double z) {
  const double of_z = std::sqrt(1.0 + z * z);
  return -std::atan(y / of_z) / (of_z * two_pi);
}

Hemicube make_hemicube(int resolution) {
  expects(resolution >= 2 && resolution % 2 == 0, "sides are half as high as the top is wide");
  const std::vector<Cell> cells = cells_in_blocks(resolution);
  Hemicube cube;
  cube.resolution = resolution;
  cube.cells = cells.size();
  cube.packets.resize((cells.size() + packet_size - 1) / packet_size);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    HemicubePacket& packet = cube.packets[k / packet_size];
    const std::size_t lane = k % packet_size;
    packet.direction.x[lane] = cells[k].direction.x;
    packet.direction.y[lane] = cells[k].direction.y;
    packet.direction.z[lane] = cells[k].direction.z;
    packet.weight[lane] = cells[k].weight;
  }
  return cube;
}

void set_rays(const HemicubePacket& cells, const RaySource& source, RayPacket& packet) {
  const glm::vec3 from(source.area.corner);
  std::fill_n(packet.origin_x, packet_size, from.x);
  std::fill_n(packet.origin_y, packet_size, from.y);
  std::fill_n(packet.origin_z, packet_size, from.z);
  set_directions(cells.direction, source, packet);
  std::fill_n(packet.max_distance, packet_size, std::numeric_limits<float>::infinity());
  std::fill_n(packet.leaving, packet_size, index(source.area.plane_class));
}

} // namespace meninas
