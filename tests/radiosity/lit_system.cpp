#include "tests/radiosity/lit_system.h"

#include "radiosity/light/element_light.h"
#include "radiosity/transport/gathered_emission.h"

namespace meninas::test {

System system_of(const LitScene& lit, const FormFactorSettings& form_factors,
                 const DirectSettings& direct) {
  const FormFactors factors = assemble_transport(*lit.light, form_factors);
  const DirectIrradiance found = direct_irradiance(*lit.light, factors.covered, direct);
  const std::vector<Rgb> gathered = gathered_emission(*lit.light, factors);
  System system{factors.transport, {}, {}};
  for (std::size_t i = 0; i < element_count(lit.mesh); ++i) {
    system.reflectance.push_back(lit.mesh.sides[index(lit.mesh.side_of_element[i])].reflectance);
    system.source.push_back(system.reflectance[i] * (found.irradiance[i] + gathered[i]));
  }
  return system;
}

} // namespace meninas::test
