#include "runs/report/compare_report.h"

#include "image/display.h"
#include "image/metrics/heat_map.h"
#include "image/metrics/metrics.h"
#include "runs/report/page.h"
#include "runs/pages/compare_page.h"
#include "scenes/version.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace meninas {
namespace {

using Json = nlohmann::ordered_json;

double mean_luminance(const Image& image) {
  double sum = 0.0;
  for (const glm::vec3& pixel : image.pixels) {
    sum += 0.2126 * pixel.r + 0.7152 * pixel.g + 0.0722 * pixel.b;
  }
  return sum / double(image.pixels.size());
}

/// Shares of the light of the hybrid picture.
double share_of(const Comparison& comparison, const Layer& layer) {
  double all = 0.0;
  for (const Layer& other : comparison.layers) {
    all += mean_luminance(other.image);
  }
  return all > 0.0 ? mean_luminance(layer.image) / all : 0.0;
}

template <typename Predicate>
double share_where(const Comparison& comparison, Predicate&& counts) {
  double share = 0.0;
  for (const Layer& layer : comparison.layers) {
    if (counts(std::string_view(layer.name))) {
      share += share_of(comparison, layer);
    }
  }
  return share;
}

bool is_seen_in_mirrors(std::string_view layer) {
  return layer.ends_with(".mirror") || layer.ends_with(".mirrors");
}

bool is_diffuse(std::string_view layer) { return layer.starts_with("diffuse."); }
bool is_mirrored(std::string_view layer) { return layer.starts_with("diffuse.mirrored"); }

/// Of the light that diffuse surfaces reflect in this picture, what mirrors have thrown on them.
double mirrored_of_diffuse(const Comparison& comparison) {
  const double diffuse = share_where(comparison, is_diffuse);
  return diffuse > 0.0 ? share_where(comparison, is_mirrored) / diffuse : 0.0;
}

/// The same two figures by the reference's own split.
struct ReferenceShares {
  reference::Share mirrored_of_diffuse, seen_in_mirrors;
};
ReferenceShares reference_shares(const Comparison& comparison) {
  const auto any = [](std::string_view) { return true; };
  return {reference::share_of(comparison.reference, is_mirrored, is_diffuse),
          reference::share_of(comparison.reference, is_seen_in_mirrors, any)};
}

Json share_json(const reference::Share& share) {
  return {{"value", share.value}, {"standard_error", share.standard_error}};
}

std::string mirrored_text(const Comparison& comparison) {
  std::string text = fmt::format(
      "Of the light that diffuse surfaces reflect here, {:.2f} % came by way of mirrors. {:.2f} "
      "% of the picture's light is seen in mirrors.",
      100.0 * mirrored_of_diffuse(comparison), 100.0 * share_where(comparison, is_seen_in_mirrors));
  if (!comparison.reference.empty()) {
    const auto [mirrored, seen] = reference_shares(comparison);
    text += fmt::format(" The reference, split path by path, says {:.2f} ± {:.2g} % and {:.2f} ± "
                        "{:.2g} % (standard errors).",
                        100.0 * mirrored.value, 100.0 * mirrored.standard_error, 100.0 * seen.value,
                        100.0 * seen.standard_error);
  }
  return text;
}

std::string meaning_of(std::string_view layer) {
  std::string what = "light of lamps themselves";
  if (layer.starts_with("diffuse.direct")) {
    what = "light that came straight to the surface";
  } else if (layer.starts_with("diffuse.mirrored")) {
    what = "light that came to the surface by way of mirrors";
  }
  if (layer.ends_with(".mirrors")) {
    return what + ", seen by way of several mirrors or glossy surfaces";
  }
  return what + (layer.ends_with(".mirror") ? ", seen in one mirror or glossy surface"
                                            : ", seen straight");
}

MetricSettings metric_settings_of(const Comparison& comparison) {
  MetricSettings settings;
  settings.exposure = comparison.exposure;
  return settings;
}

Json metrics_of(const Comparison& comparison, const ComparedMode& mode) {
  const ComparedMode& best = comparison.modes.back();
  const PictureDifference difference =
      compare_pictures(mode.image, best.image, metric_settings_of(comparison));
  Json metrics;
  for (const Metric metric : all_metrics) {
    metrics[name_of(metric)] = value_of(difference, metric);
  }
  const double true_mean = mean_luminance(best.image);
  metrics["mean_error"] =
      true_mean > 0.0 ? (mean_luminance(mode.image) - true_mean) / true_mean : 0.0;
  return metrics;
}

Json settings_json(const Comparison& comparison) {
  Json settings = Json::object();
  for (const auto& [name, value] : comparison.settings) {
    settings[name] = value;
  }
  return settings;
}

/// What figures and page have in common.
Json header_json(const Comparison& comparison) {
  const Image& picture = comparison.modes.front().image;
  return {{"scene", comparison.scene},
          {"camera", comparison.camera},
          {"width", picture.width},
          {"height", picture.height},
          {"exposure", comparison.exposure},
          {"view_transform", name_of(comparison.transform)},
          {"version", program_version()},
          {"settings", settings_json(comparison)}};
}

/// Whole stops by which a layer is shown brighter than the pictures, so that it can be seen.
int stops_of(const Layer& layer, double exposure) {
  constexpr double most = 10.0;
  return static_cast<int>(
      std::clamp(std::floor(automatic_exposure(layer.image) - exposure), 0.0, most));
}

Json mechanisms_json(const Comparison& comparison) {
  const std::array<std::pair<const char*, const char*>, 3> rows{
      {{"emission", "light of lamps themselves"},
       {"diffuse.direct", "diffuse, light that came straight"},
       {"diffuse.mirrored", "diffuse, light that came by way of mirrors"}}};
  Json mechanisms = Json::array();
  for (const auto& [layer, name] : rows) {
    Json shares = Json::array();
    for (const char* way : {"", ".mirror", ".mirrors"}) {
      const std::string wanted = std::string(layer) + way;
      shares.push_back(
          share_where(comparison, [&](std::string_view other) { return other == wanted; }));
    }
    mechanisms.push_back({{"name", name}, {"shares", shares}});
  }
  return mechanisms;
}

} // namespace

std::string compare_json(const Comparison& comparison) {
  Json json = header_json(comparison);
  json["units"] = {{"exposure", "EV"}, {"seconds", "s"}, {"psnr", "dB"}};
  for (const char* key : {"rmse", "mae", "max_abs"})
    json["units"][key] = "W/m^2/sr";
  for (const char* key : {"relmse", "ssim", "flip", "mean_error", "share", "mirrored_of_diffuse", "seen_in_mirrors"})
    json["units"][key] = "1";
  json["modes"] = Json::array();
  for (const ComparedMode& mode : comparison.modes) {
    Json figures{{"id", mode.id}, {"seconds", mode.seconds}};
    if (&mode != &comparison.modes.back()) {
      figures["compared_with"] = comparison.modes.back().id;
      figures.update(metrics_of(comparison, mode));
    }
    json["modes"].push_back(figures);
  }
  json["layers"] = Json::array();
  for (const Layer& layer : comparison.layers) {
    json["layers"].push_back({{"name", layer.name}, {"share", share_of(comparison, layer)}});
  }
  json["mirrored_of_diffuse"] = mirrored_of_diffuse(comparison);
  json["seen_in_mirrors"] = share_where(comparison, is_seen_in_mirrors);
  if (!comparison.reference.empty()) {
    const ReferenceShares shares = reference_shares(comparison);
    json["reference"] = {{"mirrored_of_diffuse", share_json(shares.mirrored_of_diffuse)},
                         {"seen_in_mirrors", share_json(shares.seen_in_mirrors)}};
  }
  return text_of(json, 2) + '\n';
}

std::vector<DifferencePicture> difference_pictures(const Comparison& comparison) {
  std::vector<DifferencePicture> pictures;
  for (std::size_t k = 0; k + 1 < comparison.modes.size(); ++k) {
    const ComparedMode &mode = comparison.modes[k], &next = comparison.modes[k + 1];
    const Channel difference = signed_difference(mode.image, next.image);
    const std::string name = mode.id + "-minus-" + next.id;
    const HeatMapSettings settings{.title = fmt::format("{} - {}, radiance", mode.id, next.id),
                                   .top = readable_top(difference),
                                   .scale = ErrorScale::signed_};
    pictures.push_back({name,
                        fmt::format("blue where {} is darker than {}, orange where it is brighter",
                                    mode.name, next.name),
                        heat_map(difference, settings)});
  }
  return pictures;
}

std::string compare_page_of(const Comparison& comparison) {
  Json json = header_json(comparison);
  json["pictures"] = Json::array();
  for (const ComparedMode& mode : comparison.modes) {
    Json picture{{"id", mode.id},
                 {"name", mode.name},
                 {"note", mode.note},
                 {"seconds", mode.seconds},
                 {"png", png_address(mode.image, {.exposure = comparison.exposure,
                                                  .transform = comparison.transform})}};
    if (&mode != &comparison.modes.back()) {
      picture["compared_with"] = comparison.modes.back().name;
      picture["metrics"] = metrics_of(comparison, mode);
    }
    json["pictures"].push_back(picture);
  }
  json["command"] = comparison.command;
  json["mechanisms"] = mechanisms_json(comparison);
  json["mirrored_text"] = mirrored_text(comparison);
  json["differences"] = Json::array();
  for (const DifferencePicture& difference : difference_pictures(comparison)) {
    json["differences"].push_back({{"name", difference.name},
                                   {"caption", difference.caption},
                                   {"file", difference.name + ".png"},
                                   {"png", png_address(difference.image, 0.0)}});
  }
  json["layers"] = Json::array();
  for (const Layer& layer : comparison.layers) {
    const double share = share_of(comparison, layer);
    if (share > 0.0) {
      const int stops = stops_of(layer, comparison.exposure);
      json["layers"].push_back({{"name", layer.name},
                                {"share", share},
                                {"meaning", meaning_of(layer.name)},
                                {"file", "hybrid.exr"},
                                {"stops", stops},
                                {"png", png_address(layer.image, {.exposure = comparison.exposure + stops,
                                                            .transform = comparison.transform})}});
    }
  }
  return fill_page(compare_page, text_of(json, -1));
}

} // namespace meninas
