// Values for vertices on which something stands:
// what the field has to be there so that it is right where it is seen.
//
// Along every edge of an element from such a vertex v to an exposed one n, the place c is found
// where something begins to stand, and light is gathered at two thirds of the way there, at p.
// The line through both values is followed under it:
//
//   H(v) = H(p) + min(|v - p| / |p - n|, 2) (H(p) - H(n)),  at least 0,
//
// for direct and for indirect light,
// each with the part of it that comes by way of mirrors.
//
// Over the exposed part, from n to c, the line has the mean of any parabola (Radau's rule).
// v takes the mean over its edges, each weighed by |p - n|^2, the inverse of its variance.
// So the foot of a bright wall is bright, and a contact shadow dark.
// Vertices without such an edge are left to fill_vertices() (vertex_fill.h).
#pragma once

#include "radiosity/field/irradiance_field.h"
#include "radiosity/field/vertex_light.h"

#include <functional>
#include <span>

namespace meninas {

/// An edge of an element, by ElementVertexId.
struct ContactEdge {
  std::uint32_t covered, exposed;
};

/// `valid` by ElementVertexId: not covered. Hanging vertices take what the ends
/// of their edges have: they are exposed where both are, and never covered.
std::vector<ContactEdge> contact_edges(const ElementMesh& mesh,
                                       std::span<const std::uint8_t> valid);

/// p, as a share of an edge from its exposed end to the covered one;
/// 0 where nothing on it is open but that end.
double contact_place(const Receiver& exposed, const Point3& covered,
                     const std::function<bool(const Receiver&)>& is_open);

/// The light gathered on an edge, next to the place where an object begins to stand on it.
struct ContactLight {
  double place; ///< of p, as a share of the edge from its exposed end; 0 where none was found
  VertexValue value;
};

/// `exposed` and `covered` are the ends. `irradiance` by ElementId tells which elements are lit.
ContactLight light_at_contact(const PointGathering& gathering, const std::vector<Rgb>& irradiance,
                              const GatheringPoint& exposed, const Point3& covered,
                              PointWorkspace& work);

/// The light that a covered vertex gets by lines along its edges.
class ContactLines {
public:
  /// The line through what is seen at n and, at p, beside the contact.
  void add(const ArrivingLight& seen, const ArrivingLight& beside, double place);

  ArrivingLight mean() const; ///< of those that were added, one at least

private:
  ArrivingLight sum_;
  double weights_ = 0.0;
};

/// Follows the lines through H(n) and H(p), and marks as valid what has got a value.
/// `lights` by edge.
void extend_to_contacts(std::span<const ContactEdge> edges, std::span<const ContactLight> lights,
                        std::vector<std::uint8_t>& valid, VertexIrradiance& field);

/// Vertices beyond what cuts an element have the light of the place next to it. The line through
/// that and the light at the element's own corners is followed to the vertex, so that light is
/// right where it is seen.
/// `receivers` by ElementVertexId: where each vertex has gathered.
void extend_over_regions(const ElementMesh& mesh, std::span<const Receiver> receivers,
                         std::vector<std::uint8_t>& valid, VertexIrradiance& field);

} // namespace meninas
