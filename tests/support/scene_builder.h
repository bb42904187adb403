// Scenes for tests, written down by hand: quads and triangles with a material and a node name each.
#pragma once

#include "scenes/scene.h"

#include <string>
#include <vector>

namespace meninas::test {

Material diffuse(double reflectance, double emitted_radiosity = 0.0);
Material diffuse(Rgb reflectance, Rgb emitted_radiosity = Rgb(0.0));
Material mirror(double reflectance);
Material double_sided(Material material);

/// Adds a polygon of three or four corners,
/// counter-clockwise seen from the front, as a node of its own.
NodeId add_polygon(Scene& scene, const std::string& name, const std::vector<Point3>& corners,
                   const Material& material);

/// The six inward walls of the box from low to high, in the order x0 x1 y0 y1 z0 z1, named so.
void add_room(Scene& scene, Point3 low, Point3 high, const std::array<Material, 6>& walls);

/// The six outward faces of a box, in the same order, named name.x0 and so on.
void add_box(Scene& scene, const std::string& name, Point3 low, Point3 high,
             const Material& material);

/// A camera at `eye` that looks at `target`, +Y up.
Camera look_at(Point3 eye, Point3 target, double vertical_fov);

/// The same scene after x -> scale * (rotation x) + offset.
Scene transformed(const Scene& scene, const glm::dmat3& rotation, double scale, Vec3 offset);

} // namespace meninas::test
