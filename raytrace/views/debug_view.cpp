#include "raytrace/views/debug_view.h"

#include "image/colour_map.h"
#include "image/display.h"
#include "image/colour_scale.h"
#include "raytrace/views/sight.h"
#include "scenes/sampling.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <optional>

namespace meninas {

std::string_view name_of(DebugView view) {
  switch (view) {
  case DebugView::elements:
    return "elements";
  case DebugView::irradiance:
    return "irradiance";
  case DebugView::illuminance:
    return "illuminance";
  case DebugView::luminance:
    return "luminance";
  case DebugView::closure:
    return "closure";
  case DebugView::mirror_depth:
    break;
  }
  return "mirror-depth";
}

namespace {

glm::vec3 linear(const glm::vec3& encoded) {
  return {srgb_decode(encoded.r), srgb_decode(encoded.g), srgb_decode(encoded.b)};
}

/// One of many colours, bright enough to be told from black.
glm::vec3 colour_of_element(std::uint32_t element) {
  const auto channel = [&](std::uint32_t c) {
    return 0.15F + 0.85F * static_cast<float>(hash(element, c) >> 8U) * 0x1p-24F;
  };
  return linear({channel(1), channel(2), channel(3)});
}

float closure_error(const RowClosure& row) {
  return static_cast<float>(
      std::abs(1.0 - (double{row.landed} + row.escaped + row.black + row.cut)));
}

std::optional<float> value_of(DebugView view, const IrradianceField& field,
                              std::span<const RowClosure> rows, const Sight& sight) {
  if (view == DebugView::mirror_depth)
    return static_cast<float>(sight.mirrors);
  if (sight.side == FaceRecord::nothing)
    return std::nullopt;
  const std::uint32_t element = sight.place.element;
  if (view == DebugView::elements)
    return static_cast<float>(element) + 1.0F;
  if (view == DebugView::closure)
    return closure_error(rows[element]);
  const glm::vec3 h = field_irradiance(field.mesh().corners, field.irradiance, element, sight.place.place);
  return glm::dot(h, glm::vec3(0.2126F, 0.7152F, 0.0722F)); // Rec.709
}

} // namespace

PaintedView paint_view(DebugView view, const IrradianceField& field,
                       std::span<const RowClosure> rows, const Camera& camera,
                       const RenderSettings& settings) {
  const LightScene& light = *field.scene;
  expects(view != DebugView::closure || rows.size() == element_count(light.mesh),
          "every element has a row");
  expects(view != DebugView::luminance, "luminance is that of a picture");
  PaintedView painted{Image(settings.width, settings.height),
                      Channel(settings.width, settings.height),
                      Channel(settings.width, settings.height)};
  const double aspect = double(settings.width) / settings.height;
  const int mirrors = settings.mode == RenderMode::hybrid ? settings.max_bounces : 0;
  tbb::parallel_for(0, settings.height, [&](int y) {
    for (int x = 0; x < settings.width; ++x) {
      const Vec2 middle((x + 0.5) / settings.width, (y + 0.5) / settings.height);
      const Sight sight = look(light, camera, aspect, middle, mirrors);
      const auto value = value_of(view, field, rows, sight);
      painted.values.at(x, y) = value.value_or(0.0F);
      painted.known.at(x, y) = value ? 1.0F : 0.0F;
    }
  });
  painted.top = view == DebugView::elements ? static_cast<double>(element_count(light.mesh))
                                            : readable_top(painted.values);
  for (std::size_t p = 0; p < painted.values.values.size(); ++p) {
    if (painted.known.values[p] == 0.0F)
      continue;
    const float value = painted.values.values[p];
    painted.colours.pixels[p] = view == DebugView::elements
                                    ? colour_of_element(static_cast<std::uint32_t>(value))
                                    : linear(magma(double{value} / painted.top));
  }
  return painted;
}

} // namespace meninas
