#include "raytrace/diffuse_term.h"

#include "radiosity/field/vertex_places.h"
#include "scenes/sampling.h"

namespace meninas {

FieldContent field_content(const IrradianceField& field, const DiffuseSettings& settings) {
  if (settings.term != DiffuseTerm::direct)
    return FieldContent::all;
  expects(field.indirect.size() == field.irradiance.size(), "the field knows its indirect part");
  return FieldContent::indirect;
}

std::vector<Rgb> reflected_by_elements(const IrradianceField& field) {
  const ElementMesh& mesh = field.mesh();
  return scattered(mesh.reflectance, translucent_links(mesh, {}),
                   corner_means(mesh, field.irradiance));
}

SentLight sent_light(const IrradianceField& field) {
  LightByLamp by_lamp = no_light(element_count(field.mesh()), field.by_lamp.size());
  for (std::size_t l = 0; l < field.by_lamp.size(); ++l) {
    IrradianceField alone{{}, field.scene};
    alone.irradiance = field.by_lamp[l].direct;
    for (std::size_t v = 0; v < alone.irradiance.size(); ++v)
      alone.irradiance[v] += field.by_lamp[l].indirect[v];
    set_light_of_lamp(by_lamp, l, reflected_by_elements(alone));
  }
  return field.by_lamp.empty() ? SentLight(reflected_by_elements(field))
                               : SentLight(reflected_by_elements(field), by_lamp);
}

std::unique_ptr<const PointGathering> make_gathering(const IrradianceField& field,
                                                     const DiffuseSettings& settings) {
  if (settings.term != DiffuseTerm::gather)
    return nullptr;
  return std::make_unique<PointGathering>(*field.scene, reflected_by_elements(field),
                                          settings.gather, settings.direct, settings.points);
}

static glm::vec3 part_of(const ArrivingLight& arrived, ReflectedPart part) {
  switch (part) {
  case ReflectedPart::all:
    return arrived.total;
  case ReflectedPart::straight:
    return glm::max(arrived.total - arrived.mirrored, Rgb(0.0));
  case ReflectedPart::mirrored:
    return arrived.mirrored;
  case ReflectedPart::none:
    break;
  }
  return glm::vec3(0.0F);
}

glm::vec3 irradiance_at_point(const DiffuseSource& source, const glm::vec3& field,
                              const Receiver& receiver, std::uint32_t seed, PointWorkspace& work) {
  const auto& [light, settings, gathering, part] = source;
  if (part == ReflectedPart::none || settings.term == DiffuseTerm::interpolated)
    return field;
  if (gathering) {
    const ArrivingLight arrived = light_at(*gathering, receiver, seed, work).all();
    return part_of(settings.places == 0 ? arrived
                                        : arrived + one_more_bounce(*gathering, receiver,
                                                                    settings.places, seed, work),
                   part);
  }
  // By the draw that light_at() makes:
  // there and here direct light is the same, to the bit.
  return field +
         part_of(direct_irradiance(light, receiver, settings.direct, hash(seed, 1), work.direct),
                 part);
}

} // namespace meninas
