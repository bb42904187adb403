#include "runs/report/comparison.h"

#include "image/display.h"
#include "runs/report/picture_units.h"
#include "scenes/errors.h"
#include "scenes/names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace meninas {

namespace fs = std::filesystem;

static Image take_layer(ImageFile& file, const fs::path& path, const std::string& name) {
  if (!file.picture_name.empty() && name == file.picture_name) {
    return std::move(file.picture);
  }
  std::vector<std::string> names;
  if (!file.picture_name.empty()) {
    names.push_back(file.picture_name);
  }
  for (Layer& layer : file.layers) {
    if (layer.name == name) {
      return std::move(layer.image);
    }
    names.push_back(layer.name);
  }
  std::string hint = "; it has no layers";
  if (const auto nearest = nearest_name(name, names)) {
    hint = fmt::format(", did you mean '{}'?", *nearest);
  } else if (!names.empty()) {
    hint = fmt::format(", there is {}", fmt::join(names, ", "));
  }
  throw InputError(path.string(), "", fmt::format("no layer '{}'{}", name, hint));
}

std::string unit_of_differences(const ComparedPicture& picture, const ComparedPicture& reference) {
  return reference.unit.empty() ? picture.unit : reference.unit;
}

ComparedPicture read_compared(const fs::path& path, const std::optional<std::string>& layer) {
  ImageFile file = read_image(path, layer ? Picture::not_needed : Picture::needed);
  std::string unit = stated_unit(file, layer.value_or(""));
  ComparedPicture result{.image = layer ? take_layer(file, path, *layer) : std::move(file.picture),
                         .encoding = file.encoding,
                         .unit = std::move(unit),
                         .remarks = std::move(file.remarks)};
  if (const auto bad = first_bad_pixel(result.image)) {
    throw InputError(path.string(), layer ? fmt::format("layer '{}'", *layer) : "", *bad);
  }
  return result;
}

void check_same_size(const Image& picture, const fs::path& picture_file, const Image& reference,
                     const fs::path& reference_file) {
  if (picture.width != reference.width || picture.height != reference.height) {
    throw InputError(picture_file.string(), "",
                     fmt::format("is {}x{} pixels, {} is {}x{}", picture.width, picture.height,
                                 reference_file.string(), reference.width, reference.height));
  }
}

MetricSettings metric_settings(const ComparedPicture& reference, std::optional<double> exposure) {
  MetricSettings settings;
  if (reference.encoding == Encoding::srgb) {
    settings.peak = 1.0;
    settings.exposure = exposure.value_or(0.0);
  } else {
    settings.exposure = exposure ? *exposure : automatic_exposure(reference.image);
  }
  return settings;
}

std::string unit_behind(Metric metric, const std::string& unit) {
  switch (metric) {
  case Metric::psnr:
    return " dB";
  case Metric::rmse:
  case Metric::mae:
  case Metric::max_abs:
    return unit.empty() ? "" : ' ' + unit;
  default: // ratios
    return "";
  }
}

bool holds(const PictureDifference& difference, const MetricLimit& limit) {
  const double value = value_of(difference, limit.metric);
  return larger_is_nearer(limit.metric) ? value >= limit.limit : value <= limit.limit;
}

std::vector<std::string> broken_limits(const PictureDifference& difference,
                                       const std::vector<MetricLimit>& limits, const std::string& unit) {
  std::vector<std::string> broken;
  for (const MetricLimit& limit : limits)
    if (!holds(difference, limit))
      broken.push_back(fmt::format("{} {:.4g} {} {:.4g}{}", name_of(limit.metric),
                                   value_of(difference, limit.metric),
                                   larger_is_nearer(limit.metric) ? "is below" : "exceeds", limit.limit,
                                   unit_behind(limit.metric, unit)));
  return broken;
}

} // namespace meninas
