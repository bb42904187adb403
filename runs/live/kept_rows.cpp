#include "runs/live/kept_rows.h"

namespace meninas {

/// Rows speak of all emission, of whatever element.
static FormFactorSettings for_any_light(FormFactorSettings settings) {
  settings.relightable = true;
  return settings;
}

bool are_of(const KeptRows& rows, const LightScene& light, const FormFactorSettings& settings) {
  return rows.key && *rows.key == factor_key(light, for_any_light(settings));
}

const FormFactors& rows_of(KeptRows& rows, const LightScene& light, const FormFactorSettings& settings,
                           const Progress& progress) {
  if (are_of(rows, light, settings))
    return rows.factors;
  rows = {}; // before there are others: they may be large
  rows.factors = assemble_transport(light, for_any_light(settings), progress);
  rows.key = factor_key(light, for_any_light(settings));
  return rows.factors;
}

} // namespace meninas
