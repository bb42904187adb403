#include "scenes/gltf/state/visibility.h"

namespace meninas::gltf {

using Nodes = std::vector<std::size_t>;

static Nodes indices_at(const Json& object, std::string_view key) {
  Nodes indices;
  if (const auto* list = find(object, key))
    for (const auto& value : *list)
      indices.push_back(size_value(value));
  return indices;
}

/// Those nodes and all below them. Every node is walked through once.
static std::vector<bool> with_all_below(const Json& root, Nodes open) {
  std::vector<bool> reached(count_of(root, "nodes"), false);
  while (!open.empty()) {
    const auto node = open.back();
    open.pop_back();
    if (reached[node])
      continue;
    reached[node] = true;
    for (const auto child : indices_at(element(root, "nodes", node), "children"))
      open.push_back(child);
  }
  return reached;
}

static Nodes invisible_nodes(const Json& root) {
  Nodes invisible;
  for (std::size_t node = 0; node < count_of(root, "nodes"); ++node) {
    const auto* visible = find(element(root, "nodes", node),
                               {"extensions", "KHR_node_visibility", "visible"});
    if (visible && !visible->get<bool>())
      invisible.push_back(node);
  }
  return invisible;
}

/// Coarser levels of nodes. What is one itself has none: lists that name each other hide one end.
static Nodes coarser_levels(const Json& root, Findings& findings) {
  Nodes coarser;
  std::vector<bool> is_coarser(count_of(root, "nodes"), false);
  for (std::size_t node = 0; node < is_coarser.size(); ++node) {
    const auto* levels = find(element(root, "nodes", node), {"extensions", "MSFT_lod"});
    if (!levels || is_coarser[node])
      continue;
    findings.about("coarser levels of detail are not shown, of nodes", place(root, "nodes", node));
    for (const auto level : indices_at(*levels, "ids")) {
      if (level == node || is_coarser[level])
        continue;
      is_coarser[level] = true;
      coarser.push_back(level);
    }
  }
  return coarser;
}

/// Whether there was anything to be seen of it.
static bool take_sights(Json& node) {
  bool had = node.erase("mesh") > 0;
  if (const auto extensions = node.find("extensions"); extensions != node.end())
    for (const char* lights : {"EXT_lights_area", "EXT_lights_ies", "KHR_lights_punctual"})
      had = extensions->erase(lights) > 0 || had;
  return had;
}

void hide_nodes(Json& root, Findings& findings) {
  const auto invisible = with_all_below(root, invisible_nodes(root));
  const auto coarser = with_all_below(root, coarser_levels(root, findings));
  for (std::size_t node = 0; node < invisible.size(); ++node) {
    if (!invisible[node] && !coarser[node])
      continue;
    if (take_sights(root["nodes"][node]) && invisible[node])
      findings.about("the file hides meshes and lights of nodes", place(root, "nodes", node));
  }
}

} // namespace meninas::gltf
