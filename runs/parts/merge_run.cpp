#include "runs/parts/merge_run.h"

#include "raytrace/pixels/bright_edges.h"
#include "runs/parts/tile_file.h"
#include "scenes/errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>

namespace meninas {
namespace {

namespace fs = std::filesystem;

std::string name_of(const PicturePart& part) {
  return fmt::format("{}/{}", part.number + 1, part.count);
}

/// What all parts have to have in common, as a user knows it.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> common_attributes{{
    {"tileVersion", "version"},
    {"sceneHash", "scene"},
    {"tileCamera", "camera"},
    {"mode", "mode"},
    {"tileSettings", "settings"},
    {"tileTransform", "view transform"},
    {"tileExposure", "exposure"},
}};

std::string attribute_or_none(const Attributes& attributes, std::string_view key) {
  const auto found = std::ranges::find(attributes, key, &Attributes::value_type::first);
  return found == attributes.end() ? "none" : found->second;
}

/// "1/9, 2/9 and 5 more"
std::string first_of(std::vector<std::string> names) {
  constexpr std::size_t most = 8;
  const std::size_t count = names.size();
  names.resize(std::min(count, most));
  return fmt::format("{}{}", fmt::join(names, ", "),
                     count > most ? fmt::format(" and {} more", count - most) : "");
}

std::vector<std::string> names_of(const std::vector<Layer>& layers) {
  std::vector<std::string> names;
  for (const Layer& layer : layers)
    names.push_back(layer.name);
  return names;
}

/// The picture so far, and which file each part came from.
class MergedPicture {
public:
  void add(const fs::path& file, TileFile tile) {
    if (!first_)
      begin(file, tile);
    check_common(file, tile);
    fs::path& place = file_of_[static_cast<std::size_t>(tile.part.number)];
    if (!place.empty())
      throw InputError(file.string(), "", fmt::format("is part {} once more, which {} is already",
                                                      name_of(tile.part), place.string()));
    place = file;
    paste(tile.pixels, tile.window, picture_);
    for (std::size_t k = 0; k < layers_.size(); ++k)
      paste(tile.layers[k].image, tile.window, layers_[k].image);
    add_edges(tile);
  }

  void check_whole() const {
    std::vector<std::string> missing;
    for (std::size_t k = 0; k < file_of_.size(); ++k)
      if (file_of_[k].empty())
        missing.push_back(name_of({static_cast<int>(k), static_cast<int>(file_of_.size())}));
    if (!missing.empty())
      throw InputError(first_->string(), "",
                       fmt::format("its picture is not whole: without part{} {}",
                                   missing.size() > 1 ? "s" : "", first_of(missing)));
  }

  void write(const MergeRequest& request, const RunEvents& events) const {
    PictureSettings settings{.exr_type = layers_.empty() ? request.exr_type : PixelType::float32,
                             .exposure = header_.exposure,
                             .transform = header_.transform,
                             .png_bits = request.png_bits};
    const ShownPixels edges =
        display_of(request.pictures, settings) ? edges_of_picture() : ShownPixels{};
    write_pictures(request.pictures, {picture_, layers_, &edges}, settings,
                   without_tile(header_.attributes), events);
  }

private:
  void begin(const fs::path& file, const TileFile& tile) {
    first_ = file;
    header_ = tile;
    header_.pixels = {};
    header_.layers.clear();
    file_of_.resize(static_cast<std::size_t>(tile.part.count));
    picture_ = Image(tile.window.picture_width, tile.window.picture_height);
    for (const Layer& layer : tile.layers)
      layers_.push_back({layer.name, picture_});
    for (const ShownPixels& edges : tile.edges)
      edges_.push_back({edges.exposure, edges.transform, {}});
  }

  void check_common(const fs::path& file, const TileFile& tile) const {
    const auto refuse = [&](const std::string& what) {
      throw InputError(file.string(), "",
                       fmt::format("part {} does not go with {}: {}", name_of(tile.part),
                                   first_->string(), what));
    };
    for (const auto& [key, word] : common_attributes)
      if (const std::string a = attribute_or_none(tile.attributes, key), b = attribute_or_none(header_.attributes, key);
          a != b)
        refuse(fmt::format("another {} ({} and {})", word, a, b));
    if (tile.window.picture_width != picture_.width ||
        tile.window.picture_height != picture_.height)
      refuse(fmt::format("a picture of another size ({}x{} and {}x{})", tile.window.picture_width,
                         tile.window.picture_height, picture_.width, picture_.height));
    if (tile.part.count != header_.part.count)
      refuse(fmt::format("a picture of {} parts and not of {}", tile.part.count,
                         header_.part.count));
    if (names_of(tile.layers) != names_of(layers_))
      refuse("other layers");
  }

  static void paste(const Image& part, const DataWindow& window, Image& whole) {
    for (int y = 0; y < window.height; ++y)
      for (int x = 0; x < window.width; ++x)
        whole.at(window.x + x, window.y + y) = part.at(x, y);
  }

  /// Of exposures that all parts know.
  void add_edges(const TileFile& tile) {
    std::erase_if(edges_, [&](const ShownPixels& known) {
      return std::ranges::find(tile.edges, known.exposure, &ShownPixels::exposure) ==
             tile.edges.end();
    });
    for (ShownPixels& known : edges_)
      for (const ShownPixel& pixel :
           std::ranges::find(tile.edges, known.exposure, &ShownPixels::exposure)->pixels) {
        const auto row = pixel.pixel / static_cast<std::size_t>(tile.window.width),
                   column = pixel.pixel % static_cast<std::size_t>(tile.window.width);
        known.pixels.push_back(
            {(static_cast<std::size_t>(tile.window.y) + row) *
                     static_cast<std::size_t>(picture_.width) +
                 static_cast<std::size_t>(tile.window.x) + column,
             pixel.shown});
      }
  }

  /// What the display shows at the edges of bright things: known of exactly these pixels at this exposure, or nothing is written.
  ShownPixels edges_of_picture() const {
    ShownPixels none{0.0, header_.transform, {}};
    if (!header_.knows_edges)
      return none;
    none.exposure = header_.exposure.value_or(automatic_exposure(picture_));
    const PixelMask mask = bright_edges(picture_, none.exposure);
    const auto wanted = std::ranges::count(mask, 1);
    if (wanted == 0)
      return none;
    const auto known = std::ranges::find(edges_, none.exposure, &ShownPixels::exposure);
    const bool right = known != edges_.end() && std::ssize(known->pixels) == wanted &&
                       std::ranges::all_of(known->pixels, [&](const ShownPixel& pixel) {
                         return mask[pixel.pixel] != 0;
                       });
    if (!right)
      throw InputError(first_->string(), "",
                       fmt::format("no PNG: its parts do not know the edges of bright things at the "
                                   "picture's exposure: an EXR alone can be made of them, or render "
                                   "them with --exposure {}",
                                   none.exposure));
    return *known;
  }

  std::optional<fs::path> first_;
  TileFile header_; ///< of the first
  std::vector<fs::path> file_of_; ///< by part
  Image picture_;
  std::vector<Layer> layers_;
  std::vector<ShownPixels> edges_;
};

} // namespace

void merge_run(const MergeRequest& request, const RunEvents& events) {
  check_outputs({.pictures = request.pictures, .solution = {}, .texts = {}}, request.tiles);
  MergedPicture merged;
  for (const fs::path& file : request.tiles)
    merged.add(file, read_tile(file));
  merged.check_whole();
  merged.write(request, events);
  note(events, fmt::format("{} parts put together", request.tiles.size()));
}

} // namespace meninas
