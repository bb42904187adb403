// What `solve --by-lamp`, `render --lamp`, `render --solution`, `solve --points`, `--grid` and `walk` do with
// a solution, and what must hold of it:
//
//   the light of lamps is finite, not negative and adds up to all light; so are pictures under other lamps,
//   a solution that is read back is the one that was written, and of one that was changed, cut off or is
//   another scene's a UserError says so: whatever it says, reading it ends,
//   light at points is finite and not negative, on grids as well,
//   all numbers of a page to walk through are finite.
#pragma once

#include "raytrace/two_pass.h"
#include "tests/support/random.h"

namespace meninas::test {

/// Throws a Finding (every_command.h).
void use_solution(const PreparedScene& prepared, const RadiositySolution& solution,
                  const TwoPassSettings& settings, Random& random);

} // namespace meninas::test
