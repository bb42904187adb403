// Vertices on curved surfaces (scenes/shading_normal.h) receive light by the normal of the curve,
// over the curve: their irradiance goes on from facet to facet, as that of the curve does.
//
//   H(x) = integral of L(x, w) n(x).w over the hemisphere about n(x)
//
// Vertices of several facets at one place with one normal share their mean: what their samples
// find apart is noise.
#pragma once

#include "radiosity/field/vertex_samples.h"
#include "radiosity/scene/light_scene.h"

#include <optional>

namespace meninas {

/// The normal that the file gives at a point of a side, towards the side's light;
/// none where it gives none.
std::optional<Direction> given_normal(const LightScene& light, const MeshSide& side,
                                      const Point3& x);

/// Directions that are nearer than so many degrees are one normal of the file.
inline constexpr double same_normal_degrees = 3.0;

/// Whether the curve goes on between two receivers at one place: they have one normal, and are below the same coat.
bool is_one_curve(const Receiver& a, const Receiver& b);

/// A receiver beside a vertex of a side, moved to the curve there; as it is where nothing curves.
Receiver received_on_curve(const LightScene& light, const MeshSide& side, const Point3& vertex,
                           Receiver receiver);

/// Moves the receivers on curved surfaces to their curves.
void receive_on_curves(const LightScene& light, VertexSamples& found);

/// Makes vertices on curves that are one place of the curve alike; `valid` by ElementVertexId.
void join_on_curves(const LightScene& light, const VertexSamples& found,
                    std::span<const std::uint8_t> valid, VertexIrradiance& field);

} // namespace meninas
