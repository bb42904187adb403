// The seam between the program and the shared module that holds OpenImageIO.
//
// Linking OpenImageIO maps some 260 shared objects at every start,
// which takes longer than a draft picture.
// So one source file uses it, compiled into a module of its own,
// and the module is opened with the first picture that is read:
// a texture, a picture to compare with. EXR and PNG are written by the small libraries of their formats,
// the rare Radiance picture by this module.
//
// PNGs are read there by libpng; all other formats by OpenImageIO.
//
// The module only translates encoded bytes in memory to pixels, and back.
// It opens no file and knows no error class, so what crosses the seam is plain data;
// an exception is caught on its own side and crosses as one line of text.
// Whatever the module hands out stays its own and is given back through the matching `release`.
#pragma once

#include <cstddef>
#include <cstdint>

namespace meninas::decoder {

/// Raised with every change of this file: a module from another build is refused, not misread.
inline constexpr int seam_version = 6;

struct TextPair {
  const char* key;
  const char* value;
};

/// A part of an EXR; of other formats there is one.
/// Channels are interleaved, rows from the top, alpha not multiplied in.
struct DecodedPart {
  const char* name;               ///< empty where it has none
  const char* left_out;           ///< why it has no pixels; null where it has
  int width, height, channels;    ///< of the pixels that are stored: an EXR's data window
  int x, y;                       ///< of the first of them within the display window
  int full_width, full_height;    ///< of the display window: the picture
  const float* pixels;
  const char* const* channel_names;
};

/// Either parts, at least one of them with pixels, or no owner and the reason why not.
struct Decoded {
  void* owner;
  const DecodedPart* parts;
  std::size_t part_count;
  int code_values; ///< 0 for linear values; otherwise sRGB code values k / code_values (255 or 65535)
  const TextPair* attributes; ///< all header strings of the first part, names as they appear in the file
  std::size_t attribute_count;
  char error[512];
};

/// The content that is read of a file: all parts of an EXR; or the formats that a glTF file may name,
/// the first part, and no TIFF, whose size is not checked against the memory (scenes/materials/image_size.h);
/// or a window, however much larger the picture is.
enum class Use { picture, texture, window };

struct Limits {
  Use use;
  int side;           ///< largest width and height
  std::size_t values; ///< largest width * height * channels, of all parts together
};

/// Either bytes, or no owner and the reason why not.
struct Encoded {
  void* owner;
  const unsigned char* bytes;
  std::size_t size;
  char error[512];
};

struct Table {
  int seam_version;
  void (*use_threads)(int count); ///< as many may be at work, the caller's among them
  Decoded (*decode)(const void* bytes, std::size_t size, Limits limits);
  void (*release_decoded)(Decoded*);
  /// Radiance RGBE of a linear picture, red, green and blue interleaved, rows from the top.
  Encoded (*encode_hdr)(const float* pixels, int width, int height);
  void (*release_encoded)(Encoded*);
};

/// The one symbol the module exports: `const Table* meninas_decoder()`.
inline constexpr const char* entry_point = "meninas_decoder";
using EntryPoint = const Table* (*)();

} // namespace meninas::decoder
