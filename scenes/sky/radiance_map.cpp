#include "scenes/sky/radiance_map.h"

#include "scenes/content_hash.h"
#include "scenes/photometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace meninas {

namespace {

constexpr float brightest_texel = 1e30F; ///< as of a background

/// The rows and columns about a place, and how far it is from the first to the second.
struct Between {
  int first, second;
  float part;
};

Between columns_at(const RadianceMap& map, double u) {
  const double x = u * map.width - 0.5;
  const double left = std::floor(x);
  const int first = (static_cast<int>(left) % map.width + map.width) % map.width;
  return {first, first + 1 == map.width ? 0 : first + 1, static_cast<float>(x - left)};
}

Between rows_at(const RadianceMap& map, double v) {
  const double y = v * map.height - 0.5;
  const double above = std::floor(y);
  const int last = map.height - 1;
  Between rows{std::clamp(static_cast<int>(above), 0, last),
               std::clamp(static_cast<int>(above) + 1, 0, last), static_cast<float>(y - above)};
  if (map.edge_at_horizon && rows.second == map.height / 2)
    (v < 0.5 ? rows.second : rows.first) = v < 0.5 ? rows.first : rows.second;
  return rows;
}

glm::vec3 value_at(const RadianceMap& map, const std::vector<glm::vec3>& texels, Vec2 place) {
  const Between x = columns_at(map, place.x), y = rows_at(map, place.y);
  const auto at = [&](int column, int row) -> const glm::vec3& {
    return texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) +
                  static_cast<std::size_t>(column)];
  };
  const glm::vec3 above = glm::mix(at(x.first, y.first), at(x.second, y.first), x.part);
  const glm::vec3 below = glm::mix(at(x.first, y.second), at(x.second, y.second), x.part);
  return glm::mix(above, below, y.part);
}

/// What is no radiance becomes one.
void mend(std::vector<glm::vec3>& texels, TexelFaults& faults) {
  for (glm::vec3& texel : texels) {
    bool nan = false, negative = false, infinite = false;
    for (int band = 0; band < 3; ++band) {
      float& value = texel[band];
      if (std::isnan(value)) {
        nan = true;
        value = 0.0F;
      } else if (value < 0.0F) {
        negative = true;
        value = 0.0F;
      } else if (value > brightest_texel) {
        infinite = true;
        value = brightest_texel;
      }
    }
    faults.not_numbers += nan ? 1 : 0;
    faults.negative += negative ? 1 : 0;
    faults.infinite += infinite ? 1 : 0;
  }
}

/// The mean of blocks of `factor` x `factor` texels; blocks at the right and lower edge may be
/// smaller.
void reduce(RadianceMap& map, int factor) {
  const int width = (map.width + factor - 1) / factor, height = (map.height + factor - 1) / factor;
  std::vector<glm::vec3> means;
  means.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      glm::dvec3 sum(0.0);
      int count = 0;
      for (int j = y * factor; j < std::min(map.height, (y + 1) * factor); ++j)
        for (int i = x * factor; i < std::min(map.width, (x + 1) * factor); ++i, ++count)
          sum += glm::dvec3(map.texels[static_cast<std::size_t>(j) *
                                           static_cast<std::size_t>(map.width) +
                                       static_cast<std::size_t>(i)]);
      means.emplace_back(sum / double(count));
    }
  map.width = width;
  map.height = height;
  map.texels = std::move(means);
}

std::uint64_t hash_of(const RadianceMap& map) {
  ContentHash hash;
  hash.add(std::uint64_t(map.width));
  hash.add(std::uint64_t(map.height));
  hash.add(std::as_bytes(std::span(map.texels)));
  hash.add(std::uint64_t{map.edge_at_horizon ? 1U : 0U});
  hash.add(map.turned_cos);
  hash.add(map.turned_sin);
  return hash.value();
}

} // namespace

Vec2 place_of(const RadianceMap& map, const Vec3& direction) {
  const double x = map.turned_cos * direction.x - map.turned_sin * direction.z;
  const double z = map.turned_sin * direction.x + map.turned_cos * direction.z;
  return {0.5 + std::atan2(z, x) / (2.0 * std::numbers::pi),
          std::atan2(std::hypot(x, z), direction.y) / std::numbers::pi};
}

glm::vec3 radiance_from(const RadianceMap& map, const Vec3& direction, Suns suns) {
  const bool left_out = suns == Suns::left_out && !map.without_suns.empty();
  return value_at(map, left_out ? map.without_suns : map.texels, place_of(map, direction));
}

Direction direction_at(const RadianceMap& map, double u, double v) {
  const double azimuth = 2.0 * std::numbers::pi * (u - 0.5), polar = std::numbers::pi * v;
  return turned(map, {std::sin(polar) * std::cos(azimuth), std::cos(polar),
                      std::sin(polar) * std::sin(azimuth)});
}

Direction turned(const RadianceMap& map, const Direction& d) {
  return {map.turned_cos * d.x + map.turned_sin * d.z, d.y,
          map.turned_cos * d.z - map.turned_sin * d.x};
}

double texel_solid_angle(const RadianceMap& map, int row) {
  // cos a - cos b, without cancellation at the poles.
  const double half = 0.5 * std::numbers::pi / map.height;
  return 4.0 * std::numbers::pi / map.width * std::sin((2 * row + 1) * half) * std::sin(half);
}

Rgb mean_radiance(const RadianceMap& map) {
  Rgb sum(0.0);
  for (int j = 0; j < map.height; ++j) {
    Rgb row(0.0);
    for (int i = 0; i < map.width; ++i)
      row += Rgb(map.texels[static_cast<std::size_t>(j) * static_cast<std::size_t>(map.width) +
                            static_cast<std::size_t>(i)]);
    sum += texel_solid_angle(map, j) * row;
  }
  return sum / (4.0 * std::numbers::pi);
}

double mean_beyond(const RadianceMap& map, const Direction& axis) {
  constexpr int steps = 24;
  double sum = 0.0, weights = 0.0;
  for (int j = 0; j < steps; ++j)
    for (int i = 0; i < 2 * steps; ++i) {
      const Direction d = direction_at(map, (i + 0.5) / (2 * steps), (j + 0.5) / steps);
      const double weight = std::max(0.0, glm::dot(d, axis)) *
                            std::sin(std::numbers::pi * (j + 0.5) / steps);
      sum += weight * double{largest(radiance_from(map, d, Suns::left_out))};
      weights += weight;
    }
  return std::max(sum / weights, 1e-30);
}

// --- Suns: texels that touch one another and are brighter than a cap,
//
//   L_c = 100 times the mean luminance of min(L, L_c),   E = sum of (L - capped L) dw,
//
// if all lie within 3 degrees of their mean direction, themselves no wider; the 16 brightest. One of 512 rays that meets
// 100 times the mean adds 20 % to what the others bring: more would be a spot in the picture.

namespace {

constexpr double over_mean = 100.0;
constexpr std::size_t max_suns = 16;
constexpr double widest = 3.0 / 180.0 * std::numbers::pi; ///< from its middle

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
  constexpr double nothing = 1e-6; // of the mean
  double cap = std::numeric_limits<double>::infinity(), least = 0.0;
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
    if (round == 0)
      least = nothing / over_mean * next;
    if (next >= 0.999 * cap)
      break;
    cap = std::max(next, least);
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

/// Half of the diagonal of a texel of that row.
double half_width(const RadianceMap& map, int row) {
  const double polar = std::numbers::pi * (row + 0.5) / map.height;
  return 0.5 * std::hypot(std::numbers::pi / map.height,
                          2.0 * std::numbers::pi / map.width * std::sin(polar));
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
    return half_width(map, static_cast<int>(texel) / map.width) <= widest &&
           glm::dot(middle_of(map, texel), cluster.sun.towards) >= std::cos(widest);
  });
}

} // namespace

/// Fills `suns` and `without_suns` from `texels`.
static void find_suns(RadianceMap& map) {
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
  clusters.resize(std::min(clusters.size(), max_suns));
  if (clusters.empty())
    return;
  map.without_suns = map.texels;
  for (const Cluster& cluster : clusters) {
    map.suns.push_back(cluster.sun);
    for (const std::uint32_t texel : cluster.texels)
      map.without_suns[texel] = capped(map.texels[texel], cap);
  }
}

RadianceMap make_radiance_map(RadianceMap map, const MapPlacement& placement,
                              TexelFaults& faults) {
  expects(map.width > 0 && map.height > 0 &&
              map.texels.size() ==
                  static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height),
          "a map of radiance has texels");
  mend(map.texels, faults);
  while (std::int64_t{(map.width + faults.reduced - 1) / faults.reduced} *
             ((map.height + faults.reduced - 1) / faults.reduced) >
         max_map_texels)
    ++faults.reduced;
  if (faults.reduced > 1)
    reduce(map, faults.reduced);
  if (placement.strength != 1.0)
    for (glm::vec3& texel : map.texels)
      texel = glm::vec3(glm::min(placement.strength * glm::dvec3(texel),
                                 glm::dvec3(double{brightest_texel})));
  const double turned = placement.rotation / 180.0 * std::numbers::pi;
  if (placement.rotation != 0.0) {
    map.turned_cos = std::cos(turned);
    map.turned_sin = std::sin(turned);
  }
  find_suns(map);
  map.hash = hash_of(map);
  return map;
}

std::vector<std::string> warnings_of(const RadianceMap& map, const TexelFaults& faults) {
  std::vector<std::string> lines;
  const auto say = [&](std::int64_t count, const char* fault, const char* taken) {
    if (count > 0)
      lines.push_back(fmt::format("{}: {} {} {}: taken for {}", map.name, count,
                                  count == 1 ? "texel is" : "texels are", fault, taken));
  };
  say(faults.not_numbers, "not a number", "0");
  say(faults.negative, "negative", "0");
  say(faults.infinite, "infinite or nearly so", "1e30");
  if (faults.reduced > 1)
    lines.push_back(fmt::format("{}: reduced to {} x {} texels, {} along each axis to one", map.name,
                                map.width, map.height, faults.reduced));
  return lines;
}

} // namespace meninas
