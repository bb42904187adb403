// Pictures in and out of files. (The only user of OpenImageIO, in one shared module that is opened with the first
// picture, because linking OpenImageIO costs more at every start than a draft picture takes.)
//
// A file appears whole or not at all: it is written under a temporary name in the same folder and renamed.
// Throws OutputError when it cannot be written, InputError when it cannot be read, each naming the file.
#pragma once

#include "image/image.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace meninas {

enum class PixelType { half, float32 };

/// Key and value written into the file's header (program version, settings, samples, ...).
using Attributes = std::vector<std::pair<std::string, std::string>>;

/// Linear EXR: R, G, B of the picture, then NAME.R, NAME.G, NAME.B of each layer.
void write_exr(const std::filesystem::path& file, const Image& picture, std::span<const Layer> layers = {},
               PixelType type = PixelType::half, const Attributes& attributes = {});

/// sRGB-encoded 8-bit PNG of the picture times 2^exposure, clipped at white.
void write_png(const std::filesystem::path& file, const Image& picture, double exposure);

struct ImageFile {
  Image picture;
  std::vector<Layer> layers;
  Attributes attributes;
};
/// EXR as it is; PNG, JPEG and others decoded from sRGB to linear.
ImageFile read_image(const std::filesystem::path& file);

/// Decodes an encoded image held in memory; `linear` leaves the values as they are, otherwise sRGB becomes linear.
/// Fourth component is alpha, 1 where there is none. `name` is for the message of the InputError.
struct Bitmap {
  int width = 0, height = 0;
  std::vector<glm::vec4> pixels;
};
enum class Encoding { srgb, linear };
Bitmap decode_image(std::span<const std::byte> encoded, Encoding encoding, const std::string& name);

/// Throws OutputError when a picture could not be written there (unknown extension, no such folder, no permission),
/// so that a long run fails before its work, not after.
void check_writable_image(const std::filesystem::path& file);

} // namespace meninas
