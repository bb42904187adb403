// Pictures in and out of files. They are written by the libraries of their formats,
// OpenEXR and libpng, and read, from many formats, by OpenImageIO, which also writes Radiance pictures,
// in one shared module that is opened with the first picture that is read,
// because linking OpenImageIO costs more at every start than a draft picture takes.
//
// A file appears whole or not at all: it is encoded in memory,
// written under a temporary name in the same folder and renamed. Throws OutputError when
// it cannot be written, InputError when it cannot be read, each naming the file.
#pragma once

#include "image/display.h"
#include "image/image.h"
#include "image/picture_options.h"
#include "image/view_transform.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meninas {

/// Opens the module that reads on a thread of its own, so that it is there when it is needed.
/// Worth calling once it is clear that a picture will be read; never needed.
void preload_picture_reader();

/// The format of an output name, by its extension (in any case). Throws OutputError for any other.
enum class PictureFormat { exr, png, hdr };
PictureFormat picture_format(const std::filesystem::path& file);

/// Linear EXR of one part:
/// R, G, B of the picture, then NAME.R, NAME.G, NAME.B of each layer, compressed without loss.
/// Layers `depth` and `normal` have the channels that compositors expect: depth.Z; normal.X, .Y, .Z. `alpha` is A
/// beside R, G, B. Layers have the picture's size and names of their own. No value may be NaN; values beyond
/// the largest of the type (65504 for half), infinities too, become that largest value.
void write_exr(const std::filesystem::path& file, const Image& picture,
               std::span<const Layer> layers = {}, PixelType type = PixelType::half,
               const Attributes& attributes = {});

/// Pixels of a window of a picture, as floats, with layers that are all of R, G and B. No value may be NaN.
void write_exr_window(const std::filesystem::path& file, const Image& pixels,
                      std::span<const Layer> layers, const DataWindow& window,
                      const Attributes& attributes);

/// Linear Radiance picture of 8 bits a channel and a common exponent (Ward 1991): values are within 1 % of
/// the brightest channel of theirs. No value may be NaN; negative ones become 0.
void write_hdr(const std::filesystem::path& file, const Image& picture);

/// The display of linear light in a PNG: times 2^exposure, and then by the transform.
struct DisplaySettings {
  double exposure = 0.0; ///< stops
  ViewTransform transform = ViewTransform::srgb;
  const ShownPixels* edges = nullptr; ///< in place of their means, if of this exposure and transform
  Compression compression = Compression::small;
  int bits = 8;                                 ///< of a channel, or 16
};

/// sRGB-encoded PNG of the picture, rounded to the nearest code value. It says the
/// transform's name (`View transform`), unless that does nothing but clip. No value may be NaN.
void write_png(const std::filesystem::path& file, const Image& picture,
               const DisplaySettings& settings);
void write_png(const std::filesystem::path& file, const Image& picture, double exposure);
std::vector<std::byte> encode_png(const Image& picture, const DisplaySettings& settings);
std::vector<std::byte> encode_png(const Image& picture, double exposure,
                                  Compression compression = Compression::small);

enum class Encoding { srgb, linear };

/// Layers and attributes come sorted by name, as an EXR stores them.
struct ImageFile {
  Image picture;
  std::string picture_name;  ///< of the layer or part that it is; empty for plain R, G and B
  std::vector<Layer> layers; ///< every other NAME with NAME.R, NAME.G and NAME.B
  Attributes attributes;     ///< those that write_exr wrote
  std::vector<std::string>
      ignored_channels; ///< all others, alpha among them, by the name they have in the file
  std::vector<std::string> remarks; ///< what a user has to know to compare the picture, a line each
  Encoding encoding = Encoding::linear; ///< of the file; the values here are linear
};

/// Whether a file of layers alone, none of which is known to be the picture, is refused.
enum class Picture { needed, not_needed };

/// EXR and HDR as they are; PNG, JPEG, WebP and TIFFs of integers decoded from sRGB to linear,
/// of a TIFF the first page. Grey becomes R = G = B. The kind is recognised by the content.
/// An EXR's pixels are those of its display window, 0 where no data are. The rules of picture_channels.h
/// choose the picture among its layers and parts.
/// Refuses more than 65536 pixels on a side and more than 2^30 values in all.
ImageFile read_image(const std::filesystem::path& file, Picture picture = Picture::needed);

/// A file as write_exr_window wrote it: of a large picture what is stored is read, and no more.
/// Throws InputError for a file that is no such picture.
struct WindowFile {
  DataWindow window;
  Image pixels;
  std::vector<Layer> layers; ///< sorted by name
  Attributes attributes;     ///< likewise
};
WindowFile read_exr_window(const std::filesystem::path& file);

/// Decodes an encoded image held in memory;
/// `linear` leaves the values as they are, otherwise sRGB becomes linear.
/// Fourth component is alpha, 1 where there is none,
/// never multiplied into the colour and never decoded.
/// `name` is for the message of the InputError.
struct Bitmap {
  int width = 0, height = 0;
  std::vector<glm::vec4> pixels;
};
Bitmap decode_image(std::span<const std::byte> encoded, Encoding encoding, const std::string& name);

/// Throws OutputError when a picture could not be written there (unknown extension,
/// no such folder, no permission), so that a long run fails before its work, not after.
void check_writable_image(const std::filesystem::path& file);

} // namespace meninas
