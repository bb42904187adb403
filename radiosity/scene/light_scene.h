// Everything light is looked up in while it is gathered:
// geometry, rays, mirrors, mesh, and who computes which emitter.
//
// Emitters send direct light (closed form,
// direct_irradiance.h) when they are small, as lamps and windows are.
// However many they are, a point computes a bounded number of them (mirror/light_choice.h).
// When emitters make up more than half of the meshed area they are gathered by rays like everything
// else, which is exact where all walls glow. No light path is in both: `direct_sides` says which.
//
//   E = pi L (W/m^2),   closed form if  sum of emitting areas <= sum of meshed areas / 2
//
#pragma once

#include "mirror/virtual_lights.h"
#include "radiosity/mesh/element_mesh.h"
#include "radiosity/mesh/element_lookup.h"
#include "radiosity/scene/lamp_shares.h"
#include "radiosity/scene/sky_portals.h"
#include "scenes/surfaces/solid_bodies.h"
#include "scenes/lamps.h"
#include "scenes/materials/lobes.h"
#include "scenes/rays/ray_scene.h"
#include "scenes/materials/texture_lookup.h"

#include <memory>
#include <span>

namespace meninas {

/// Refers to objects that outlive it.
struct LightScene {
  const Scene& scene;
  const SurfaceModel& surfaces;
  const RayScene& rays;
  const MirrorSet& mirrors;
  const WorldTree& worlds;
  const ElementMesh& mesh;
  const DecodedTextures& textures;
  ElementLookup landing;
  std::vector<Emitter> emitters; ///< of direct light; area lights always
  std::vector<std::uint8_t>
      direct_sides; ///< by SideId: 1 where the closed form owns its emission in the enumerated worlds
  LightTree emitter_tree;            ///< over the emitters
  std::vector<SkyPortal> portals; ///< openings that are among the emitters, last
  std::vector<PunctualLight> punctual; ///< always direct light; the suns of the sky among them
  Rgb background{0.0}; ///< irradiance pi L of an even sky, gathered by rays that escape
  const RadianceMap* sky = nullptr; ///< a sky that is not even, as the same rays see it
  std::vector<Bsdf>
      by_angle; ///< by MaterialId, clear glass and coats that are mirrors (scenes/materials/lobes.h), without textures; empty where there are none
  bool has_glass = false;
  std::vector<std::uint8_t> cut_out_mirrors; ///< by MirrorId (mirror_holes.h); empty where there is none
  SolidBodies solids;
  bool finely_tessellated = false; ///< its small surfaces share samples (small_elements.h)
  std::vector<SideId> side_of_emitter; ///< none of portals and area lights
  std::shared_ptr<const LampGroups> lamp_groups = nullptr; ///< null: light is not told apart by lamps
  LampShares lamps = {}; ///< of its own emitters
  std::vector<Rgb> emission_factors = {}; ///< by SideId: what textures make of emission counts so many times (relight.h); empty: once
};

/// Whether mirrors and glass treat all channels alike: transport needs but one band.
bool grey_mirrors(const Scene& scene);

/// The mirrors of a scene and the worlds in them.
struct MirrorsAndWorlds {
  const MirrorSet& mirrors;
  const WorldTree& worlds;
};
LightScene make_light_scene(const Scene& scene, const SurfaceModel& surfaces, const RayScene& rays,
                            const MirrorsAndWorlds& reflected, const ElementMesh& mesh,
                            const DecodedTextures& textures = no_textures());

/// From here on light is told apart by these lamps.
void tell_lamps_apart(LightScene& light, std::shared_ptr<const LampGroups> groups);

/// The same scene on another mesh, which is kept with it; it refers to what `light` refers to.
std::shared_ptr<const LightScene> light_scene_on(const std::shared_ptr<const LightScene>& light,
                                                 ElementMesh mesh);

} // namespace meninas
