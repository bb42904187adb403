// Rows of form factors that are kept from one state of a file to the next: they do not depend on emission nor on
// diffuse reflectances (transport/factor_key.h), so that a room of which only these have changed is lit anew without
// them.
//
//   X = rho (D + G) + rho T X      with T as it was
//
// The solution by kept rows is that without, bit for bit.
#pragma once

#include "raytrace/two_pass.h"
#include "radiosity/transport/factor_key.h"

#include <memory>
#include <optional>

namespace meninas {

struct KeptRows {
  std::optional<FactorKey> key; ///< none: there are none
  FormFactors factors;
};

/// The rows that `view` keeps.
struct KeptOfScene {
  std::shared_ptr<const PreparedScene> coarse_scene; ///< that was shown last
  PassOneSettings coarse_settings;                   ///< by which its rows are assembled
  KeptRows coarse, whole;
};

/// Whether they are those of that scene.
bool are_of(const KeptRows& rows, const LightScene& light, const FormFactorSettings& settings);

/// Assembles them if they are others; `settings` is that of an assembly without rows that are kept.
const FormFactors& rows_of(KeptRows& rows, const LightScene& light, const FormFactorSettings& settings,
                           const Progress& progress);

} // namespace meninas
