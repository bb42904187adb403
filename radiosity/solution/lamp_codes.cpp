#include "radiosity/solution/lamp_codes.h"

#include <algorithm>
#include <cmath>

namespace meninas {

namespace {

constexpr float most = 16383.0F; // of a mantissa
constexpr int levels = 63, code_bytes = 6;

float brightest(const glm::vec3& value) { return std::max({value.r, value.g, value.b}); }

std::uint64_t code_of(const glm::vec3& value, int top) {
  int exponent = 0;
  std::frexp(brightest(value), &exponent);
  const int level = exponent - top + levels;
  if (!(brightest(value) > 0.0F) || level < 0)
    return 0;
  std::uint64_t code = static_cast<std::uint64_t>(level);
  for (int band = 0; band < 3; ++band) {
    const float share = std::ldexp(std::max(value[band], 0.0F), -exponent); // below 1
    code = (code << 14) | static_cast<std::uint64_t>(std::lround(most * share));
  }
  return code;
}

glm::vec3 value_of(std::uint64_t code, int top) {
  const int exponent = static_cast<int>(code >> 42) + top - levels;
  glm::vec3 value(0.0F);
  for (int band = 0; band < 3; ++band)
    value[band] =
        std::ldexp(static_cast<float>((code >> (14 * (2 - band))) & 0x3fffU) / most, exponent);
  return value;
}

} // namespace

LampCodes encoded(const VertexLightOfLamp& light) {
  LampCodes codes;
  float largest_value = 0.0F;
  for (const auto* values : {&light.direct, &light.indirect})
    for (const glm::vec3& value : *values)
      largest_value = std::max(largest_value, brightest(value));
  std::frexp(largest_value, &codes.top);
  for (const auto* values : {&light.direct, &light.indirect})
    for (const glm::vec3& value : *values)
      for (std::uint64_t code = code_of(value, codes.top), k = 0; k < code_bytes; ++k, code >>= 8)
        codes.bytes.push_back(static_cast<std::uint8_t>(code & 0xffU));
  return codes;
}

VertexLightOfLamp decoded(int top, std::span<const std::uint8_t> bytes) {
  VertexLightOfLamp light;
  const std::size_t vertices = bytes.size() / (2 * code_bytes);
  for (std::size_t k = 0; k < 2 * vertices; ++k) {
    std::uint64_t code = 0;
    for (std::size_t b = code_bytes; b-- > 0;)
      code = (code << 8) | bytes[code_bytes * k + b];
    (k < vertices ? light.direct : light.indirect).push_back(value_of(code, top));
  }
  return light;
}

} // namespace meninas
