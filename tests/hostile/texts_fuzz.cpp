// Throws texts with bytes astray at what reads small ones: IES files, lists of points and --lamp. Any text is
// read as numbers that make sense, or ends with one error. Anything else is a finding, and so is a sanitizer's report:
//
//   texts_fuzz [--seed N] [--count N]
#include "cli/light/lamp_options.h"
#include "runs/points/point_sets.h"
#include "scenes/errors.h"
#include "scenes/ies/ies_file.h"
#include "tests/hostile/findings.h"
#include "tests/hostile/hostile_lights.h"
#include "tests/hostile/hostile_shapes.h"

#include <array>
#include <charconv>
#include <cstdio>
#include <string_view>

namespace {

using namespace meninas;
using namespace meninas::test;

template <std::size_t N>
std::string one_of(Random& random, const std::array<const char*, N>& texts) {
  return texts[choose(random, N)];
}

void read_luminaire(Random& random, const std::string& text) {
  const IntensityDistribution distribution = parse_ies(text);
  for (int k = 0; k < 8; ++k) {
    const Direction along[] = {random.direction(), {1, 0, 0}, {0, 0, -1}, {0, -1, 0}, {0, 0, 1}};
    const double candela = intensity_at(distribution, along[choose(random, 5)]);
    require(std::isfinite(candela) && candela >= 0.0 && candela <= 1e12, "an intensity of " + std::to_string(candela));
  }
  if (happens(random, 0.02))
    require(std::isfinite(luminous_flux(distribution)), "a flux that is no number");
}

void read_points(Random& random) {
  constexpr std::array lists{"x,y,z,nx,ny,nz\r\n1,2,3,0,0,2\r\n\n# a remark\n4,5,6,1,0,0\n",
                             "\xEF\xBB\xBF" "1;2.5;-1e-1\n+3;4;5", "1 2 3\n4\t5\t6\t1\t0\t0\n", "0,0,0"};
  for (const QueryPoint& point : parse_points(with_bytes_astray(random, one_of(random, lists)), "points.csv")) {
    require(glm::length(point.position) <= 1.8e9, "a point that is nowhere");
    require(std::abs(glm::length(point.normal) - 1.0) < 1e-9, "a normal of another length than 1");
  }
}

void read_lamps(Random& random) {
  constexpr std::array texts{"lamp=0.5", "a=b=1,0.5,0.25", "all=0;desk lamp=1e6", "sky=0,0,1;sun=2;x=1e-300"};
  std::vector<LampFactor> lamps;
  Options command("", "hostile");
  add_lamp_factors(command, "", lamps);
  command.parse({with_bytes_astray(random, one_of(random, texts)), "--lamp"});
  for (const LampFactor& lamp : lamps) {
    require(!lamp.lamp.empty(), "a lamp without a name");
    require(is_light(lamp.factor) && glm::compMax(lamp.factor) <= 1e6, "a factor that is none");
  }
}

/// Whether it is read.
bool try_seed(std::uint32_t seed) {
  Random random(seed);
  try {
    switch (choose(random, 3)) {
    case 0:
      read_luminaire(random, with_bytes_astray(random, hostile_luminaire(random)));
      break;
    case 1:
      read_points(random);
      break;
    default:
      read_lamps(random);
    }
    return true;
  } catch (const UserError&) {
    return false;
  } catch (const IesProblem& problem) {
    require(problem.line >= 1, "a problem in no line");
    return false;
  }
}

} // namespace

int main(int count, char** arguments) {
  std::uint32_t seed = 1, tries = 20'000, read = 0, found = 0;
  for (int k = 1; k + 1 < count; k += 2) {
    const std::string_view name = arguments[k], value = arguments[k + 1];
    std::from_chars(value.data(), value.data() + value.size(), name == "--seed" ? seed : tries);
  }
  for (std::uint32_t k = 0; k < tries; ++k)
    try {
      read += try_seed(seed + k) ? 1 : 0;
    } catch (const std::exception& error) {
      std::fprintf(stderr, "seed %u: %s\n", seed + k, error.what());
      ++found;
    }
  std::printf("%u texts from seed %u, %u read, %u findings\n", tries, seed, read, found);
  return found > 0 ? 1 : 0;
}
