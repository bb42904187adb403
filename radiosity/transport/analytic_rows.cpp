#include "radiosity/transport/analytic_rows.h"

#include "scenes/surfaces/closedness.h"
#include "form_factors/extended_form_factor.h"
#include "form_factors/kaleidoscope.h"
#include "scenes/errors.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <iterator>
#include <optional>

namespace meninas {

namespace {

constexpr std::size_t max_elements = 2000;

/// Every mirror has its worlds here, however small it is.
constexpr MirrorSettings all_mirrors{.max_mirrors = 1 << 20, .smallest_share = 0.0};

Face make_face(const ConvexPolygon& polygon, const Plane& plane, PlaneId plane_class) {
  Face face;
  face.polygon = polygon;
  face.plane = plane;
  face.plane_class = plane_class;
  const Vec3 area = area_vector(polygon.span());
  face.area = glm::length(area);
  if (glm::dot(area, plane.normal) < 0.0)
    std::reverse(face.polygon.vertices.begin(),
                 face.polygon.vertices.begin() + static_cast<std::ptrdiff_t>(face.polygon.size));
  for (const Point3& vertex : polygon.span())
    face.centre += vertex / static_cast<double>(polygon.size);
  for (const Point3& vertex : polygon.span())
    face.radius = std::max(face.radius, glm::distance(vertex, face.centre));
  return face;
}

/// An element as one face, or as the triangles of a region.
std::vector<Face> faces_of(const ElementMesh& mesh, std::size_t element) {
  const MeshSide& side = mesh.sides[index(mesh.side_of_element[element])];
  std::vector<Face> faces;
  if (const RegionElement* region = region_of(mesh, static_cast<ElementId>(element))) {
    for (const auto& triangle : region->triangles)
      faces.push_back(make_face(ConvexPolygon(triangle), side.plane, side.plane_class));
    return faces;
  }
  ConvexPolygon polygon;
  for (int k = 0; k < (side.triangle ? 3 : 4); ++k)
    polygon.push_back(mesh.vertices[index(mesh.corners[element][static_cast<std::size_t>(k)])]);
  faces.push_back(make_face(polygon, side.plane, side.plane_class));
  return faces;
}

/// The surfaces that light can end on, in groups: every element, then all that is black, then every mirror.
struct Surroundings {
  std::vector<Face> blockers;
  MirrorSet mirrors;
  std::vector<Face> targets;
  std::vector<std::uint32_t> groups;
  std::uint32_t black = 0, first_mirror = 0, group_count = 0;
};

/// Faces without elements that are no mirrors: the backs of single-sided ones, above all.
void add_black_faces(const LightScene& light, Surroundings& around) {
  for (std::size_t p = 0; p < light.surfaces.patches.size(); ++p) {
    const Patch& patch = light.surfaces.patches[p];
    const Surface& surface = light.surfaces.surfaces[index(patch.surface)];
    const Material& material = light.scene.materials[index(patch.material)];
    for (std::size_t facing = 0; facing < 2; ++facing) {
      const bool reflects = is_mirror(material) && (facing == 0 || material.double_sided);
      if (reflects || light.mesh.sides_of_patch[p][facing] != none<SideId>)
        continue;
      const double sign = facing == 0 ? 1.0 : -1.0;
      const Plane plane{sign * surface.plane.normal, sign * surface.plane.offset};
      around.targets.push_back(
          make_face(ConvexPolygon(polygon_of(patch)), plane, surface.plane_class));
      around.groups.push_back(around.black);
    }
  }
}

Surroundings surroundings_of(const LightScene& light) {
  Surroundings around;
  around.blockers = joined_faces(light.surfaces);
  around.mirrors = find_mirrors(light.scene, light.surfaces, all_mirrors);
  const auto elements = static_cast<std::uint32_t>(element_count(light.mesh));
  around.black = elements;
  around.first_mirror = elements + 1;
  around.group_count =
      around.first_mirror + static_cast<std::uint32_t>(around.mirrors.mirrors.size());
  for (std::uint32_t e = 0; e < elements; ++e) {
    for (const Face& face : faces_of(light.mesh, e)) {
      around.targets.push_back(face);
      around.groups.push_back(e);
    }
  }
  add_black_faces(light, around);
  for (std::uint32_t m = 0; m < around.mirrors.mirrors.size(); ++m) {
    const Mirror& mirror = around.mirrors.mirrors[m];
    for (const ConvexPolygon& part : mirror.window) {
      around.targets.push_back(make_face(part, mirror.plane, mirror.plane_class));
      around.groups.push_back(around.first_mirror + m);
    }
  }
  return around;
}

/// A cell that holds everything, if mirrors are whole walls of it.
std::optional<KaleidoscopeCell> kaleidoscope_cell_of(const Surroundings& around, double tolerance) {
  const WorldView whole{around.mirrors, around.blockers, around.blockers, {}, tolerance};
  return find_kaleidoscope(whole, {});
}

/// The data that the rows share.
struct AnalyticAssembly {
  const LightScene& light;
  const Surroundings& around;
  const WorldView view;
  std::optional<KaleidoscopeCell> cell;
  ExtendedSettings extended;
  bool closed = false, depth_capped = false;
};

/// Whether nothing but black is seen from the middle of the part: something stands on it.
/// A part that faces only the outside of a closed scene sees nothing at all.
bool is_covered(const AnalyticAssembly& assembly, const Face& part) {
  constexpr double whole = 1.0 - 1e-6;
  WalkSettings real_world;
  real_world.max_depth = 0;
  const WalkPoint point{part.centre, part.plane.normal, part.plane_class};
  double black = 0.0;
  for (const WalkShare& share : walk_worlds(assembly.view, point, real_world, {}).shares) {
    if (share.group != assembly.around.black)
      return false;
    black += share.factor;
  }
  return black > whole || (assembly.closed && black == 0.0);
}

/// The parts of an element on which nothing stands.
std::vector<Face> exposed_parts(const AnalyticAssembly& assembly, const Face& element) {
  std::vector<Face> parts;
  for (const ConvexPolygon& polygon :
       cut_at_contacts(element, assembly.around.blockers, assembly.view.tolerance)) {
    const Face part = make_face(polygon, element.plane, element.plane_class);
    if (!is_covered(assembly, part))
      parts.push_back(part);
  }
  return parts;
}

struct Row {
  std::vector<std::uint32_t> columns;
  std::vector<float> weights;
};

RowClosure closure_of(const AnalyticAssembly& assembly, const ExtendedFactors& factors) {
  const Surroundings& around = assembly.around;
  Rgb landed(0.0), absorbed(0.0);
  for (std::uint32_t e = 0; e < around.black; ++e) {
    const MeshSide& side = assembly.light.mesh.sides[index(assembly.light.mesh.side_of_element[e])];
    // A mirror that scatters as well counts where it absorbs.
    if (!is_mirror(assembly.light.scene.materials[index(side.material)]))
      landed += factors.to[e].light;
  }
  for (std::uint32_t m = 0; m < around.mirrors.mirrors.size(); ++m)
    absorbed +=
        (1.0 - around.mirrors.mirrors[m].reflectance) * factors.to[around.first_mirror + m].light;
  const Rgb black = factors.to[around.black].light;
  const Rgb rest = glm::max(Rgb(0.0), 1.0 - landed - absorbed - black - factors.tail);
  const Rgb escaped = assembly.closed ? Rgb(0.0) : rest;
  const Rgb cut = Rgb(factors.tail) + (assembly.closed && assembly.depth_capped ? rest : Rgb(0.0));
  RowClosure closure;
  closure.landed = static_cast<float>(mean_of(landed + absorbed));
  closure.black = static_cast<float>(mean_of(black));
  closure.escaped = static_cast<float>(mean_of(escaped));
  closure.cut = static_cast<float>(mean_of(cut));
  closure.mirror_absorbed = absorbed;
  closure.black_light = black;
  closure.escaped_light = escaped;
  closure.cut_light = cut;
  return closure;
}

void assemble_row(const AnalyticAssembly& assembly, std::size_t i, Row& row, FormFactors& result) {
  const ElementMesh& mesh = assembly.light.mesh;
  std::vector<Face> exposed;
  for (const Face& face : faces_of(mesh, i))
    std::ranges::move(exposed_parts(assembly, face), std::back_inserter(exposed));
  double area = 0.0;
  for (const Face& part : exposed)
    area += part.area;
  result.exposed[i] = static_cast<float>(std::min(1.0, area / mesh.area[i]));
  if (exposed.empty()) {
    result.closure[i].black = 1.0F;
    result.closure[i].black_light = glm::vec3(1.0F);
    return;
  }
  const std::uint32_t groups = assembly.around.group_count;
  const ExtendedFactors factors =
      assembly.cell ? kaleidoscope_form_factors(assembly.view, exposed, groups, assembly.extended,
                                                *assembly.cell)
                    : extended_form_factors(assembly.view, exposed, groups, assembly.extended);
  result.closure[i] = closure_of(assembly, factors);
  for (std::uint32_t e = 0; e < assembly.around.black; ++e) {
    const Rgb& light = factors.to[e].light;
    if (light == Rgb(0.0))
      continue;
    row.columns.push_back(e);
    for (int band = 0; band < result.transport.bands; ++band)
      row.weights.push_back(static_cast<float>(light[band]));
  }
}

AnalyticAssembly make_assembly(const LightScene& light, const Surroundings& around,
                       const FormFactorSettings& settings) {
  const double tolerance = light.surfaces.tolerance;
  AnalyticAssembly assembly{light,
                    around,
                    {around.mirrors, around.blockers, around.targets, around.groups, tolerance},
                    {},
                    {}};
  assembly.extended.accuracy = settings.accuracy;
  assembly.extended.max_depth = settings.max_bounces;
  assembly.extended.listing = WorldListing::totals;
  assembly.extended.max_discontinuity_lines /= std::max<std::size_t>(1, element_count(light.mesh));
  assembly.depth_capped = settings.max_bounces < FormFactorSettings{}.max_bounces;
  assembly.closed = is_closed(light.scene, 0.5 * tolerance);
  assembly.cell = kaleidoscope_cell_of(around, tolerance);
  assembly.extended.importance.assign(around.group_count, 0.0);
  for (std::uint32_t e = 0; e < around.black; ++e)
    assembly.extended.importance[e] = mean_of(light.mesh.emission[e]);
  return assembly;
}

int bands_of(const MirrorSet& mirrors) {
  const bool grey =
      std::all_of(mirrors.mirrors.begin(), mirrors.mirrors.end(), [](const Mirror& mirror) {
        return mirror.reflectance.r == mirror.reflectance.g &&
               mirror.reflectance.g == mirror.reflectance.b;
      });
  return grey ? 1 : 3;
}

} // namespace

FormFactors analytic_transport(const LightScene& light, const FormFactorSettings& settings,
                               const Progress& progress) {
  const std::size_t size = element_count(light.mesh);
  if (std::ranges::any_of(light.mesh.solid, [](float share) { return share < 1.0F; }))
    throw UsageError(light.scene.file, "--form-factors analytic takes cut-outs for opaque: rays or "
                                       "hemicubes see through their holes");
  if (light.has_glass)
    throw UsageError(light.scene.file, "--form-factors analytic takes glass for opaque: rays or "
                                       "hemicubes see through it");
  if (light.sky != nullptr)
    throw UsageError(light.scene.file, "--form-factors analytic knows how much of the sky is seen, "
                                       "not where: rays or hemicubes do");
  if (size > max_elements)
    throw UsageError(
        light.scene.file,
        fmt::format("--form-factors analytic is for up to {} elements, and here are {}: its time "
                    "grows with their square; larger elements (--element-size) or rays would do",
                    max_elements, size));
  const Surroundings around = surroundings_of(light);
  const AnalyticAssembly assembly = make_assembly(light, around, settings);
  FormFactors result;
  result.closure.resize(size);
  result.covered.resize(size);
  result.exposed.resize(size);
  result.transport.size = size;
  result.transport.bands = bands_of(around.mirrors);

  std::vector<Row> rows(size);
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, size, [&](std::size_t i) {
    assemble_row(assembly, i, rows[i], result);
    if (progress)
      progress("form factors", static_cast<double>(++done) / static_cast<double>(size));
  });
  Transport& transport = result.transport;
  transport.row_begin.push_back(0);
  for (const Row& row : rows) {
    transport.columns.insert(transport.columns.end(), row.columns.begin(), row.columns.end());
    transport.weights.insert(transport.weights.end(), row.weights.begin(), row.weights.end());
    transport.row_begin.push_back(transport.columns.size());
  }
  result.beyond = transport; // no other term brings the light of emitters
  return result;
}

} // namespace meninas
