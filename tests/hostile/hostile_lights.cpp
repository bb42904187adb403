#include "tests/hostile/hostile_lights.h"

#include "scenes/sky/radiance_map.h"
#include "tests/hostile/hostile_shapes.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <string_view>
#include <vector>

namespace meninas::test {

namespace {

/// Rising from `first` to `last`, some of them hardly.
std::string angles(Random& random, std::uint32_t count, double first, double last) {
  std::string text;
  for (std::uint32_t k = 0; k < count; ++k) {
    const double share = count > 1 ? double(k) / (count - 1) : 0.0;
    const bool between = k > 0 && k + 1 < count && happens(random, 0.2);
    text += fmt::format("{} ", first + share * (last - first) - (between ? 1e-9 : 0.0));
  }
  return text + '\n';
}

std::string candela(Random& random, std::uint32_t count) {
  std::string text;
  for (std::uint32_t k = 0; k < count; ++k)
    text += fmt::format("{:.6g}{}", happens(random, 0.3) ? 0.0 : power_of_ten(random, -6.0, 6.0),
                        k % 5 == 4 ? '\n' : ' ');
  return text;
}

} // namespace

std::string with_bytes_astray(Random& random, std::string text) {
  static constexpr std::string_view bytes = "0129.-+eE ,;\n\r\t\0=#\"NnTfx\xff";
  for (std::uint32_t k = 0, count = 1 + choose(random, 6); k < count && !text.empty(); ++k) {
    const auto at = choose(random, static_cast<std::uint32_t>(text.size()));
    const char byte = bytes[choose(random, bytes.size())];
    switch (choose(random, 5)) {
    case 0:
      text.erase(at, 1 + choose(random, 20));
      break;
    case 1:
      text.insert(at, 1 + choose(random, 3), byte);
      break;
    case 2:
      text.insert(at, text.substr(at, 1 + choose(random, 40)));
      break;
    case 3:
      text.insert(at, "1e308");
      break;
    default:
      text[at] = byte;
    }
  }
  return text;
}

std::string hostile_luminaire(Random& random) {
  const bool type_c = happens(random, 0.7);
  const std::array around{0.0, 90.0, 180.0, 360.0};
  const double last = type_c ? around[choose(random, 4)] : 90.0;
  const std::uint32_t vertical = 1 + choose(random, 7),
                      horizontal = last == 0.0 ? 1 : 2 + choose(random, 5);
  std::string text = "IESNA:LM-63-2002\n[TEST] hostile\nTILT=NONE\n";
  const double multiplier = power_of_ten(random, -3, 3), ballast = happens(random, 0.1) ? 0.0 : 1.0;
  text += fmt::format("1 1000 {} {} {} {} 2 0 0 0\n{} 1 10\n", multiplier, vertical, horizontal, type_c ? 1 : 2, ballast);
  text += angles(random, vertical, type_c ? 0.0 : -90.0, type_c ? (happens(random, 0.5) ? 90.0 : 180.0) : 90.0);
  text += angles(random, horizontal, type_c || happens(random, 0.5) ? 0.0 : -last, last);
  text += candela(random, vertical * horizontal);
  return happens(random, 0.7) ? text : with_bytes_astray(random, std::move(text));
}

Environment hostile_sky(Random& random) {
  RadianceMap raw;
  raw.name = "hostile sky";
  raw.height = static_cast<int>(1 + choose(random, 16));
  raw.width = happens(random, 0.8) ? 2 * raw.height : static_cast<int>(1 + choose(random, 40));
  raw.edge_at_horizon = happens(random, 0.2);
  const double least = happens(random, 0.3) ? 0.0 : power_of_ten(random, -3, 1);
  raw.texels.assign(static_cast<std::size_t>(raw.width) * static_cast<std::size_t>(raw.height),
                    glm::vec3(static_cast<float>(least)));
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const std::array odd{infinity, std::numeric_limits<float>::quiet_NaN(), -1.0F, 1e30F, 1e-40F};
  for (std::uint32_t k = 0, count = choose(random, 6); k < count; ++k) {
    glm::vec3& texel = raw.texels[choose(random, static_cast<std::uint32_t>(raw.texels.size()))];
    texel = happens(random, 0.9) ? glm::vec3(static_cast<float>(power_of_ten(random, -2.0, 5.0)))
                                 : glm::vec3(odd[choose(random, odd.size())]);
  }
  TexelFaults faults;
  const MapPlacement placement{random.between(-360.0, 360.0), power_of_ten(random, -2.0, 2.0)};
  auto map = std::make_shared<const RadianceMap>(make_radiance_map(std::move(raw), placement, faults));
  Environment sky;
  if (mean_radiance(*map) != Rgb(0.0)) // black ones are none (runs/environment_choice.cpp)
    sky.map = std::move(map);
  return sky;
}

} // namespace meninas::test
