// Direct light on a mesh as fine as its edges ask for.
//
// D(x) has the edges of shadows and of what mirrors throw, and takes a few shadow rays a point:
// it is refined by itself (field_refinement.h), whatever is gathered besides.
#pragma once

#include "radiosity/field/adaptive/field_refinement.h"
#include "radiosity/field/interpolation_settings.h"
#include "radiosity/field/irradiance_field.h"

namespace meninas {

/// The mean of two samples, whose difference tells its variance.
SamplePoint mean_of_two(const SamplePoint& sample);

struct SourceField {
  SampledField field;
  std::uint64_t form_factor_rays = 0;
  std::uint64_t shadow_rays = 0;
};

/// `weight` is w by CellId of the roots.
SourceField field_from_source(const LightScene& light, std::span<const double> weight,
                              const FormFactorSettings& form_factors, const DirectSettings& direct,
                              const RefinementSettings& refinement);

} // namespace meninas
