#include "raytrace/two_pass.h"

#include "image/image_file.h"
#include "radiosity/standing_walls.h"
#include "radiosity/surface_colour.h"
#include "scenes/errors.h"
#include "scenes/mixed_scales.h"
#include "scenes/smooth_surfaces.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace meninas {

static TexturePixels decoded(const Texture& texture, TextureContent content) {
  const Encoding encoding = content == TextureContent::colour ? Encoding::srgb : Encoding::linear;
  Bitmap image = decode_image(texture.encoded, encoding, texture.name);
  return {image.width, image.height, std::move(image.pixels)};
}

/// What cannot be decoded changes nothing: white times the factor. A warning says so.
static DecodedTextures decoded_or_white(const Scene& scene, std::vector<std::string>& warnings) {
  return decode_textures(scene, [&](const Texture& texture, TextureContent content) {
    try {
      return decoded(texture, content);
    } catch (const InputError& problem) {
      warnings.push_back(fmt::format("{}: the factor is used alone", problem.what()));
      return TexturePixels{1, 1, {glm::vec4(1.0F)}};
    }
  });
}

std::unique_ptr<PreparedScene> prepare_scene(Scene scene, const PassOneSettings& settings) {
  auto prepared = std::make_unique<PreparedScene>();
  prepared->scene = std::move(scene);
  Stopwatch watch;

  // What is there, and which transport it needs; what it does not need is not run.
  // Where no mirror is followed, what coats reflect is not lost.
  if (settings.form_factors.method == FormFactorMethod::analytic ||
      settings.form_factors.max_bounces == 0)
    spread_coats(prepared->scene);
  prepared->surfaces = find_surfaces(prepared->scene);
  prepared->plan = plan_transport(prepared->scene, prepared->surfaces, settings.plan);
  prepared->seconds.plan = watch.lap();

  // Elements to light, and rays over the input geometry, not over the elements.
  prepared->textures = decoded_or_white(prepared->scene, prepared->plan.warnings);
  prepared->rays.emplace(make_ray_scene(prepared->scene, prepared->surfaces,
                                        holes_of(prepared->scene, prepared->textures)));
  std::ranges::move(warnings_of_mixed_scales(prepared->scene, prepared->surfaces, *prepared->rays),
                    std::back_inserter(prepared->plan.warnings));
  const DarkSides dark = find_dark_sides(prepared->scene, prepared->surfaces, *prepared->rays);
  prepared->mesh = make_element_mesh(prepared->scene, prepared->surfaces, settings.mesh, dark);
  prepared->mesh = divide_under_walls(std::move(prepared->mesh), prepared->scene,
                                      prepared->surfaces, *prepared->rays, dark, settings.mesh);
  average_textures(prepared->scene, prepared->surfaces, prepared->textures, prepared->mesh);
  prepared->light.emplace(make_light_scene(prepared->scene, prepared->surfaces, *prepared->rays,
                                           prepared->plan.mirrors, prepared->plan.worlds,
                                           prepared->mesh, prepared->textures));
  prepared->seconds.mesh = watch.lap();
  return prepared;
}

TwoPassResult two_pass(const PreparedScene& prepared, const Camera& camera,
                       const TwoPassSettings& settings, const Progress& progress,
                       const PassOneWatch& watch) {
  // Pass one:
  // diffuse radiosity, with the light that arrives directly and through every mirror world.
  auto solution = solve_pass_one(*prepared.light, settings.pass_one, progress, watch);

  // Pass two: specular light, followed from the eye until it lands on the diffuse field.
  const LightScene& lit = field_scene(*prepared.light, solution);
  auto rendering = render(lit, solution.field, camera, settings.render, progress);
  return {std::move(solution), std::move(rendering)};
}

} // namespace meninas
