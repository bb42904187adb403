#include "runs/walk/walk_page.h"

#include "image/colour_map.h"
#include "image/image_file.h"
#include "runs/pages/walk_page.h"
#include "runs/report/page.h"
#include "runs/walk/packed_numbers.h"
#include "scenes/errors.h"
#include "scenes/photometry.h"
#include "scenes/sky/radiance_map.h"
#include "scenes/version.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <map>

namespace meninas {

namespace {

using nlohmann::json;

json array_of(const Vec3& x) { return json::array({x.x, x.y, x.z}); }

json tables_json(const PackedNumbers& packed) {
  json tables = json::array();
  for (const PackedTable& table : packed.tables)
    tables.push_back({{"name", table.name},
                      {"rows", table.rows},
                      {"columns", table.columns},
                      {"bytes", table.bytes_each}});
  return tables;
}

int number_of(std::uint32_t lamp) { return lamp == no_lamp ? -1 : int(lamp); }

json looks_json(const WalkRoom& room) {
  json looks = json::array();
  for (const WalkLook& look : room.looks)
    looks.push_back({{"name", std::string(look.name)},
                     {"albedo", array_of(look.albedo)},
                     {"rest", array_of(look.rest)},
                     {"emission", array_of(look.emission)},
                     {"reflectance", array_of(look.reflectance)},
                     {"f0", array_of(look.f0)},
                     {"f90", look.f90},
                     {"tint", array_of(look.tint)},
                     {"ior", look.ior},
                     {"alpha", look.alpha},
                     {"cutoff", look.cutoff},
                     {"roughness", look.roughness},
                     {"lamp", number_of(look.lamp)},
                     {"kind", static_cast<int>(look.kind)}});
  return looks;
}

/// Textures that the page shows, each image once, as the browser decodes it.
class Pictures {
public:
  Pictures(const Scene& scene, std::vector<std::string>& warnings)
      : scene_(scene), warnings_(warnings) {}

  /// Its number on the page; -1 where it has none.
  int number_of(TextureId id) {
    if (id == none<TextureId>)
      return -1;
    const auto [place, is_new] = numbers_.emplace(id, -1);
    if (is_new)
      place->second = add(scene_.textures[index(id)]);
    return place->second;
  }
  json images = json::array(), textures = json::array();

private:
  static std::string kind_of(std::span<const std::byte> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\x89PNG"))
      return "image/png";
    if (text.starts_with("\xff\xd8\xff"))
      return "image/jpeg";
    if (text.starts_with("RIFF") && text.substr(0, 12).ends_with("WEBP"))
      return "image/webp";
    return "";
  }

  int add(const Texture& texture) {
    const std::string kind = kind_of(texture.encoded);
    if (kind.empty()) {
      warnings_.push_back(fmt::format("texture '{}' is of a kind that browsers may not read: the "
                                      "page shows its factor alone",
                                      texture.name));
      return -1;
    }
    std::string address = "data:" + kind + ";base64," + base64(texture.encoded);
    const auto [place, is_new] = known_.emplace(std::move(address), int(images.size()));
    if (is_new)
      images.push_back(place->first);
    textures.push_back({{"image", place->second},
                        {"wrap", {int(texture.wrap_u), int(texture.wrap_v)}},
                        {"nearest", texture.magnified == TexelFilter::nearest}});
    return int(textures.size()) - 1;
  }

  const Scene& scene_;
  std::vector<std::string>& warnings_;
  std::map<TextureId, int> numbers_;
  std::map<std::string, int> known_;
};

json batches_json(const WalkRoom& room, Pictures& pictures) {
  const auto number = [](auto id) { return id == none<decltype(id)> ? -1 : int(index(id)); };
  json batches = json::array();
  for (const WalkBatch& b : room.batches)
    batches.push_back({int(b.section), pictures.number_of(b.colour), pictures.number_of(b.emission),
                       number(b.mirror), number(b.node), b.first, b.count});
  return batches;
}

json mirrors_json(const IrradianceField& field, const Point3& middle) {
  json mirrors = json::array();
  for (const Mirror& mirror : field.scene->mirrors.mirrors) {
    json windows = json::array();
    for (const ConvexPolygon& polygon : mirror.window) {
      json points = json::array();
      for (const Point3& x : polygon.span())
        points.push_back(array_of(x - middle));
      windows.push_back(std::move(points));
    }
    const bool pane = mirror.by_angle != none<MaterialId> && !mirror.is_coat;
    mirrors.push_back(
        {{"kind", mirror.is_coat ? "coat" : pane ? "pane" : "mirror"},
         {"normal", array_of(mirror.plane.normal)},
         {"offset", mirror.plane.offset - glm::dot(mirror.plane.normal, middle)},
         {"reflectance", largest(mirror.reflectance)},
         {"windows", std::move(windows)}});
  }
  return mirrors;
}

json cameras_json(const std::vector<WalkCamera>& cameras, const Point3& middle) {
  json list = json::array();
  for (const auto& [camera, exposure] : cameras)
    list.push_back({{"name", camera.name},
                    {"position", array_of(camera.position - middle)},
                    {"forward", array_of(camera.forward)},
                    {"up", array_of(camera.up)},
                    {"orthographic", camera.projection == Projection::orthographic},
                    {"half", camera.projection == Projection::orthographic
                                 ? camera.half_height
                                 : std::tan(0.5 * camera.vertical_fov)},
                    {"aspect", camera.aspect},
                    {"fit", int(camera.sensor_fit)},
                    {"section", camera.section},
                    {"exposure", exposure}});
  return list;
}

/// What halves times this are radiances of the sky: up to the brightest, unless the rest would then be
/// too dark for halves. What is clipped then is millions of times as bright as the mean.
double sky_scale(std::span<const glm::vec3> texels) {
  constexpr double brightest = 65504.0, min_mean = 0.01;
  double most = 0.0, sum = 0.0;
  for (const glm::vec3& texel : texels) {
    most = std::max(most, double{largest(texel)});
    sum += double{largest(texel)} / double(texels.size());
  }
  return most > 0.0 ? std::min(most / brightest, sum / min_mean) : 1.0;
}

/// The sky in at most 256 x 128 texels, row by row from the zenith.
struct SkyTexels {
  int width = 0, height = 0;
  std::vector<glm::vec3> radiance;
};

SkyTexels sky_texels(const RadianceMap& map, Suns suns) {
  SkyTexels sky{std::min(map.width, 256), std::min(map.height, 128), {}};
  for (int j = 0; j < sky.height; ++j)
    for (int i = 0; i < sky.width; ++i)
      sky.radiance.emplace_back(radiance_from(
          map, direction_at(map, (i + 0.5) / sky.width, (j + 0.5) / sky.height), suns));
  return sky;
}

std::string as_halves(std::span<const glm::vec3> texels, double scale) {
  std::vector<std::byte> bytes;
  for (const glm::vec3& texel : texels)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t bits = half_bits(static_cast<float>(texel[k] / scale));
      bytes.push_back(static_cast<std::byte>(bits & 0xffU));
      bytes.push_back(static_cast<std::byte>(bits >> 8U));
    }
  return base64(deflated(bytes));
}

/// Where suns and sky are lamps of their own, the sky without its suns as well.
json sky_json(const Environment& background, bool suns_apart) {
  if (!background.map)
    return nullptr;
  const RadianceMap& map = *background.map;
  const SkyTexels sky = sky_texels(map, Suns::shown);
  const double scale = sky_scale(sky.radiance);
  json data{{"width", sky.width},
            {"height", sky.height},
            {"scale", scale},
            {"turned", {map.turned_cos, map.turned_sin}},
            {"texels", as_halves(sky.radiance, scale)}};
  if (suns_apart)
    data["withoutSuns"] = as_halves(sky_texels(map, Suns::left_out).radiance, scale);
  return data;
}

json lamps_json(const WalkPage& page, std::span<const float> lights) {
  json lamps = json::array();
  for (std::size_t l = 0; l < page.lamps.size(); ++l)
    lamps.push_back({{"name", page.lamps[l].name},
                     {"factor", array_of(page.lamps[l].factor)},
                     {"light", lights[l]}});
  return lamps;
}

double luminance(const glm::vec3& c) { return luminance_of(c); }

json false_colours_json() {
  json colours = json::array();
  for (int k = 0; k < 256; ++k) {
    const glm::vec3 c = magma(k / 255.0);
    for (int band = 0; band < 3; ++band)
      colours.push_back(std::lround(255.0F * c[band]));
  }
  return colours;
}

} // namespace

double top_irradiance(std::span<const glm::vec3> irradiance) {
  std::vector<double> values;
  for (const glm::vec3& value : irradiance)
    if (value != glm::vec3(0.0F))
      values.push_back(luminance(value));
  if (values.empty())
    return 1.0;
  const auto place = values.begin() + std::ptrdiff_t(0.98 * double(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

std::string walk_page_data(const WalkPage& page, std::vector<std::string>& warnings) {
  const Scene& scene = page.field.scene->scene;
  const std::size_t triangles = page.room.indices.size() / 3;
  if (triangles > max_walk_triangles)
    throw InputError(scene.file, "",
                     fmt::format("its solved mesh has {} triangles, and a page takes {} at the "
                                 "most: try --quality draft or fewer --elements",
                                 triangles, max_walk_triangles));
  check_walk_lamps(scene.file, page.lamps.size(), page.room.vertices.size());
  Pictures pictures(scene, warnings);
  const PageVertices vertices = page_vertices(page.room, page.lamps.size(), page.numbering);
  const LampGroups groups = page.field.scene->lamp_groups ? *page.field.scene->lamp_groups : LampGroups{};
  json data{{"title", page.title},
            {"program", fmt::format("Meninas {}", program_version())},
            {"tables", tables_json(vertices.packed)},
            {"packed", base64(deflated(vertices.packed.bytes, page.packed))},
            {"step", vertices.step},
            {"light", vertices.light},
            {"lamps", lamps_json(page, vertices.lamp_lights)},
            {"skyLamp", number_of(groups.sky)},
            {"sunLamp", number_of(groups.sun)},
            {"looks", looks_json(page.room)},
            {"batches", batches_json(page.room, pictures)},
            {"mirrors", mirrors_json(page.field, page.room.middle)},
            {"cameras", cameras_json(page.cameras, page.room.middle)},
            {"background", array_of(scene.background.constant)},
            {"sky", sky_json(scene.background, groups.sun != no_lamp)},
            {"transform", std::string(name_of(page.transform))},
            {"minThroughput", page.min_throughput},
            {"luminousEfficacy", page.luminous_efficacy},
            {"top", top_irradiance(page.lamps.empty()
                                       ? irradiance_of(page.room)
                                       : under_factors(page.room.irradiance_by_lamp, page.lamps))},
            {"falseColours", false_colours_json()}};
  json nodes = json::array();
  for (const Node& node : scene.nodes)
    nodes.push_back(node.name);
  data["nodes"] = std::move(nodes);
  data["images"] = std::move(pictures.images);
  data["textures"] = std::move(pictures.textures);
  return data.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string walk_page_html(const WalkPage& page, std::vector<std::string>& warnings) {
  return fill_page(walk_page, walk_page_data(page, warnings));
}

} // namespace meninas
