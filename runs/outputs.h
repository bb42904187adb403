// The files a run writes: checked before the work, written after it.
#pragma once

#include "image/image_file.h"
#include "raytrace/render_settings.h"
#include "runs/report/picture_units.h"
#include "runs/run_events.h"

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace meninas {

struct OutputFiles {
  std::vector<std::filesystem::path> pictures;   ///< .exr, .png or .hdr
  std::optional<std::filesystem::path> solution; ///< .glb
  std::vector<std::filesystem::path> texts;
};

/// Throws OutputError for a place that cannot be written,
/// UsageError for one that holds an input or is named twice.
void check_outputs(const OutputFiles& outputs, const std::vector<std::filesystem::path>& inputs);

/// The folder, with those above it, unless it is there; throws OutputError when it cannot be.
void make_folder(const std::filesystem::path& folder);

struct PictureSettings {
  PixelType exr_type = PixelType::half;
  std::optional<double> exposure; ///< stops, of a PNG; chosen for the picture otherwise
  ViewTransform transform = ViewTransform::neutral; ///< of a PNG
  int png_bits = 8;                                 ///< of a channel, or 16
};

/// A picture, with layers for EXRs alone and edges for PNGs alone.
struct WrittenPicture {
  const Image& image;
  std::span<const Layer> layers = {};
  const ShownPixels* edges = nullptr;
  std::string_view unit = unit_of_radiance; ///< of the image, for EXRs alone
};
void write_pictures(const std::vector<std::filesystem::path>& files, const WrittenPicture& picture,
                    const PictureSettings& settings, const Attributes& attributes,
                    const RunEvents& events);

/// The bytes that write_pictures writes: of an .exr, or of a .png, whose exposure is then given.
std::vector<std::byte> picture_bytes(PictureFormat format, const WrittenPicture& picture,
                                     const PictureSettings& settings, const Attributes& attributes);

/// The display for which PNGs among these files are made, if there are any.
std::optional<DisplayChoice> display_of(const std::vector<std::filesystem::path>& files,
                                        const PictureSettings& settings);

} // namespace meninas
