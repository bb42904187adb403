#include "runs/outputs.h"

#include "image/codecs/exr_encoding.h"
#include "image/display.h"
#include "image/whole_file.h"
#include "scenes/errors.h"

#include <fmt/format.h>

#include <algorithm>

namespace meninas {
namespace {

namespace fs = std::filesystem;

/// Compared by name too, because an output need not exist yet.
bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) {
    return true;
  }
  return fs::weakly_canonical(a, error) == fs::weakly_canonical(b, error) && !error;
}

void check_distinct(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs) {
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    const auto is_this = [&](const fs::path& other) { return is_same_file(outputs[k], other); };
    if (std::ranges::any_of(inputs, is_this)) {
      throw UsageError(outputs[k].string(), "is an input, which would be overwritten");
    }
    if (std::any_of(outputs.begin(), outputs.begin() + static_cast<std::ptrdiff_t>(k), is_this)) {
      throw UsageError(outputs[k].string(), "is named as an output twice");
    }
  }
}

/// Half floats, where they hold the picture:
/// its brightest value, and those a hundred times darker without loss.
PixelType type_for(const Image& picture, std::span<const Layer> layers, PixelType wanted) {
  constexpr float largest_half = 65504.0F, min_normal_half = 0x1p-14F;
  const auto brightest_of = [](const Image& image) {
    float brightest = 0.0F;
    for (const glm::vec3& pixel : image.pixels)
      brightest = std::max(brightest, largest(pixel));
    return brightest;
  };
  const float picture_brightest = brightest_of(picture);
  float brightest = picture_brightest;
  for (const Layer& layer : layers)
    brightest = std::max(brightest, brightest_of(layer.image));
  const bool fits = brightest <= largest_half &&
                    (picture_brightest == 0.0F || picture_brightest >= 100.0F * min_normal_half);
  return fits ? wanted : PixelType::float32;
}

} // namespace

void check_outputs(const OutputFiles& outputs, const std::vector<fs::path>& inputs) {
  std::vector<fs::path> all = outputs.pictures;
  all.insert(all.end(), outputs.texts.begin(), outputs.texts.end());
  if (outputs.solution) {
    all.push_back(*outputs.solution);
  }
  check_distinct(all, inputs);
  for (const fs::path& picture : outputs.pictures) {
    check_writable_image(picture);
  }
  if (outputs.solution && outputs.solution->extension() != ".glb") {
    throw OutputError(outputs.solution->string(), "", "cannot write: a solution is a .glb file");
  }
  for (const fs::path& file : all) {
    check_writable_file(file);
  }
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!folder.empty() && !fs::is_directory(folder)) {
    throw OutputError(
        folder.string(), "",
        fmt::format("cannot be made a folder{}", error ? ": " + error.message() : std::string()));
  }
}

static bool has_png(const std::vector<fs::path>& files) {
  return std::ranges::any_of(
      files, [](const fs::path& file) { return picture_format(file) == PictureFormat::png; });
}

std::optional<DisplayChoice> display_of(const std::vector<fs::path>& files,
                                        const PictureSettings& settings) {
  if (!has_png(files))
    return std::nullopt;
  return DisplayChoice{settings.exposure, settings.transform};
}

void write_pictures(const std::vector<fs::path>& files, const WrittenPicture& picture,
                    const PictureSettings& settings, const Attributes& attributes,
                    const RunEvents& events) {
  std::optional<double> exposure = settings.exposure;
  const PixelType type = type_for(picture.image, picture.layers, settings.exr_type);
  if (type != settings.exr_type && std::ranges::any_of(files, [](const fs::path& file) {
        return picture_format(file) == PictureFormat::exr;
      }))
    note(events, "values that 16 bits do not hold: the EXR has 32 bits a channel");
  for (const fs::path& file : files) {
    if (picture_format(file) == PictureFormat::exr) {
      write_exr(file, picture.image, picture.layers, type,
                with_units(attributes, picture.unit, picture.layers));
      continue;
    }
    if (picture_format(file) == PictureFormat::hdr) {
      write_hdr(file, picture.image);
      continue;
    }
    if (!exposure) {
      exposure = automatic_exposure(picture.image);
      note(events, fmt::format("exposure {:+.2f} EV (automatic)", *exposure));
    }
    write_png(file, picture.image,
              {.exposure = *exposure,
               .transform = settings.transform,
               .edges = picture.edges,
               .bits = settings.png_bits});
  }
  if (settings.exposure && has_png(files)) {
    note(events, fmt::format("exposure {:+.2f} EV", *settings.exposure));
  }
}

std::vector<std::byte> picture_bytes(PictureFormat format, const WrittenPicture& picture,
                                     const PictureSettings& settings, const Attributes& attributes) {
  expects(format != PictureFormat::hdr, "pictures in memory are EXRs or PNGs");
  if (format == PictureFormat::exr)
    return encode_exr(picture.image, picture.layers,
                      type_for(picture.image, picture.layers, settings.exr_type),
                      with_units(attributes, picture.unit, picture.layers));
  expects(settings.exposure.has_value(), "a PNG has an exposure");
  return encode_png(picture.image, {.exposure = *settings.exposure,
                                    .transform = settings.transform,
                                    .edges = picture.edges,
                                    .bits = settings.png_bits});
}

} // namespace meninas
