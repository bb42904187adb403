// The lamps of a scene: what its light comes from, in groups that have a name.
//
// Radiosity is linear in its lamps, H = sum over lamps l of s_l H_l with s_l a factor by channel,
// dimensionless: the light of each, found once, gives that of every state of all.
//
// Lamps are the nodes that emit, or their materials, and every punctual and area light; those whose node says
// the same `extras.lamp` are one lamp of that name. The environment is the lamp `sky`, the
// suns in its picture are the lamp `sun`.
#pragma once

#include "scenes/scene.h"

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace meninas {

enum class LampGrouping { node, material };

inline constexpr std::uint32_t no_lamp = std::numeric_limits<std::uint32_t>::max();

/// Numbers of lamps are places in `names`.
struct LampGroups {
  LampGrouping grouping = LampGrouping::node;
  std::vector<std::string> names;
  std::vector<std::uint32_t> of_node;     ///< by NodeId; `no_lamp`: does not emit, or goes by material
  std::vector<std::uint32_t> of_material; ///< by MaterialId, where it is materials that are grouped
  std::vector<std::uint32_t> of_light;    ///< by place in Scene::lights
  std::uint32_t sun = no_lamp, sky = no_lamp;
  std::vector<std::uint32_t> of_area_light; ///< by place in Scene::area_lights

  std::size_t size() const { return names.size(); }
};

/// The lamp that emits from a face of this node and material.
std::uint32_t lamp_of(const LampGroups& lamps, NodeId node, MaterialId material);

/// In the order of nodes or materials, punctual lights, area lights, sun, sky.
LampGroups find_lamps(const Scene& scene, LampGrouping grouping);

/// A factor that a user gives a lamp; `all` are all of them.
struct LampFactor {
  std::string lamp;
  Rgb factor{1.0};
};

/// By lamp, in the order in which they are given, the last word counts; 1 for others.
/// Throws UsageError that lists what there is where a lamp is not known.
std::vector<Rgb> factors_of_lamps(std::span<const std::string> names,
                                  std::span<const LampFactor> given);

/// A map of the sky as bright as that, its suns by a factor of their own.
Environment relit(const Environment& environment, const Rgb& sky, const Rgb& sun);

/// Makes punctual lights, the sky and its suns so bright; faces stay what they are.
void relight_surroundings(Scene& scene, const LampGroups& lamps, std::span<const Rgb> factors);

/// The scene with its lamps so bright. A material that shines in several lamps becomes as many.
Scene relit(Scene scene, const LampGroups& lamps, std::span<const Rgb> factors);

} // namespace meninas
