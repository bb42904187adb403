#include "tests/hostile/hostile_materials.h"

#include "tests/hostile/hostile_shapes.h"

#include <array>
#include <numbers>

namespace meninas::test {

Json as_json(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

double hostile_factor(Random& random) {
  const std::array values{0.0, 1.0, 0.5, 0.99, random.between(0.0, 1.0)};
  return values[choose(random, values.size())];
}

Rgb hostile_colour(Random& random) {
  if (happens(random, 0.5))
    return Rgb(hostile_factor(random));
  const double red = hostile_factor(random), green = hostile_factor(random);
  return {red, green, hostile_factor(random)};
}

namespace {

void add_glass(Random& random, Json& extensions) {
  extensions["KHR_materials_transmission"] = {{"transmissionFactor", hostile_factor(random)}};
  extensions["KHR_materials_ior"] = {{"ior", random.between(1.0, 2.5)}};
  if (happens(random, 0.5))
    extensions["KHR_materials_volume"] = {{"thicknessFactor", 0.1},
                                          {"attenuationDistance", power_of_ten(random, -3, 2)},
                                          {"attenuationColor", as_json(hostile_colour(random))}};
}

/// Films thicker and thinner than light is long, of any index, none among them.
void add_film(Random& random, Json& extensions) {
  const double least = happens(random, 0.3) ? 0.0 : power_of_ten(random, 0.0, 4.0);
  extensions["KHR_materials_iridescence"] = {
      {"iridescenceFactor", hostile_factor(random)},
      {"iridescenceIor", happens(random, 0.3) ? 1.0 : random.between(1.0, 4.0)},
      {"iridescenceThicknessMinimum", least},
      {"iridescenceThicknessMaximum", happens(random, 0.5) ? least : power_of_ten(random, 0.0, 5.0)}};
}

void add_layers(Random& random, Json& extensions) {
  if (happens(random, 0.1))
    extensions["KHR_materials_specular"] = {{"specularFactor", hostile_factor(random)},
                                            {"specularColorFactor", as_json(hostile_colour(random))}};
  if (happens(random, 0.15))
    extensions["KHR_materials_diffuse_transmission"] = {
        {"diffuseTransmissionFactor", hostile_factor(random)},
        {"diffuseTransmissionColorFactor", as_json(hostile_colour(random))}};
  if (happens(random, 0.12))
    add_film(random, extensions);
  if (happens(random, 0.1))
    extensions["KHR_materials_sheen"] = {{"sheenColorFactor", as_json(hostile_colour(random))},
                                         {"sheenRoughnessFactor", hostile_factor(random)}};
  if (happens(random, 0.1))
    extensions["KHR_materials_clearcoat"] = {{"clearcoatFactor", hostile_factor(random)},
                                             {"clearcoatRoughnessFactor", hostile_factor(random)}};
  if (happens(random, 0.1))
    extensions["KHR_materials_anisotropy"] = {
        {"anisotropyStrength", hostile_factor(random)},
        {"anisotropyRotation", random.between(0.0, 2.0 * std::numbers::pi)}};
  if (happens(random, 0.05))
    extensions["KHR_materials_unlit"] = Json::object();
}

} // namespace

Json hostile_material(Random& random) {
  const Rgb base = hostile_colour(random);
  const bool metal = happens(random, 0.35);
  Json material{{"doubleSided", happens(random, 0.5)}};
  material["pbrMetallicRoughness"] = {
      {"baseColorFactor", Json::array({base.r, base.g, base.b, hostile_factor(random)})},
      {"metallicFactor", metal ? (happens(random, 0.8) ? 1.0 : hostile_factor(random)) : 0.0},
      {"roughnessFactor", happens(random, 0.4) ? 0.0 : hostile_factor(random)}};
  Json extensions = Json::object();
  if (happens(random, 0.25)) {
    material["emissiveFactor"] = as_json(happens(random, 0.5) ? Rgb(1.0) : hostile_colour(random));
    extensions["KHR_materials_emissive_strength"] = {
        {"emissiveStrength", happens(random, 0.5) ? 1.0 : power_of_ten(random, -6.0, 6.0)}};
  }
  if (happens(random, 0.2))
    add_glass(random, extensions);
  add_layers(random, extensions);
  if (happens(random, 0.1)) {
    material["alphaMode"] = happens(random, 0.5) ? "MASK" : "BLEND";
    material["alphaCutoff"] = hostile_factor(random);
  }
  if (!extensions.empty())
    material["extensions"] = std::move(extensions);
  return material;
}

} // namespace meninas::test
