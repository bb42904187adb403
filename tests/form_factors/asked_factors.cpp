#include "tests/form_factors/asked_factors.h"

#include "tests/support/scene_builder.h"

namespace meninas::test {

NodeSet nodes_named(const Scene& scene, const std::string& name) {
  NodeSet nodes;
  for (std::uint32_t n = 0; n < scene.nodes.size(); ++n)
    if (scene.nodes[n].name == name)
      nodes.push_back(NodeId{n});
  return nodes;
}

Asked ask(const Scene& scene, const std::string& from, const std::string& to,
          const NodeFactorSettings& settings) {
  const SurfaceModel surfaces = find_surfaces(scene);
  const std::array nodes{nodes_named(scene, to)};
  NodeFactors factors =
      node_form_factors(scene, surfaces, nodes_named(scene, from), nodes, settings);
  return {factors.to[0], factors.area, factors.converged, factors.mirrors, factors.not_counted};
}

Scene scene_of(const std::vector<ScenePolygon>& polygons, double mirror_reflectance) {
  Scene scene;
  for (const auto& polygon : polygons) {
    const Material material = polygon.role == Role::mirror    ? mirror(mirror_reflectance)
                              : polygon.role == Role::blocker ? double_sided(diffuse(0.0))
                                                              : diffuse(0.0);
    add_polygon(scene, polygon.name, polygon.corners, material);
  }
  return scene;
}

Scene pair_of(const PairCase& pair) {
  return scene_of({{"a", Role::diffuse, pair.a}, {"b", Role::diffuse, pair.b}}, 0.0);
}

} // namespace meninas::test
