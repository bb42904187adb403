#include "radiosity/hierarchical/node_correction.h"

#include "radiosity/mesh/subdivision.h"
#include "radiosity/solvers/solve.h"

#include <algorithm>

namespace meninas {

std::vector<Rgb> further_reflected(const ReceiverSystem& system, const std::vector<Rgb>& missed) {
  std::vector<Rgb> mean(system.reflectance.size(), Rgb(0.0));
  std::vector<double> area(mean.size(), 0.0);
  for (std::size_t e = 0; e < missed.size(); ++e) {
    const std::uint32_t c = system.receiver_of_element[e];
    mean[c] += system.areas[e] * missed[e];
    area[c] += system.areas[e];
  }
  for (std::size_t c = 0; c < mean.size(); ++c)
    mean[c] = area[c] > 0.0 ? mean[c] / area[c] : Rgb(0.0);
  // A hundredth of what is some per mille itself.
  SolverSettings settings = system.solver;
  settings.method = SolverMethod::bicgstab;
  settings.tolerance = std::max(settings.tolerance, 0.01);
  const SolverResult solved = solve(
      system.links, scattered(system.reflectance, system.translucent, mean),
      Scattering{system.reflectance, system.translucent}, settings);
  const std::vector<Rgb> arrived = apply_transport(system.links, solved.radiosity);
  std::vector<Rgb> more;
  more.reserve(missed.size());
  for (const std::uint32_t c : system.receiver_of_element)
    more.push_back(arrived[c]);
  return more;
}

void add_reflected(const std::vector<Rgb>& more, std::vector<Rgb>& received) {
  for (std::size_t e = 0; e < received.size(); ++e)
    received[e] += glm::clamp(more[e], -0.5 * received[e], 0.5 * received[e]);
}

void add_reflected(const ReceiverSystem& system, const VertexSamples& found,
                   const std::vector<Rgb>& more, VertexIrradiance& field) {
  for (std::size_t v = 0; v < field.indirect.size(); ++v) {
    Rgb sum(0.0);
    double area = 0.0;
    for (const ElementId e : around(found.around, v)) {
      sum += system.areas[index(e)] * more[index(e)];
      area += system.areas[index(e)];
    }
    if (!(area > 0.0))
      continue;
    for (int band = 0; band < 3; ++band) {
      const double before = double{field.indirect[v][band]};
      if (!(before > 0.0))
        continue;
      const auto times =
          static_cast<float>(std::clamp(sum[band] / (area * before), -0.5, 0.5));
      field.irradiance[v][band] += times * field.indirect[v][band];
      field.mirrored[v][band] += times * field.indirect_mirrored[v][band];
      field.indirect[v][band] += times * field.indirect[v][band];
      field.indirect_mirrored[v][band] += times * field.indirect_mirrored[v][band];
    }
  }
  for (auto* values :
       {&field.irradiance, &field.mirrored, &field.indirect, &field.indirect_mirrored})
    settle_hanging(found.mesh, *values);
}

} // namespace meninas
