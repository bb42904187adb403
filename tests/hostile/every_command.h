// What `plan`, `solve`, `render` and `formfactors` do with a scene, at a tiny size and with settings
// drawn at random, and what must hold of what comes out:
//
//   every radiosity, irradiance, energy, pixel and form factor is finite and not negative,
//   a form factor is at most 1, as is the sum of those to bodies that hide one another and pass nothing on,
//   under a sky alone nothing is brighter than the sky (a bound of every bounce: rho <= 1) or than what is unlit.
//
// What goes on from the solution is done as well (solution_commands.h).
#pragma once

#include "scenes/scene.h"
#include "tests/support/random.h"

namespace meninas::test {

/// So many triangles or fewer are also asked for form factors, and drawn by the reference.
struct Effort {
  std::size_t max_triangles = 20'000; ///< more are planned and no more
  std::size_t max_drawn_triangles = 150;
};

/// Throws a Finding (findings.h), which names the settings. A UserError is the program's right and is passed on.
void run_every_command(Scene scene, Random& random, const Effort& effort);

} // namespace meninas::test
