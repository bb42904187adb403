// What the help pages say beyond the options themselves.
#include "cli/help/help.h"

#include "cli/help/option_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace meninas {
namespace {

const std::map<std::string_view, std::vector<Example>>& all_examples() {
  static const std::map<std::string_view, std::vector<Example>> examples{
      {"",
       {{"meninas room.gltf", "renders room.png"},
        {"meninas compare room.gltf -o compared", "shows what the mirrors do, on one page"},
        {"meninas help render", "tells more about a command"}}},
      {"render",
       {{"meninas render room.gltf", "renders room.png as the file's first camera sees it"},
        {"meninas render room.gltf --error 0.02 -o room.exr -o room.png",
         "chooses settings until the picture is about 2 % off"},
        {"meninas render room.gltf --solution room.glb --camera door -o door.png",
         "renders another view of a solution that `meninas solve` has written"}}},
      {"solve",
       {{"meninas solve room.gltf -o room.glb", "solves once; `meninas render --solution room.glb` renders any view"},
        {"meninas solve room.gltf -o room.glb --per-node nodes.json",
         "also writes area, radiosity and irradiance of each glTF node"},
        {"meninas solve room.gltf -o room.glb --grid desk",
         "also reports minimum, mean and uniformity of the illuminance on a node"}}},
      {"plan",
       {{"meninas plan room.gltf", "says what is in the file, what is odd about it, and how long a picture takes"}}},
      {"compare",
       {{"meninas compare room.gltf -o compared", "then open compared/index.html"},
        {"meninas compare room.gltf -o compared --reference --max-seconds 60",
         "adds a path-traced picture and the differences from it"}}},
      {"batch",
       {{"meninas batch jobs.json -o pictures --resume", "makes the pictures that are not there yet"},
        {"meninas batch jobs.json -o pictures --dry-run", "lists what would be made"}}},
      {"merge",
       {{"meninas merge 1.exr 2.exr 3.exr 4.exr -o room.png -o room.exr",
         "puts the parts together that `render --tile 1/4 -o 1.exr` and so on wrote"}}},
      {"diff",
       {{"meninas diff new.exr old.exr -o heat.png", "prints the figures and paints where pictures differ"},
        {"meninas diff new.png old.png --max-flip 0.02", "ends with exit code 1 where they differ by more"}}},
      {"regress",
       {{"meninas regress cases.json", "ends with exit code 1 where a picture has changed"},
        {"meninas regress cases.json --update", "makes the references anew"}}},
      {"trade",
       {{"meninas trade room.gltf -o traded --budget 120", "then open traded/index.html"}}},
      {"walk",
       {{"meninas walk room.gltf -o room.html", "then open room.html"},
        {"meninas walk room.gltf --by-lamp -o room.html", "with a dimmer for each lamp"},
        {"meninas walk room.gltf --solution room.glb -o room.html",
         "shows a solution that `meninas solve` has written"}}},
      {"bake",
       {{"meninas bake room.gltf -o baked.glb", "then load baked.glb with the lightmap extension of three.js"},
        {"meninas bake room.gltf --direct off -o indirect.glb", "for an engine that lights the lamps itself"}}},
      {"view",
       {{"meninas view room.gltf", "prints the address, and opens it where there is a display"},
        {"meninas view room.gltf --paused --no-open", "begins in the dark; N in the browser makes the next shot"}}},
      {"formfactors",
       {{"meninas formfactors room.gltf --from floor --to ceiling", "in total and for each chain of mirrors"},
        {"meninas formfactors room.gltf --all", "prints the matrix of all nodes as CSV"}}}};
  return examples;
}

/// An option as `-h` shows it. Empty: as --help-all does.
struct FirstOption {
  std::string_view name;
  std::string_view text = {}; ///< its default, if it ends with none, is that of --help-all
  std::string_view value = {};
};

/// The options that `-h` shows, ten at most: a line of 80 columns each, names and value at most 22 signs, text and default 54.
using FirstOptions = std::vector<FirstOption>;

constexpr FirstOption first_quality{"quality", "accuracy: draft, normal or fine", "LEVEL"};
constexpr FirstOption first_elements{"elements", "mesh elements"};
constexpr FirstOption first_size{"size", "size in pixels [512x512, or the camera's shape]"};
constexpr FirstOption first_solution{"solution", "use a solution of `meninas solve`, do not solve"};
constexpr FirstOption first_page_exposure{"exposure", "brighten the page by EV stops"};

/// Of commands that make pictures and pages of one scene.
const std::map<std::string_view, FirstOptions>& first_options_of_scenes() {
  static const std::map<std::string_view, FirstOptions> options{
      {"render",
       {{"output", "picture: .exr, .hdr or .png; repeatable"},
        first_quality,
        {"error", "choose settings for this relative error, such as 0.02"},
        {"time", "choose settings for the best picture within this time"},
        first_size,
        {"camera"},
        {"exposure"},
        {"mode", "radiosity, hybrid or reference", "MODE"},
        {"background"},
        first_solution}},
      {"solve",
       {{"output"},
        first_quality,
        first_elements,
        {"background"},
        {"per-node", "write light of each glTF node (W/m^2, lx) as JSON"},
        {"points", "report the light at points: a .csv of x,y,z,nx,ny,nz"},
        {"grid", "report the light on a grid on each face; repeatable"},
        {"units", "of the file: radiometric or photometric", "UNITS"},
        {"stats"}}},
      {"walk",
       {{"output", "page, .html, for any browser with WebGL 2"},
        first_quality,
        first_solution,
        {"by-lamp", "a dimmer for each lamp, by node or material", "[GROUPING]"},
        first_page_exposure,
        first_elements,
        {"background"}}},
      {"bake",
       {{"output", "baked scene, .glb, with .lightmap.exr and .png"},
        {"lightmap-size"},
        {"direct", "include light straight from lamps"},
        first_solution,
        first_quality,
        first_elements,
        {"background"}}},
      {"view",
       {{"port"},
        {"no-open"},
        {"paused", "begin in the dark; N makes the next shot, P goes on"},
        first_quality,
        first_page_exposure,
        first_elements,
        {"solver", "such as progressive, which shows each shot", "SOLVER"},
        {"background"}}},
      {"plan", {{"json"}, first_quality, {"size"}, {"camera"}, {"background"}}}};
  return options;
}

/// Of commands that make many pictures, compare them or print numbers.
const std::map<std::string_view, FirstOptions>& first_options_of_series() {
  static const std::map<std::string_view, FirstOptions> options{
      {"compare", {{"output"}, first_quality, {"reference"}, {"max-seconds"}, first_size, {"camera"}, {"exposure"}}},
      {"batch",
       {{"output"},
        {"resume", "keep pictures made earlier from the same input"},
        {"dry-run"},
        {"only", "only these pictures of --dry-run, such as 1,4-6"},
        {"shard"},
        {"memory-limit", "limit of memory, such as 4G"},
        {"cache", "folder for solutions [.meninas/solutions in -o DIR]"},
        {"junit"},
        {"schema"}}},
      {"merge", {{"output", "picture: .exr, .hdr or .png; repeatable"}, {"depth"}, {"float"}, {"quiet"}}},
      {"diff",
       {{"output"},
        {"heat", "error in the heat map, such as rmse or ssim", "METRIC"},
        {"layer"},
        {"json"},
        {"max-rmse"},
        {"max-relmse"},
        {"min-ssim"},
        {"max-flip", "mean visible difference when flipping, 0 to 1"}}},
      {"regress",
       {{"output", "folder for what failures leave"},
        {"filter"},
        {"junit"},
        {"update", "make the references and manifest.json anew"},
        {"threads"},
        {"quiet"}}},
      {"trade",
       {{"output"},
        {"reference", "measure against this picture [path tracing]"},
        {"budget"},
        {"camera"},
        {"size"},
        {"background"}}},
      {"formfactors",
       {{"from"},
        {"to"},
        {"all"},
        {"json"},
        {"method", "analytic, rays or hemicube", "METHOD"},
        {"sides", "double-sided: facing, front, back or both", "SIDES"},
        {"accuracy"},
        {"rays"},
        {"mirror-depth", "follow at most N mirrors"}}}};
  return options;
}

/// Of options about lamps, units and numbers at points.
const std::map<std::string_view, std::string_view>& light_details() {
  static const std::map<std::string_view, std::string_view> details{
      {"--grid",
       "points are p = 0.2 * 5^log10(d) metres apart, d the longer side, or the shorter one where it is "
       "half as long or less. Minimum, mean, maximum and uniformity (minimum / mean) are printed. Of a "
       "double-sided face the sides that have light are reported ([illuminance](lux.md))."},
      {"--ies",
       "LIGHT is the node's name. The file's candela, in the light's colour, take the place of its "
       "intensity; the luminaire aims along the node's -Z ([luminaires](lux.md#luminaires))."},
      {"--light-scale",
       "0.001464 (1/683) brings lights that were exported in candela and lux to W/sr and W/m². What "
       "glows stays as it is."},
      {"--luminous-efficacy",
       "what is photometric is K times what is radiometric: illuminance in lux is K times irradiance, by "
       "the weights 0.2126, 0.7152 and 0.0722 of red, green and blue. IES files are divided by it."},
      {"--points",
       "x, y, z in metres; without normals planes face up. Each point gets its illuminance and "
       "irradiance: all of it, the direct part and the part that came by way of mirrors "
       "([illuminance](lux.md))."},
      {"--units",
       "without it the file's own word counts, `asset.extras.light_units` ([units](lux.md#from-watts-to-lumens)). "
       "`photometric`: emission and the lights of KHR_lights_punctual are divided by "
       "--luminous-efficacy. Pictures stay in W/m²/sr; lux and cd/m² are printed by `solve --points`, "
       "`--grid` and `--per-node` and by `render --view`, whatever the file is in."}};
  return details;
}

const std::map<std::string_view, std::string_view>& other_details() {
  static const std::map<std::string_view, std::string_view> details{
      {"--at",
       "translations, rotations, scales and morph weights of all animations, by the keys around that "
       "time; before the first and after the last key it is theirs. Cameras and lights move too."},
      {"--bends",
       "0.1 is a good value for `--mesh uniform`. Elements are divided up to three times. It helps "
       "`--diffuse direct` most; `--error` and `--time` use it by themselves."},
      {"--diffuse",
       "`interpolated` shows pass one as it is at the vertices. `direct` computes direct light, also "
       "that reflected by mirrors, as fine as the view's pixels, shadow edges included. "
       "`gather` gathers all light at the hit, which takes longest."},
      {"--elements", "a huge ground plane gets at most 75 % of the elements."},
      {"--element-size",
       "elements that thin walls or sheets cross are divided further, so that no light leaks through."},
      {"--error",
       "the run makes a quick picture, estimates its error and chooses the next settings, until the "
       "estimate is below X. It says which options make the same picture again."},
      {"--exposure",
       "an EXR is never scaled. It keeps scene, camera, seed, samples, background and units as attributes "
       "`meninas:...`."},
      {"--factors",
       "with `--reuse` a later run may change emission, diffuse reflectances, solver, tolerance and "
       "interpolation. Geometry, mirrors, elements and rays must be the same; a run says what differs "
       "and ends otherwise."},
      {"--form-factors",
       "`rays` start all over an element. `hemicube` is the classic method, at the element's centre "
       "([how it errs](hemicube.md)). `analytic` is exact, for a few hundred elements."},
      {"--layers",
       "`light` splits the picture into nine layers that add up to it to the last bit: `emission`, "
       "`diffuse.direct` (light that came straight to the surface) and `diffuse.mirrored` (light that "
       "came by way of mirrors), each seen straight, in one mirror (`.mirror`) and in several "
       "(`.mirrors`). `depth` (metres along the view axis; from the eye in panoramas), `normal` (world space, towards the eye), "
       "`albedo` (diffuse), `element` (counted from 1) and `irradiance` (of pass one, W/m²) are those "
       "of the first surface at the middle of each pixel, a mirror among them; 0 where there is none. "
       "`alpha` is the share of the pixel in which there is one, channel `A` beside `R`, `G`, `B`."},
      {"--mesh",
       "`hierarchical` gathers light on parts of surfaces as large as accuracy allows (after Hanrahan, "
       "Salzman and Aupperle 1991) and is the fastest for a given accuracy in most scenes. `uniform` has "
       "a row of form factors for every element, which `--factors`, `--form-factors hemicube|analytic`, "
       "`--solver progressive` and `--interpolation average` choose by themselves."},
      {"--link-error",
       "the solve begins with few large nodes and divides those whose light is not linear to X. With "
       "far more `--elements` than X needs, more `--rays` help instead."},
      {"--snapshots", "see [progressive pictures](progressive.md)."},
      {"--solver",
       "all of them end at the error that `--tolerance` allows. `progressive` shoots light, brightest "
       "first, from a uniform mesh unless `--mesh` says otherwise. `hierarchical` is an older name of "
       "`--mesh hierarchical`."},
      {"--stats", "[all figures](stats.md)."},
      {"--variant", "`meninas plan` lists the names that `KHR_materials_variants` gives."},
      {"--view",
       "the colours' range is printed; an EXR holds the numbers as well. `illuminance` is that of pass one, "
       "in lux, `luminance` that of the picture, in cd/m²: with a scale, and a line for each tenth of it."},
      {"--view-transform",
       "`neutral` is Khronos' PBR Neutral: colours stay as they are up to 0.8 and pale softly above. "
       "`agx` is the AgX of Blender and three.js. `srgb` clips. Parts of pixels at lamps' edges are shown so by the two passes. EXRs stay linear."}};
  return details;
}

} // namespace

std::span<const Example> examples_of(std::string_view command) {
  const auto found = all_examples().find(command);
  return found == all_examples().end() ? std::span<const Example>{} : found->second;
}

std::optional<OptionInfo> in_brief(std::string_view command, OptionInfo option) {
  for (const auto* commands : {&first_options_of_scenes(), &first_options_of_series()}) {
    const auto found = commands->find(command);
    if (found == commands->end() || is_placed(option) || option.long_names.empty() || option.long_names.front() == "help")
      continue;
    const auto first = std::ranges::find(found->second, option.long_names.front(), &FirstOption::name);
    if (first == found->second.end())
      return std::nullopt;
    const std::string standard = default_apart(option.description).second;
    if (!first->text.empty())
      option.description = standard.empty() || first->text.ends_with(']')
                               ? std::string(first->text)
                               : fmt::format("{} [{}]", first->text, standard);
    if (!first->value.empty())
      option.value = first->value;
  }
  return option;
}

std::string_view details_of(std::string_view option) {
  for (const auto* details : {&light_details(), &other_details()}) {
    if (const auto found = details->find(option); found != details->end())
      return found->second;
  }
  return {};
}

} // namespace meninas
