#include "radiosity/relight.h"

#include <algorithm>
#include <numbers>
#include <numeric>

namespace meninas {

void add_up_by_vertex(VertexIrradiance& field) {
  // Where nothing is known of any lamp each has its share of all light.
  std::vector<glm::dvec3> in_all;
  for (const auto& [direct, indirect] : field.by_lamp) {
    glm::dvec3& sum = in_all.emplace_back(0.0);
    for (std::size_t v = 0; v < direct.size(); ++v)
      sum += glm::dvec3(direct[v]) + glm::dvec3(indirect[v]);
  }
  // Where nothing is known of any lamp anywhere, as of a narrow spot between all points, all have equal shares.
  const glm::dvec3 known = std::accumulate(in_all.begin(), in_all.end(), glm::dvec3(0.0));
  for (glm::dvec3& sum : in_all)
    for (int band = 0; band < 3; ++band)
      sum[band] = known[band] > 0.0 ? sum[band] : 1.0;
  const auto share = [&](std::vector<glm::vec3> VertexLightOfLamp::*part, std::size_t v,
                         const glm::vec3& whole) {
    for (int band = 0; band < 3; ++band) {
      double sum = 0.0; // of denormals too
      for (VertexLightOfLamp& lamp : field.by_lamp)
        sum += double{(lamp.*part)[v][band] = std::max((lamp.*part)[v][band], 0.0F)};
      for (std::size_t l = 0; l < in_all.size() && !(sum > 0.0); ++l)
        (field.by_lamp[l].*part)[v][band] = static_cast<float>(in_all[l][band]);
      if (!(sum > 0.0))
        for (const VertexLightOfLamp& lamp : field.by_lamp)
          sum += double{(lamp.*part)[v][band]};
      const double times = sum > 0.0 ? double{std::max(whole[band], 0.0F)} / sum : 0.0;
      for (VertexLightOfLamp& lamp : field.by_lamp)
        (lamp.*part)[v][band] = static_cast<float>(double{(lamp.*part)[v][band]} * times);
    }
  };
  for (std::size_t v = 0; !field.by_lamp.empty() && v < field.irradiance.size(); ++v) {
    share(&VertexLightOfLamp::indirect, v, field.indirect[v]);
    share(&VertexLightOfLamp::direct, v, field.irradiance[v] - field.indirect[v]);
  }
}

namespace {

/// The same scene and mesh with lamps so bright. The division of emitters between methods stays as it was solved.
struct RelitScene {
  std::shared_ptr<const LightScene> of; // whose surfaces and rays it shares
  Scene scene;
  ElementMesh mesh;
  LightScene light; // refers to both

  RelitScene(const std::shared_ptr<const LightScene>& shared, std::span<const Rgb> factors)
      : RelitScene(shared, *shared, factors) {}

private:
  RelitScene(std::shared_ptr<const LightScene> shared, const LightScene& from, std::span<const Rgb> factors)
      : of(std::move(shared)), scene(with_lights(from, factors)), mesh(from.mesh),
        light(make_light_scene(scene, from.surfaces, from.rays, {from.mirrors, from.worlds}, mesh,
                               from.textures)) {
    // The sky's openings have its new light already.
    const auto of_side = [&](SideId side) {
      const std::uint32_t lamp = from.lamps.of_side[index(side)];
      return lamp == no_lamp ? Rgb(1.0) : factors[lamp];
    };
    std::vector<Emitter> lit;
    std::vector<SideId> sides;
    for (std::size_t k = 0; k < light.emitters.size(); ++k) {
      Emitter emitter = light.emitters[k];
      const SideId side = light.side_of_emitter[k];
      if (side != none<SideId>)
        emitter.radiosity *= of_side(side);
      if (emitter.radiosity == Rgb(0.0))
        continue;
      lit.push_back(emitter);
      sides.push_back(side);
    }
    light.emitters = std::move(lit);
    light.side_of_emitter = std::move(sides);
    light.emitter_tree = make_emitter_tree(light.emitters);
    for (std::uint32_t s = 0; s < mesh.sides.size(); ++s) {
      light.emission_factors.push_back(of_side(SideId{s}));
      mesh.sides[s].emission *= light.emission_factors.back();
    }
    for (std::size_t e = 0; e < mesh.emission.size(); ++e)
      mesh.emission[e] *= light.emission_factors[index(mesh.side_of_element[e])];
  }

  static Scene with_lights(const LightScene& from, std::span<const Rgb> factors) {
    Scene scene = from.scene;
    relight_surroundings(scene, *from.lamp_groups, factors);
    return scene;
  }
};

} // namespace

IrradianceField relit(const IrradianceField& field, std::span<const Rgb> factors) {
  expects(field.by_lamp.size() == factors.size() && field.scene->lamps.count == factors.size(),
          "a factor for each lamp that the field is told apart by");
  IrradianceField result{{}, field.scene};
  if (std::ranges::all_of(factors, [](const Rgb& factor) { return factor == Rgb(1.0); })) {
    static_cast<VertexIrradiance&>(result) = field;
    result.by_lamp.clear();
    return result;
  }
  const auto both = std::make_shared<const RelitScene>(field.scene, factors);
  result.scene = {both, &both->light};
  const bool one_factor = std::ranges::all_of(factors, [&](const Rgb& f) { return f == factors[0]; });
  result.irradiance.assign(field.irradiance.size(), glm::vec3(0.0F));
  result.indirect = result.irradiance;
  for (std::size_t v = 0; v < result.irradiance.size(); ++v) {
    if (one_factor) {
      result.irradiance[v] = glm::vec3(factors[0]) * field.irradiance[v];
      result.indirect[v] = glm::vec3(factors[0]) * field.indirect[v];
      continue;
    }
    for (std::size_t l = 0; l < factors.size(); ++l) {
      const glm::vec3 indirect = glm::vec3(factors[l]) * field.by_lamp[l].indirect[v];
      result.indirect[v] += indirect;
      result.irradiance[v] += glm::vec3(factors[l]) * field.by_lamp[l].direct[v] + indirect;
    }
  }
  return result;
}

} // namespace meninas
