#include "scenes/sky/suns.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

namespace {

constexpr double over_mean = 100.0;
constexpr std::size_t most_suns = 16;
const double widest_cosine = std::cos(3.0 / 180.0 * std::numbers::pi);

/// What bilinear interpolation makes of a map's texels: the mean over each is not the texel's own,
/// but sums over texels that touch no pole are the same to second order in their size.
struct Cluster {
  std::vector<std::uint32_t> texels;
  DistantSun sun;
};

std::uint32_t number_of(const RadianceMap& map, int column, int row) {
  return static_cast<std::uint32_t>(row * map.width + column);
}

/// The luminance over which texels are suns; infinite where there is no light.
double cap_of(const RadianceMap& map) {
  double cap = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 64; ++round) {
    double sum = 0.0;
    for (int j = 0; j < map.height; ++j) {
      double row = 0.0;
      for (int i = 0; i < map.width; ++i)
        row += std::min(cap, luminance_of(map.texels[number_of(map, i, j)]));
      sum += texel_solid_angle(map, j) * row;
    }
    const double next = over_mean * sum / (4.0 * std::numbers::pi);
    if (!(next > 0.0))
      return std::numeric_limits<double>::infinity();
    if (next >= 0.999 * cap)
      break;
    cap = next;
  }
  return cap;
}

/// Texels that touch `start`, itself among them, each marked as seen.
Cluster cluster_from(const RadianceMap& map, double cap, std::uint32_t start,
                     std::vector<std::uint8_t>& seen) {
  Cluster cluster;
  cluster.texels.push_back(start);
  seen[start] = 1;
  for (std::size_t k = 0; k < cluster.texels.size(); ++k) {
    const int column = static_cast<int>(cluster.texels[k]) % map.width;
    const int row = static_cast<int>(cluster.texels[k]) / map.width;
    for (int j = std::max(0, row - 1); j <= std::min(map.height - 1, row + 1); ++j)
      for (int i = -1; i <= 1; ++i) {
        const std::uint32_t next = number_of(map, (column + i + map.width) % map.width, j);
        if (seen[next] == 0 && luminance_of(map.texels[next]) > cap) {
          seen[next] = 1;
          cluster.texels.push_back(next);
        }
      }
  }
  return cluster;
}

Direction middle_of(const RadianceMap& map, std::uint32_t texel) {
  const auto width = static_cast<std::uint32_t>(map.width);
  return direction_at(map, (texel % width + 0.5) / map.width, (texel / width + 0.5) / map.height);
}

/// What is left of a texel.
glm::vec3 capped(const glm::vec3& texel, double cap) {
  return glm::vec3(cap / luminance_of(texel) * glm::dvec3(texel));
}

/// Whether the cluster is small enough; finds its sun.
bool is_sun(const RadianceMap& map, double cap, Cluster& cluster) {
  Vec3 towards(0.0);
  for (const std::uint32_t texel : cluster.texels) {
    const Rgb more = Rgb(map.texels[texel]) - Rgb(capped(map.texels[texel], cap));
    const double solid_angle = texel_solid_angle(map, static_cast<int>(texel) / map.width);
    cluster.sun.irradiance += solid_angle * more;
    towards += solid_angle * luminance_of(glm::vec3(more)) * middle_of(map, texel);
  }
  const double length = glm::length(towards);
  if (!(length > 0.0) || !std::isfinite(length))
    return false;
  cluster.sun.towards = towards / length;
  return std::ranges::all_of(cluster.texels, [&](std::uint32_t texel) {
    return glm::dot(middle_of(map, texel), cluster.sun.towards) >= widest_cosine;
  });
}

} // namespace

void find_suns(RadianceMap& map) {
  const double cap = cap_of(map);
  std::vector<Cluster> clusters;
  std::vector<std::uint8_t> seen(map.texels.size(), 0);
  for (std::uint32_t texel = 0; texel < map.texels.size(); ++texel)
    if (seen[texel] == 0 && luminance_of(map.texels[texel]) > cap) {
      Cluster cluster = cluster_from(map, cap, texel, seen);
      if (is_sun(map, cap, cluster))
        clusters.push_back(std::move(cluster));
    }
  std::ranges::stable_sort(clusters, std::greater{}, [](const Cluster& cluster) {
    return luminance_of(glm::vec3(cluster.sun.irradiance));
  });
  clusters.resize(std::min(clusters.size(), most_suns));
  if (clusters.empty())
    return;
  map.without_suns = map.texels;
  for (const Cluster& cluster : clusters) {
    map.suns.push_back(cluster.sun);
    for (const std::uint32_t texel : cluster.texels)
      map.without_suns[texel] = capped(map.texels[texel], cap);
  }
}

} // namespace meninas
