#include "radiosity/transport/gathered_emission.h"

#include "radiosity/transport/linear_system.h"

#include <algorithm>

namespace meninas {

std::vector<Rgb> gathered_emission(const LightScene& light, const FormFactors& factors) {
  const ElementMesh& mesh = light.mesh;
  std::vector<Rgb> whole(mesh.area.size(), Rgb(0.0)), deep = whole;
  for (std::size_t e = 0; e < mesh.area.size(); ++e) {
    const SideId side = mesh.side_of_element[e];
    (light.direct_sides[index(side)] != 0 ? deep : whole)[e] = mesh.emission[e];
  }

  std::vector<Rgb> gathered(factors.transport.size, Rgb(0.0));
  const auto add = [&](const Transport& transport, const std::vector<Rgb>& emission) {
    if (transport.columns.empty() || std::ranges::count(emission, Rgb(0.0)) == std::ssize(emission))
      return;
    const std::vector<Rgb> light_of_rows = transport_product(transport, emission);
    for (std::size_t i = 0; i < gathered.size(); ++i)
      gathered[i] += light_of_rows[i];
  };
  add(factors.transport, whole);
  add(factors.beyond, deep);
  return gathered;
}

LightByLamp gathered_by_lamp(const LightScene& light, const FormFactors& factors) {
  if (!light.lamps)
    return {};
  const ElementMesh& mesh = light.mesh;
  LightByLamp whole = no_light(mesh.area.size(), light.lamps.count), deep = whole;
  for (std::size_t e = 0; e < mesh.area.size(); ++e) {
    const SideId side = mesh.side_of_element[e];
    const std::uint32_t lamp = light.lamps.of_side[index(side)];
    if (lamp == no_lamp)
      continue;
    LightByLamp& emission = light.direct_sides[index(side)] != 0 ? deep : whole;
    for (int band = 0; band < 3; ++band)
      emission[e][3 * std::size_t{lamp} + static_cast<std::size_t>(band)] = mesh.emission[e][band];
  }

  LightByLamp gathered = no_light(factors.transport.size, light.lamps.count);
  const auto add = [&](const Transport& transport, const LightByLamp& emission) {
    if (!transport.columns.empty() && std::ranges::any_of(emission.values, [](double sent) { return sent != 0.0; }))
      gathered += transport_product(transport, emission);
  };
  add(factors.transport, whole);
  add(factors.beyond, deep);
  return gathered;
}

} // namespace meninas
