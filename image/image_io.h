// The seam between the program and the shared module that holds OpenImageIO.
//
// Linking OpenImageIO maps some 260 shared objects at every start, which takes longer than a draft picture.
// So one source file uses it, compiled into a module of its own, and the module is opened with the first picture.
//
// The module only translates: encoded bytes in memory to pixels and back. It opens no file and knows no error class,
// so what crosses the seam is plain data; an exception is caught on its own side and crosses as one line of text.
// Whatever the module hands out stays its own and is given back through the matching `release`.
#pragma once

#include <cstddef>
#include <cstdint>

namespace meninas::image_io {

/// Raised with every change of this file: a module from another build is refused, not misread.
inline constexpr int seam_version = 2;

struct TextPair {
  const char* key;
  const char* value;
};

/// Three planes R, G, B of the file, stored under `prefix` ("" or "NAME."), interleaved in memory.
struct RgbPlanes {
  const char* prefix;
  const float* rgb;
};

enum class Storage : int { half, float32 };

struct ExrRequest {
  int width, height;
  Storage storage;
  const RgbPlanes* planes;
  std::size_t plane_count;
  const TextPair* attributes; ///< header strings, names as they appear in the file
  std::size_t attribute_count;
  const char* software;
};

struct PngRequest {
  int width, height;
  const std::uint8_t* rgb; ///< sRGB code values
  int effort;              ///< of the compression, 1 to 9
  const char* software;
};

/// Either bytes, or no owner and the reason why not.
struct Encoded {
  void* owner;
  const std::uint8_t* bytes;
  std::size_t size;
  char error[512];
};

/// Either pixels, or no owner and the reason why not. Channels are interleaved, rows from the top, alpha not multiplied in.
struct Decoded {
  void* owner;
  int width, height, channels;
  int code_values; ///< 0 for linear values; otherwise sRGB code values k / code_values (255 or 65535)
  const float* pixels;
  const char* const* channel_names;
  const TextPair* attributes; ///< all header strings, names as they appear in the file
  std::size_t attribute_count;
  char error[512];
};

struct Limits {
  int side;           ///< largest width and height
  std::size_t values; ///< largest width * height * channels
};

struct Table {
  int seam_version;
  void (*use_threads)(int count); ///< as many may be at work, the caller's among them
  Encoded (*encode_exr)(const ExrRequest*);
  Encoded (*encode_png)(const PngRequest*);
  void (*release_encoded)(Encoded*);
  Decoded (*decode)(const void* bytes, std::size_t size, Limits limits);
  void (*release_decoded)(Decoded*);
};

/// The one symbol the module exports: `const Table* meninas_image_io()`.
inline constexpr const char* entry_point = "meninas_image_io";
using EntryPoint = const Table* (*)();

} // namespace meninas::image_io
