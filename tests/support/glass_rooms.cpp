#include "tests/support/glass_rooms.h"

#include "image/image_file.h"

#include <array>
#include <cmath>

namespace meninas::test {

Material glass(Rgb tint, double ior) {
  Material material = double_sided(diffuse(tint));
  material.roughness = 0.0;
  material.transmission = 1.0;
  material.ior = ior;
  return material;
}

Material solid_glass(Rgb tint, double ior) {
  Material material = glass(tint, ior);
  material.thickness = 1.0;
  return material;
}

double face_reflectance(double ior, double cosine) {
  const double in = std::acos(cosine), behind = std::asin(std::sin(in) / ior);
  if (in < 1e-6)
    return std::pow((ior - 1.0) / (ior + 1.0), 2.0);
  const double s = std::sin(in - behind) / std::sin(in + behind);
  const double p = std::tan(in - behind) / std::tan(in + behind);
  return 0.5 * (s * s + p * p);
}

double pane_transmittance(double ior, double cosine) {
  const double f = face_reflectance(ior, cosine);
  return (1.0 - f) / (1.0 + f);
}

Texture half_black() {
  Image image(2, 1);
  image.at(1, 0) = glm::vec3(1.0F);
  return {
      .name = "half black", .encoded = encode_png(image, 0.0), .magnified = TexelFilter::nearest};
}

void lay_texture(Scene& scene) {
  const std::array<glm::vec2, 4> coordinates{glm::vec2(0, 1), {1, 1}, {1, 0}, {0, 0}};
  const std::size_t first = scene.vertices.size() - 4;
  for (std::size_t k = 0; k < 4; ++k)
    own_attributes(scene, scene.vertices[first + k]).texcoord = {coordinates[k], coordinates[k]};
}

Scene glowing_room() {
  Scene scene;
  std::array<Material, 6> walls;
  for (std::size_t k = 0; k < 6; ++k)
    walls[k] = diffuse(Rgb(0.0), Rgb(1.0 + double(k), 2.0, 3.0 - 0.4 * double(k)));
  add_room(scene, Point3(0.0), Point3(2.0), walls);
  return scene;
}

Scene glazed_room() {
  Scene scene;
  std::array<Material, 6> walls;
  walls.fill(diffuse(Rgb(0.6, 0.5, 0.4)));
  add_room(scene, Point3(0.0), Point3(2.0), walls);
  add_polygon(scene, "lamp", {{0.6, 1.9, 1.4}, {1.0, 1.9, 1.4}, {1.0, 1.9, 1.0}, {0.6, 1.9, 1.0}},
              double_sided(diffuse(0.0, 10.0)));
  add_polygon(scene, "pane", {{0.2, 0.0, 0.8}, {1.8, 0.0, 0.8}, {1.8, 1.7, 0.8}, {0.2, 1.7, 0.8}},
              glass({0.4, 0.9, 0.6}));
  return scene;
}

Scene half_glazed_room(Halves halves) {
  Scene scene = glazed_room();
  Material pane = scene.materials.back();
  scene.materials.pop_back();
  scene.triangles.resize(scene.triangles.size() - 2);
  if (halves == Halves::by_texture) {
    scene.textures = {half_black()};
    pane.transmission_texture = TextureUse{.texture = TextureId{0}};
    add_polygon(scene, "pane", {{0.2, 0.0, 0.8}, {1.8, 0.0, 0.8}, {1.8, 1.7, 0.8}, {0.2, 1.7, 0.8}},
                pane);
    lay_texture(scene);
    return scene;
  }
  add_polygon(scene, "right", {{1.0, 0.0, 0.8}, {1.8, 0.0, 0.8}, {1.8, 1.7, 0.8}, {1.0, 1.7, 0.8}},
              pane);
  pane.transmission = 0.0;
  add_polygon(scene, "left", {{0.2, 0.0, 0.8}, {1.0, 0.0, 0.8}, {1.0, 1.7, 0.8}, {0.2, 1.7, 0.8}},
              pane);
  return scene;
}

} // namespace meninas::test
