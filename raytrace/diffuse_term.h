// The diffuse term of pass two at a point: the irradiance that a surface reflects there.
//
//   interpolated   H = the field of pass one
//   direct         H = D(x) + the interpolated field without D: light of emitters and of their mirror images is
//                  computed at the point itself. A picture looks it up in a field as fine as its pixels
//                  (views/view_light.h), so that shadows and mirror spots are as sharp as they are
//   gather         H = D(x) + one gathering over the hemisphere, from elements as bright as the field says
//
// D(x) owns the same paths in all three (direct_irradiance.h,
// point_irradiance.h), so that none is counted twice.
#pragma once

#include "radiosity/field/view/view_field.h"
#include "radiosity/light/point_irradiance.h"
#include "raytrace/field_shading.h"

#include <memory>

namespace meninas {

enum class DiffuseTerm { interpolated, direct, gather };

struct DiffuseSettings {
  DiffuseTerm term = DiffuseTerm::interpolated;
  DirectSettings direct{
      .shadow_rays = 16, .penumbra_rays = 64, .solid_rays = 16}; ///< at a camera ray's hit
  ViewRefinement refinement; ///< of the field that a picture with `direct` is looked up in
  FormFactorSettings gather; ///< how the rays of `gather` are followed
  PointGatheringSettings points{.rays = 64, .cluster_shadow_rays = 4}; ///< of `gather`, at a hit
  /// With `gather`: the number of places, among those where the rays of a hit land, at which light is gathered
  /// once more instead of taken from the elements; 0: the radiosity of the elements is used everywhere.
  int places = 0;
  std::uint32_t draw = 0; ///< another one: other samples at the hits of the same camera rays
};

/// The values of the field that the term builds on;
/// `direct` expects a field that knows its indirect part.
FieldContent field_content(const IrradianceField& field, const DiffuseSettings& settings);

/// The reflected radiosity of the elements, as a field says:
/// rho times the mean of H at their corners, and tau times that of the elements behind.
std::vector<Rgb> reflected_by_elements(const IrradianceField& field);

/// The same, of each lamp too where the field is told apart by lamps.
SentLight sent_light(const IrradianceField& field);

/// The light that `gather` gathers from; null for other terms.
std::unique_ptr<const PointGathering>
make_gathering(const IrradianceField& field, const DiffuseSettings& settings);

/// The scene and light that the term is computed from, the same for all points.
struct DiffuseSource {
  const LightScene& light;
  const DiffuseSettings& settings;
  const PointGathering* gathering; ///< of `gather`, else null
  ReflectedPart part;
};

/// H at a point, W/m^2. `field` is what the interpolated part of it says there.
glm::vec3 irradiance_at_point(const DiffuseSource& source, const glm::vec3& field,
                              const Receiver& receiver, std::uint32_t seed, PointWorkspace& work);

} // namespace meninas
