// The linear system that pass one solves for a scene.
#pragma once

#include "tests/radiosity/lit_scene.h"
#include "tests/radiosity/solvers/radiosity_systems.h"

namespace meninas::test {

System system_of(const LitScene& lit, const FormFactorSettings& form_factors,
                 const DirectSettings& direct);

} // namespace meninas::test
