#include "tests/hostile/solution_commands.h"

#include "radiosity/queries/measuring_grid.h"
#include "radiosity/queries/point_light.h"
#include "radiosity/relight.h"
#include "radiosity/solution/solution_file.h"
#include "raytrace/diffuse_term.h"
#include "runs/walk/walk_page.h"
#include "scenes/content_hash.h"
#include "scenes/errors.h"
#include "scenes/glb_file.h"
#include "tests/hostile/findings.h"
#include "tests/hostile/hostile_materials.h"
#include "tests/hostile/hostile_shapes.h"

#include <nlohmann/json.hpp>

#include <array>
#include <fstream>

#include <unistd.h>

namespace meninas::test {

namespace {

namespace fs = std::filesystem;

/// By vertex: rounding of floats in sums of a few.
void check_lamps(const IrradianceField& field) {
  double largest = 0.0;
  for (const glm::vec3& h : field.irradiance)
    largest = std::max(largest, double{glm::compMax(h)});
  for (std::size_t v = 0; v < field.irradiance.size(); ++v) {
    glm::dvec3 sum(0.0);
    for (const auto& [direct, indirect] : field.by_lamp) {
      const glm::vec3 light = direct[v] + indirect[v];
      require(is_light(direct[v]) && is_light(indirect[v]),
              fmt::format("light of a lamp at vertex {} is {} {} {}", v, light.r, light.g, light.b));
      sum += glm::dvec3(light);
    }
    const double off = glm::compMax(glm::abs(sum - glm::dvec3(glm::max(field.irradiance[v], 0.0F))));
    require(off <= 1e-5 * largest,
            fmt::format("lamps add up to {} {} {} of {} {} {} at vertex {}, the largest is {}", sum.r, sum.g,
                        sum.b, field.irradiance[v].r, field.irradiance[v].g, field.irradiance[v].b, v, largest));
  }
}

void dim_lamps(const IrradianceField& field, const TwoPassSettings& settings, Random& random) {
  check_lamps(field);
  std::vector<Rgb> factors;
  for (std::size_t l = 0; l < field.by_lamp.size(); ++l) {
    const std::array values{Rgb(0.0), Rgb(1.0), Rgb(1e6), Rgb(1.0, 0.0, 0.5), Rgb(power_of_ten(random, -9, 3))};
    factors.push_back(values[choose(random, values.size())]);
  }
  const IrradianceField other = relit(field, factors);
  const Scene& scene = other.scene->scene;
  const Camera camera = scene.cameras.empty() ? default_camera(bounds_of(scene)) : scene.cameras.front();
  RenderSettings plain = settings.render; // what mirrors bring is not known of other lamps
  plain.layers = WithLayers::no;
  require_light(render(other, camera, plain).image.pixels, "pixel under other lamps");
}

/// A file that goes away, in a folder that is there.
struct PassingFile {
  fs::path path = fs::temp_directory_path() / fmt::format("meninas-hostile-{}.glb", getpid());
  ~PassingFile() {
    std::error_code error;
    fs::remove(path, error);
  }
  void write(std::span<const std::byte> bytes) const {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
};

/// Some value of the JSON, anywhere.
Json& some_part(Json& json, Random& random) {
  Json* part = &json;
  while (part->is_structured() && !part->empty() && (part == &json || happens(random, 0.9))) {
    auto at = part->begin();
    std::advance(at, choose(random, static_cast<std::uint32_t>(part->size())));
    part = &*at;
  }
  return *part;
}

/// Of the numbers, words, bytes or of the end.
void spoil(const fs::path& file, Random& random, const PassingFile& spoiled) {
  GlbContent glb = read_glb(file);
  const std::array<Json, 12> values{0,   -1,  1e308,   1e-308,        1e18,  std::uint64_t{1} << 63,
                                    "x", nullptr, Json::array(), Json::object(), true, 1.5};
  const bool of_bytes = happens(random, 0.3);
  const Json::json_pointer notes("/asset/extras/meninas"); // which an earlier change may have taken away
  for (std::uint32_t k = 0, count = 1 + choose(random, 3); k < count && !of_bytes; ++k)
    some_part(happens(random, 0.8) && glb.root.contains(notes) ? glb.root[notes] : glb.root, random) =
        values[choose(random, values.size())];
  for (std::uint32_t k = 0; k < 4 && of_bytes && !glb.binary.empty(); ++k)
    glb.binary[choose(random, static_cast<std::uint32_t>(glb.binary.size()))] =
        static_cast<unsigned char>(choose(random, 256));
  const auto binary = std::as_bytes(std::span(glb.binary));
  if (of_bytes && happens(random, 0.8)) // as if it had been written so
    glb.root["asset"]["extras"]["meninas"]["data_hash"] = fmt::format(
        "{:016x}", hash_of_bytes(binary.first(glb.root["buffers"][0]["byteLength"].get<std::size_t>())));
  std::vector<std::byte> bytes = glb_bytes(glb.root, binary, spoiled.path);
  if (happens(random, 0.15))
    bytes.resize(choose(random, static_cast<std::uint32_t>(bytes.size())));
  spoiled.write(bytes);
}

void keep_and_read(const PreparedScene& prepared, const RadiositySolution& solution,
                   const MeshSettings& mesh, Random& random) {
  const PassingFile file;
  write_solution(file.path, content_hash(prepared.scene), prepared.mesh, solution, mesh);
  StoredSolution stored = read_solution(file.path, prepared.scene);
  require(stored.field.irradiance == solution.field.irradiance, "a solution is read in another way than written");
  const IrradianceField read = field_of(file.path, std::move(stored), prepared.light());
  require(read.irradiance == solution.field.irradiance, "the field is read in another way than written");
  for (int k = 0; k < 3; ++k) {
    const PassingFile spoiled{.path = file.path.string() + ".spoiled.glb"};
    spoil(file.path, random, spoiled);
    try {
      field_of(spoiled.path, read_solution(spoiled.path, prepared.scene), prepared.light());
    } catch (const UserError&) {
      // It is damaged, and says so.
    }
  }
}

/// On surfaces, within a hair of them, anywhere, and far away.
std::vector<QueryPoint> hostile_points(const Scene& scene, Random& random) {
  const Bounds bounds = bounds_of(scene);
  std::vector<QueryPoint> points;
  for (int k = 0; k < 6; ++k) {
    QueryPoint point{random.in_box(bounds.low, bounds.high), random.direction()};
    const auto t = choose(random, static_cast<std::uint32_t>(scene.triangles.size()));
    const auto [a, b, c] = corners(scene, TriangleId{t});
    if (happens(random, 0.6))
      point.position = happens(random, 0.3) ? a : a + 0.3 * (b - a) + 0.3 * (c - a);
    if (happens(random, 0.5))
      point.normal = glm::normalize(area_vector({a, b, c}));
    if (happens(random, 0.3))
      point.position += power_of_ten(random, -9.0, 0.0) * glm::length(b - a) * point.normal;
    if (happens(random, 0.1))
      point.position = 1e9 * random.direction();
    if (!(glm::length(point.normal) > 0.5))
      point.normal = Vec3(0.0, 1.0, 0.0);
    points.push_back(point);
  }
  return points;
}

void measure(const PreparedScene& prepared, const IrradianceField& field,
             const PassOneSettings& settings, Random& random) {
  std::vector<QueryPoint> points = hostile_points(prepared.scene, random);
  try {
    const auto node = choose(random, static_cast<std::uint32_t>(prepared.scene.nodes.size()));
    const GridSettings grid{.margin = happens(random, 0.7) ? 0.0 : power_of_ten(random, -6.0, 0.0),
                            .height = happens(random, 0.7) ? 0.0 : power_of_ten(random, -6.0, 0.0)};
    for (const MeasuringGrid& one :
         measuring_grids(prepared.scene, prepared.surfaces, prepared.scene.nodes[node].name, grid))
      if (points.size() < 24 && !one.points.empty())
        points.push_back(one.points[choose(random, static_cast<std::uint32_t>(one.points.size()))]);
  } catch (const UsageError&) {
    // No face, too many, or no room for a point.
  }
  PointQuerySettings query;
  query.rays = 64;
  query.form_factors = settings.form_factors;
  query.direct.shadow_rays = query.direct.penumbra_rays = 16;
  query.direct.images = 64;
  for (const PointIrradiance& light :
       irradiance_at_points(*field.scene, sent_light(field), points, query)) {
    require(is_light(light.total) && is_light(light.direct) && is_light(light.by_mirrors),
            fmt::format("light at a point is {} {} {}, {} of it direct and {} by mirrors", light.total.r,
                        light.total.g, light.total.b, light.direct.r, light.by_mirrors.r));
    require_light(light.by_lamp, "light of a lamp at a point");
  }
}

template <typename Vector>
bool is_finite(const Vector& v) {
  return std::isfinite(glm::compAdd(v));
}

void walk(const IrradianceField& field, Random& random) {
  const WalkRoom room = walk_room(field);
  for (const WalkVertex& v : room.vertices)
    require(is_finite(v.position) && is_finite(v.irradiance) && is_finite(v.normal) && is_finite(v.colour) &&
                v.look < room.looks.size(),
            "a vertex of a page is no number");
  for (const WalkLook& look : room.looks)
    require(is_finite(look.albedo) && is_finite(look.rest) && is_finite(look.emission) &&
                is_finite(look.reflectance) && is_finite(look.f0) && std::isfinite(look.f90 + look.ior + look.alpha),
            fmt::format("a look of a page is no number: kind {}", static_cast<int>(look.kind)));
  const Scene& scene = field.scene->scene;
  std::vector<WalkLamp> lamps;
  for (std::size_t l = 0; l < field.by_lamp.size(); ++l)
    lamps.push_back({field.scene->lamp_groups->names[l], Rgb(hostile_factor(random))});
  if (lamps.size() > max_walk_lamps)
    return;
  std::vector<std::string> warnings;
  const std::string html = walk_page_html({.field = field,
                                           .room = room,
                                           .title = "</script>",
                                           .cameras = {{default_camera(bounds_of(scene)), 0.0}},
                                           .lamps = lamps},
                                          warnings);
  require(!html.empty(), "an empty page");
}

} // namespace

void use_solution(const PreparedScene& prepared, const RadiositySolution& solution,
                  const TwoPassSettings& settings, Random& random) {
  if (!solution.field.by_lamp.empty())
    dim_lamps(solution.field, settings, random);
  if (happens(random, 0.4))
    keep_and_read(prepared, solution, settings.pass_one.mesh, random);
  if (happens(random, 0.3))
    measure(prepared, solution.field, settings.pass_one, random);
  if (happens(random, 0.3))
    walk(solution.field, random);
}

} // namespace meninas::test
