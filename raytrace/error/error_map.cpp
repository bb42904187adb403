#include "raytrace/error/error_map.h"

#include "scenes/sampling.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

/// The mean over the square of 2 reach + 1 pixels around each, as far as it is in the picture;
/// one direction after the other.
Image mean_around(const Image& image, int reach) {
  const auto along = [reach](const Image& from, bool across) {
    Image to(from.width, from.height);
    for (int y = 0; y < from.height; ++y)
      for (int x = 0; x < from.width; ++x) {
        const int at = across ? x : y, end = across ? from.width : from.height;
        const int first = std::max(at - reach, 0), last = std::min(at + reach, end - 1);
        for (int k = first; k <= last; ++k)
          to.at(x, y) += across ? from.at(k, y) : from.at(x, k);
        to.at(x, y) /= static_cast<float>(last - first + 1);
      }
    return to;
  };
  return along(along(image, true), false);
}

/// (a - c)(b - c) / unit^2, pixel by pixel.
Image product_about(const Image& a, const Image& b, const Image& c, float unit) {
  Image product(c.width, c.height);
  for (std::size_t p = 0; p < c.pixels.size(); ++p)
    product.pixels[p] = (a.pixels[p] - c.pixels[p]) / unit * ((b.pixels[p] - c.pixels[p]) / unit);
  return product;
}

/// The power of two below: squares in units of it are within floats, and no other bit changes.
float unit_near(double radiance) {
  return radiance > 0.0 ? static_cast<float>(
                              std::exp2(std::clamp(std::floor(std::log2(radiance)), -120.0, 120.0)))
                        : 1.0F;
}

} // namespace

Image error_map(const IrradianceField& field, const Camera& camera,
                const TwoPassSettings& settings, const Image& picture, const PictureError& error) {
  constexpr int reach_of_edges = 1, reach_of_noise = 1;
  const float unit = unit_near(error.mean_radiance);
  RenderSettings shown = settings.render;
  shown.layers = WithLayers::no;
  const auto picture_of = [&](const RenderSettings& render_settings) {
    return render(field, camera, render_settings).image;
  };

  RenderSettings again = shown;
  again.seed = hash(again.seed, 0xa9a17);
  const Image other = picture_of(again);
  const Image noise = mean_around(product_about(other, other, picture, unit), reach_of_noise);

  Image edges(picture.width, picture.height);
  if (shown.diffuse.term == DiffuseTerm::interpolated && !field.indirect.empty()) {
    RenderSettings source = shown;
    source.samples = 1;
    const Image interpolated = picture_of(source);
    source.diffuse.term = DiffuseTerm::direct;
    source.diffuse.direct = settings.pass_one.direct;
    const Image first = picture_of(source);
    source.diffuse.draw = 1;
    edges =
        mean_around(product_about(first, picture_of(source), interpolated, unit), reach_of_edges);
  }

  // The field's error without that of the edges is a share of the radiance. Single rays at edges may be further off than
  // pixels: no more of the estimate goes to edges than is their part of it.
  double edges2 = 0.0, radiance2 = 0.0;
  for (std::size_t p = 0; p < picture.pixels.size(); ++p) {
    const glm::dvec3 l(picture.pixels[p]),
        e(glm::dvec3(edges.pixels[p]) * double(unit) * double(unit));
    edges2 += std::max(e.r + e.g + e.b, 0.0);
    radiance2 +=
        glm::dot(glm::min(l, 4.0 * error.mean_radiance), glm::min(l, 4.0 * error.mean_radiance));
  }
  const double unit2 = std::pow(error.mean_radiance, 2.0) * 3.0 * double(picture.pixels.size()),
               field2 = (std::pow(error.total, 2.0) - std::pow(error.pixels, 2.0)) * unit2,
               at_edges2 = std::min(edges2, std::pow(error.mesh_direct, 2.0) * unit2);
  const double share2 = radiance2 > 0.0 ? std::max(field2 - at_edges2, 0.0) / radiance2 : 0.0;

  Image map(picture.width, picture.height);
  for (std::size_t p = 0; p < map.pixels.size(); ++p) {
    const glm::vec3 l = picture.pixels[p] / unit;
    const glm::vec3 square = glm::max(edges.pixels[p], 0.0F) + 0.5F * noise.pixels[p] +
                             static_cast<float>(share2) * l * l;
    map.pixels[p] = unit * glm::sqrt(square);
  }
  return map;
}

} // namespace meninas
