#include "scenes/repair/common_place.h"

#include <Eigen/SVD>

namespace meninas {

Vec3 way_into(const Point3& x, std::span<const Plane> planes) {
  constexpr double same_plane = 0.05;
  // Of a fixed number of columns there is no thin decomposition where planes are fewer.
  Eigen::MatrixXd normals(planes.size(), 3);
  Eigen::VectorXd rest(planes.size());
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    normals.row(row) << planes[k].normal.x, planes[k].normal.y, planes[k].normal.z;
    rest[row] = -signed_distance(planes[k], x);
  }
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(normals, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(same_plane);
  const Eigen::Vector3d way = svd.solve(rest);
  // Coordinates whose squares overflow have no place in common.
  return way.allFinite() ? Vec3(way.x(), way.y(), way.z()) : Vec3(0.0);
}

} // namespace meninas
