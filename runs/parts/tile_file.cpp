#include "runs/parts/tile_file.h"

#include "image/metrics/metrics.h"
#include "raytrace/pixels/picture_window.h"
#include "runs/preparation.h"
#include "runs/steering/setting_options.h"
#include "scenes/content_hash.h"
#include "scenes/errors.h"
#include "scenes/version.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace meninas {
namespace {

namespace fs = std::filesystem;

constexpr float no_edge = -1.0F;
constexpr std::string_view edges_prefix = "edges.";

Image cropped(const Image& image, const PictureWindow& window) {
  Image part(window.width, window.height);
  for (int y = 0; y < window.height; ++y)
    for (int x = 0; x < window.width; ++x)
      part.at(x, y) = image.at(window.x + x, window.y + y);
  return part;
}

Image layer_of(const ShownPixels& edges, const Image& picture, const PictureWindow& window) {
  Image layer(window.width, window.height);
  std::ranges::fill(layer.pixels, glm::vec3(no_edge));
  const auto width = static_cast<std::size_t>(picture.width);
  for (const ShownPixel& pixel : edges.pixels)
    layer.at(static_cast<int>(pixel.pixel % width) - window.x,
             static_cast<int>(pixel.pixel / width) - window.y) = pixel.shown;
  return layer;
}

ShownPixels edges_of(const Image& layer, double exposure, ViewTransform transform) {
  ShownPixels edges{exposure, transform, {}};
  for (std::size_t p = 0; p < layer.pixels.size(); ++p)
    if (layer.pixels[p].r != no_edge)
      edges.pixels.push_back({p, layer.pixels[p]});
  return edges;
}

std::string settings_text(const TileOrigin& origin) {
  // What these files hold is in the scene's hash.
  RunSettings settings = origin.settings;
  settings.environment.file.reset();
  settings.gltf.state.luminaires.clear();
  std::vector<std::string> options = options_of(settings);
  for (const LampFactor& lamp : origin.settings.lamp_factors)
    options.push_back(fmt::format("--lamp {}={},{},{}", lamp.lamp, lamp.factor.r, lamp.factor.g,
                                  lamp.factor.b));
  if (origin.solution)
    options.push_back(fmt::format("--solution with hash {}",
                                  hex_digits(hash_of_file(*origin.solution))));
  return options.empty() ? "defaults" : fmt::format("{}", fmt::join(options, " "));
}

Attributes attributes_of(const ViewPicture& picture, const TileOrigin& origin) {
  ContentHash camera;
  add_camera(camera, origin.camera);
  const PicturePart& part = *origin.settings.part;
  Attributes attributes = picture.attributes;
  attributes.emplace_back("tile", fmt::format("{}/{}", part.number + 1, part.count));
  attributes.emplace_back("tileVersion", program_version());
  attributes.emplace_back("tileCamera", hex_digits(camera.value()));
  attributes.emplace_back("tileSettings", settings_text(origin));
  attributes.emplace_back("tileTransform", std::string(name_of(origin.shown.transform)));
  if (origin.shown.exposure)
    attributes.emplace_back("tileExposure", fmt::format("{}", *origin.shown.exposure));
  std::vector<double> exposures;
  for (const ShownPixels& edges : picture.likely_edges)
    exposures.push_back(edges.exposure);
  if (!exposures.empty())
    attributes.emplace_back("tileEdges", fmt::format("{}", fmt::join(exposures, ",")));
  return attributes;
}

std::string value_of(const Attributes& attributes, std::string_view key) {
  const auto found = std::ranges::find(attributes, key, &Attributes::value_type::first);
  return found == attributes.end() ? "" : found->second;
}

/// Whole and finite, or nothing.
template <typename Number>
std::optional<Number> finite_in(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stop == end && std::isfinite(double(number))
             ? std::optional(number)
             : std::nullopt;
}

[[noreturn]] void refuse(const fs::path& file, const char* what) {
  throw InputError(file.string(), "", what);
}

PicturePart part_in(const fs::path& file, const std::string& text) {
  const auto slash = std::min(text.find('/'), text.size());
  const auto number = finite_in<int>(std::string_view(text).substr(0, slash));
  const auto count = finite_in<int>(std::string_view(text).substr(std::min(slash + 1, text.size())));
  if (!number || !count || *number < 1 || *number > *count)
    refuse(file, "is no part of a picture made by 'meninas render --tile'");
  return {*number - 1, *count};
}

bool is_exposure(const std::optional<double>& stops) {
  constexpr double most = 1000.0; // floats have 277 stops
  return stops && std::abs(*stops) <= most;
}

/// Refuses values that no part has: what is not finite, and edges that are not shown.
void check_values(const fs::path& file, const WindowFile& stored) {
  if (const auto bad = first_bad_pixel(stored.pixels))
    refuse(file, ("damaged: " + *bad).c_str());
  for (const Layer& layer : stored.layers) {
    if (const auto bad = first_bad_pixel(layer.image))
      refuse(file, fmt::format("damaged: layer '{}': {}", layer.name, *bad).c_str());
    const bool edges = layer.name.starts_with(edges_prefix);
    const auto is_shown = [](const glm::vec3& pixel) {
      return pixel == glm::vec3(no_edge) || (glm::all(glm::greaterThanEqual(pixel, glm::vec3(0.0F))) &&
                                             glm::all(glm::lessThanEqual(pixel, glm::vec3(1.0F))));
    };
    if (edges && !std::ranges::all_of(layer.image.pixels, is_shown))
      refuse(file, fmt::format("damaged: layer '{}' holds what no display shows", layer.name).c_str());
  }
}

/// Moves the layers of edges to where they belong.
void take_edges(const fs::path& file, TileFile& tile) {
  const std::string list = value_of(tile.attributes, "tileEdges");
  tile.knows_edges = !list.empty();
  for (std::size_t begin = 0; tile.knows_edges && begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const auto exposure = finite_in<double>(std::string_view(list).substr(begin, end - begin));
    if (!is_exposure(exposure))
      refuse(file, "damaged: its exposures are no numbers of stops");
    const std::string name = fmt::format("{}{}", edges_prefix, tile.edges.size());
    const auto layer = std::ranges::find(tile.layers, name, &Layer::name);
    tile.edges.push_back(layer == tile.layers.end()
                             ? ShownPixels{*exposure, tile.transform, {}}
                             : edges_of(layer->image, *exposure, tile.transform));
    begin = end + 1;
  }
  std::erase_if(tile.layers, [](const Layer& layer) { return layer.name.starts_with(edges_prefix); });
}

} // namespace

void write_tile(const fs::path& file, const ViewPicture& picture, const TileOrigin& origin) {
  const Image& image = picture.image;
  const PicturePart& part = *origin.settings.part;
  const PictureWindow window = window_of_part(image.width, image.height, part.number, part.count);
  std::vector<Layer> layers;
  for (const Layer& layer : picture.layers)
    layers.push_back({layer.name, cropped(layer.image, window)});
  for (std::size_t k = 0; k < picture.likely_edges.size(); ++k)
    if (!picture.likely_edges[k].pixels.empty())
      layers.push_back({fmt::format("{}{}", edges_prefix, k),
                        layer_of(picture.likely_edges[k], image, window)});
  write_exr_window(file, cropped(image, window), layers,
                   {window.x, window.y, window.width, window.height, image.width, image.height},
                   attributes_of(picture, origin));
}

TileFile read_tile(const fs::path& file) {
  WindowFile stored = read_exr_window(file);
  constexpr int longest_side = 1 << 16;
  constexpr std::int64_t max_pixels = std::int64_t{1} << 27; // of a picture, as `--size` has it
  TileFile tile;
  tile.part = part_in(file, value_of(stored.attributes, "tile"));
  tile.window = stored.window;
  const auto& [x, y, width, height, picture_width, picture_height] = tile.window;
  const bool possible = picture_width > 0 && picture_height > 0 && picture_width <= longest_side &&
                        picture_height <= longest_side &&
                        std::int64_t{picture_width} * picture_height <= max_pixels &&
                        tile.part.count <= max_parts(picture_width, picture_height);
  if (!possible || window_of_part(picture_width, picture_height, tile.part.number,
                                  tile.part.count) != PictureWindow{x, y, width, height})
    refuse(file, "damaged: it has other pixels than its part of the picture");
  check_values(file, stored);
  tile.pixels = std::move(stored.pixels);
  tile.layers = std::move(stored.layers);
  tile.attributes = std::move(stored.attributes);
  const std::string exposure = value_of(tile.attributes, "tileExposure");
  tile.exposure = finite_in<double>(exposure);
  if (!exposure.empty() && !is_exposure(tile.exposure))
    refuse(file, "damaged: its exposure is no number of stops");
  const std::string transform = value_of(tile.attributes, "tileTransform");
  const auto known = std::ranges::find_if(
      view_transforms, [&](ViewTransform each) { return name_of(each) == transform; });
  if (known == view_transforms.end())
    refuse(file, "damaged: it says no view transform");
  tile.transform = *known;
  take_edges(file, tile);
  return tile;
}

Attributes without_tile(Attributes attributes) {
  std::erase_if(attributes, [](const auto& attribute) { return attribute.first.starts_with("tile"); });
  return attributes;
}

} // namespace meninas
