// Light as files bring it that nobody has looked at: measured luminaires with bytes astray, and pictures
// of the sky with suns, holes and what is no number.
#pragma once

#include "scenes/sky/environment.h"
#include "tests/support/random.h"

#include <string>

namespace meninas::test {

/// An IES file of type C or B, whole or with some of its bytes changed, left out or doubled.
std::string hostile_luminaire(Random& random);

/// The same of any text.
std::string with_bytes_astray(Random& random, std::string text);

/// A map of the sky, a few texels large.
Environment hostile_sky(Random& random);

} // namespace meninas::test
