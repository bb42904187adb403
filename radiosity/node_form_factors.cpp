#include "radiosity/node_form_factors.h"

#include "scenes/errors.h"

#include <fmt/format.h>

#include <algorithm>

namespace meninas {

namespace {

/// Every mirror has its worlds here: they are entered only as far as they matter.
constexpr MirrorSettings all_mirrors{.max_mirrors = 1 << 20, .smallest_share = 0.0};

bool same_name(const Scene& scene, NodeId a, NodeId b) {
  return a == b || scene.nodes[index(a)].name == scene.nodes[index(b)].name;
}

std::vector<Face> scattering_faces(const Scene& scene, const std::vector<Face>& faces,
                                   NodeId node) {
  std::vector<Face> result;
  bool any = false;
  for (const Face& face : faces) {
    if (!same_name(scene, face.node, node))
      continue;
    any = true;
    if (!is_mirror(scene.materials[index(face.material)]))
      result.push_back(face);
  }
  const std::string& name = scene.nodes[index(node)].name;
  if (!any)
    throw UsageError(scene.file, fmt::format("node '{}' has no area that could send light", name));
  if (result.empty())
    throw UsageError(
        scene.file,
        fmt::format("node '{}' is a mirror, which has no form factors of its own", name));
  return result;
}

void require_faces(const Scene& scene, const std::vector<Face>& faces,
                   std::span<const NodeId> nodes) {
  for (const NodeId node : nodes) {
    const bool any = std::any_of(faces.begin(), faces.end(), [&](const Face& face) {
      return same_name(scene, face.node, node);
    });
    if (!any)
      throw UsageError(scene.file, fmt::format("node '{}' has no area that could receive light",
                                               scene.nodes[index(node)].name));
  }
}

WorldView view_of(const Scene& scene, const std::vector<Face>& faces, const MirrorSet& mirrors,
                  std::span<const NodeId> to, double tolerance) {
  WorldView view{mirrors, faces, {}, {}, tolerance};
  for (std::uint32_t group = 0; group < to.size(); ++group)
    for (const Face& face : faces) {
      if (!same_name(scene, face.node, to[group]))
        continue;
      view.targets.push_back(face);
      view.groups.push_back(group);
    }
  return view;
}

} // namespace

NodeFactors node_form_factors(const Scene& scene, const SurfaceModel& surfaces, NodeId from,
                              std::span<const NodeId> to, const NodeFactorSettings& settings) {
  const std::vector<Face> faces = joined_faces(surfaces);
  const std::vector<Face> senders = scattering_faces(scene, faces, from);
  require_faces(scene, faces, to);
  NodeFactors result;
  result.mirrors = find_mirrors(scene, surfaces, all_mirrors);
  for (const Face& face : senders)
    result.area += face.area;

  switch (settings.method) {
  case NodeFactorMethod::analytic: {
    if (std::ranges::any_of(scene.materials, is_glass))
      throw UsageError(scene.file,
                       "--method analytic takes glass for opaque: rays or hemicubes see "
                       "through it");
    ExtendedSettings extended;
    extended.accuracy = settings.accuracy;
    extended.max_depth = settings.max_depth;
    const WorldView view = view_of(scene, faces, result.mirrors, to, surfaces.tolerance);
    ExtendedFactors factors = extended_form_factors(view, senders, to.size(), extended);
    result.to = std::move(factors.to);
    result.converged = factors.converged;
    break;
  }
  case NodeFactorMethod::rays:
    result.to = ray_form_factors(scene, surfaces, result.mirrors, senders, to, settings);
    break;
  case NodeFactorMethod::hemicube:
    result.to = hemicube_form_factors(scene, surfaces, result.mirrors, senders, to, settings);
    break;
  }
  return result;
}

} // namespace meninas
