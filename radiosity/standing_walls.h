// Finer elements where a wall without thickness, or with little, stands across them.
//
// An element has one radiosity. Where a sheet stands across it, lit on one side and dark
// on the other, its dark part shines with the mean of both: light leaks past the sheet.
// Of an element of size h and radiosity B on the lit side a strip of width w in the dark sends
//
//   w (h - w) / h B  <=  h B / 4     W per metre of the sheet.
//
// The bound falls with h, so what a wall crosses is divided up to three times, which leaves
// an eighth of it (Baum, Mann, Smith and Winget 1991 cut polygons where others meet them).
//
// What stands there is found by lines a little above a side,
// eight to an undivided element both ways: faces with two lit sides,
// and bodies no thicker than half an element, which a line enters by a front and leaves by a back.
// They count where they leave on either side more than a strip of h / 32, h the undivided size.
// A wall crosses an element when it does, of both ways together,
// as many lines as go one way (of triangles half): it parts the element in two or nearly so,
// as the legs of a chair do not. Glass is no wall; holes are passed.
//
// Limits: where a wall ends within an element, that one is left, as light goes round it;
// so are sides whose elements are smaller than half of the wanted size.
// A division that would make more than twice the elements there were, and 2,000 more, is left out.
#pragma once

#include "radiosity/element_mesh.h"
#include "scenes/ray_scene.h"

namespace meninas {

/// The same mesh, to the bit, where nothing stands across its elements.
ElementMesh divide_under_walls(ElementMesh mesh, const Scene& scene, const SurfaceModel& surfaces,
                               const RayScene& rays, const DarkSides& dark,
                               const MeshSettings& settings = {});

} // namespace meninas
