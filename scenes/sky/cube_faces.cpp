#include "scenes/sky/cube_faces.h"

#include "scenes/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

namespace meninas {

namespace {

/// Where a face is, and which way its pictures run, as seen from inside.
struct FaceAxes {
  Vec3 towards, right, down;
};
constexpr std::array<FaceAxes, 6> axes{{{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                        {{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                        {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
                                        {{0, -1, 0}, {-1, 0, 0}, {0, 0, -1}},
                                        {{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}},
                                        {{0, 0, -1}, {1, 0, 0}, {0, -1, 0}}}};

/// Between the centres of the texels of one face; what is near its edge is its last texel.
glm::vec3 value_at(const TexturePixels& face, double u, double v) {
  const double x = std::clamp(u * face.width - 0.5, 0.0, face.width - 1.0);
  const double y = std::clamp(v * face.height - 0.5, 0.0, face.height - 1.0);
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const int right = std::min(left + 1, face.width - 1), bottom = std::min(top + 1, face.height - 1);
  const auto at = [&](int column, int row) {
    const glm::vec4& texel = face.texels[static_cast<std::size_t>(row * face.width + column)];
    constexpr float least = 1.0F / 255.0F; // of eight bits; 0 would be no number
    return glm::vec3(texel) / std::max(texel.a, least);
  };
  const auto s = static_cast<float>(x - left), t = static_cast<float>(y - top);
  return glm::mix(glm::mix(at(left, top), at(right, top), s),
                  glm::mix(at(left, bottom), at(right, bottom), s), t);
}

glm::vec3 value_towards(const std::array<TexturePixels, 6>& faces, const Vec3& d) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < axes.size(); ++k)
    if (glm::dot(d, axes[k].towards) > glm::dot(d, axes[best].towards))
      best = k;
  const double depth = glm::dot(d, axes[best].towards);
  return value_at(faces[best], 0.5 + 0.5 * glm::dot(d, axes[best].right) / depth,
                  0.5 + 0.5 * glm::dot(d, axes[best].down) / depth);
}

/// The vector turned back by a unit quaternion.
Vec3 turned_back(const std::array<double, 4>& q, const Vec3& v) {
  const Vec3 axis(-q[0], -q[1], -q[2]);
  return v + 2.0 * glm::cross(axis, glm::cross(axis, v) + q[3] * v);
}

std::array<double, 4> unit(std::array<double, 4> q) {
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(length > 0.0) || !std::isfinite(length))
    return {0.0, 0.0, 0.0, 1.0};
  for (double& part : q)
    part /= length;
  return q;
}

} // namespace

RadianceMap map_of_cube(const ImageBasedLight& light, const DecodeFace& decode,
                        std::vector<std::string>& warnings) {
  std::array<TexturePixels, 6> faces;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    faces[k] = decode(light.faces[k], light.name);
    if (faces[k].width != faces[k].height || faces[k].width != faces[0].width)
      throw InputError(light.name, "", "its faces are no squares of one size");
  }
  RadianceMap raw;
  raw.name = light.name;
  raw.width = std::min(4 * faces[0].width, 4096); // 8 Mi texels
  raw.height = raw.width / 2;
  const auto rotation = unit(light.rotation);
  for (int j = 0; j < raw.height; ++j)
    for (int i = 0; i < raw.width; ++i) {
      const Direction d = direction_at(raw, (i + 0.5) / raw.width, (j + 0.5) / raw.height);
      raw.texels.push_back(value_towards(faces, turned_back(rotation, d)));
    }
  TexelFaults faults;
  RadianceMap map = make_radiance_map(std::move(raw), {.strength = light.intensity}, faults);
  std::ranges::move(warnings_of(map, faults), std::back_inserter(warnings));
  return map;
}

void settle_environment(Environment& environment, const DecodeFace& decode,
                        std::vector<std::string>& warnings) {
  if (!environment.encoded)
    return;
  const auto light = std::exchange(environment.encoded, nullptr);
  try {
    RadianceMap map = map_of_cube(*light, decode, warnings);
    if (mean_radiance(map) != Rgb(0.0))
      environment.map = std::make_shared<const RadianceMap>(std::move(map));
  } catch (const InputError& problem) {
    warnings.push_back(
        fmt::format("EXT_lights_image_based is left out: {}", problem.what()));
  }
}

} // namespace meninas
