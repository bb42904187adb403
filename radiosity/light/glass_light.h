// Light that emitters send to a point by way of solids of glass, refracted and reflected:
// what no shadow ray can find.
//
//   S(x) = 1/pi integral over the directions in which a face of a solid is met first of tau(w) E(w) cos dw        W/m^2
//
// E is the emission of what the ray ends on, tau what faces, mirrors and the ways inside solids
// leave of it (glass_rays.h); only emitters whose light is direct count,
// as others are gathered. S is a part of D: it is computed wherever
// direct_irradiance.h and shared_light.h compute D, whose shadow rays end at solids.
//
// Rays go to each body of solids (solid_bodies.h):
// cos dw is area on the unit disc below the hemisphere (Nusselt 1928),
// where all directions to the sphere around the body lie within a rectangle, so that
//
//   S(x) = sum over bodies of  A / pi  mean of tau E over points of the rectangle, of area A
//
// where a ray counts if it meets this body first. Points are those of low-discrepancy sequences,
// N to a body: N goes by the root of A, for the error is about A times 1 / sqrt(N).
// Few rays find a lamp, so there are two stages. (1) A quarter of the rays, spread evenly, finds the
// cells of the rectangle that show light. (2) The others follow a density q over these cells and their
// neighbours, plus an even part, and count tau E / q.
//
//   S = 0.1 mean(1) + 0.9 mean(2)
//
// The weights are fixed, so S is unbiased. Fewer rays than there are cells are all spread evenly.
// The mean over several points of a plane takes as many rays as one.
//
// Limits: light of punctual and area lights, which no ray meets,
// goes straight through solids, each face a sheet (virtual_light_visibility.h).
#pragma once

#include "radiosity/scene/lighting.h"
#include "radiosity/transport/hemisphere_rays.h"

#include <span>

namespace meninas {

/// Storage reused from one mean to the next; one for each thread.
struct SolidWorkspace {
  GatherWorkspace gather;
  std::vector<LitPacket> packets;
  std::vector<std::uint16_t> cell_of_ray; ///< of the rectangle, by number of the ray
  std::vector<float> shown, density;      ///< by cell: light found, q over an even one
  std::vector<Point3> points;             ///< for those who collect them
};

struct SolidLight {
  Rgb total{0.0}, mirrored{0.0}; ///< irradiance, and the part that was reflected on its way
  ArrivedByLamp by_lamp = {};    ///< likewise; empty where light is not told apart
};

/// Points of one side of a plane, in metres.
struct PlanePoints {
  std::span<const Point3> positions;
  Direction normal;
  PlaneId plane_class = none<PlaneId>;
  Vec3 tangent{0.0};                  ///< as of Receiver
  MaterialId coat = none<MaterialId>; ///< likewise
};

/// Whether there is any such light.
bool has_solid_light(const Lighting& light);

/// The mean over the points, by `rays` to a body that fills the hemisphere. Adds to `traced`.
SolidLight solid_light(const LightScene& light, const PlanePoints& points, int rays,
                       std::uint32_t seed, std::uint64_t& traced, SolidWorkspace& workspace);

} // namespace meninas
