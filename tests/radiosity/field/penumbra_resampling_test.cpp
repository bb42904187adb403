// Vertices at the edges of penumbrae: no specks where few samples have missed what is hidden.
#include "radiosity/field/final_gathering.h"
#include "form_factors/point_form_factor.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/rooms.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

namespace meninas::test {
namespace {

const std::vector<Point3> lamp_corners{
    {-0.25, 2, -0.25}, {0.25, 2, -0.25}, {0.25, 2, 0.25}, {-0.25, 2, 0.25}};

/// A floor, lamps of half a metre two metres above it, a metre apart, and a board below the first.
std::unique_ptr<LitScene> shaded_floor(int lamps = 1) {
  Scene scene;
  add_polygon(scene, "floor", {{-2, 0, -2}, {-2, 0, 2}, {2, 0, 2}, {2, 0, -2}}, diffuse(0.5));
  for (int k = 0; k < lamps; ++k) {
    std::vector<Point3> corners = lamp_corners;
    for (Point3& corner : corners)
      corner.x += k;
    add_polygon(scene, "lamp", corners, diffuse(0.0, 10.0));
  }
  add_polygon(scene, "board", {{-0.4, 1, -0.3}, {0.5, 1, -0.4}, {0.4, 1, 0.5}, {-0.5, 1, 0.3}},
              diffuse(0.0));
  return lit(std::move(scene), {.element_size = 0.08});
}

/// Direct light at all vertices.
VertexSamples lit_vertices(const LitScene& l) {
  const FormFactorSettings form_factors;
  const DirectSettings direct;
  const InterpolationSettings interpolation;
  const std::vector<Rgb> dark(element_count(l.mesh), Rgb(0.0)), bright(dark.size(), Rgb(1.0));
  const PointGathering gathering =
      gathering_from(*l.light, dark, {form_factors, direct, interpolation, {}});
  PointWorkspaces workspaces;
  VertexSamples found = make_samples(l.mesh);
  light_vertices({bright, gathering, workspaces}, 0, found);
  return found;
}

// Of 16 even samples all arrive where up to a sixteenth of the lamp is hidden, or none where so
// much is seen. Beside edges vertices take 128, which a 32nd does not escape: four of them meet it.
TEST(PenumbraVertices, NoneOverlooksWhatThoseBesideItSee) {
  const auto l = shaded_floor();
  const VertexSamples found = lit_vertices(*l);
  const DirectSettings many{.shadow_rays = 1024, .penumbra_rays = 1024};
  DirectWorkspace work;
  std::size_t in_part = 0, followed = 0;
  for (std::size_t v = 0; v < found.states.size(); ++v) {
    const Receiver& at = found.receivers[v];
    if (l->mesh.side_of_element[index(l->mesh.element_of_vertex[v])] != SideId{0})
      continue;
    const double whole =
        l->light->emitters[0].radiosity.g * point_form_factor(at.position, at.normal, lamp_corners);
    const double truth = direct_irradiance(*l->light, at, many, 1, work).total.g;
    const double here = found.field.irradiance[v].g;
    EXPECT_FALSE(here > (1.0 - 1e-6) * whole && truth < (1.0 - 1.0 / 32.0) * whole) << v;
    EXPECT_FALSE(here == 0.0 && truth > whole / 32.0) << v;
    in_part += found.seen[v] == Visibility::partial ? 1 : 0;
    followed += found.seen[v] == Visibility::confirmed ? 1 : 0;
  }
  // A ring of vertices lies around the penumbra, which is a few elements wide.
  EXPECT_GT(in_part, followed);
  EXPECT_GT(followed, in_part / 5);
}

// Where one of two lamps is seen in part both take all samples: a sixteenth of the other may be
// hidden, too. How many that are depends on what has arrived, on which few samples and many differ.
TEST(PenumbraVertices, TakeAllSamplesOfAllImages) {
  const auto l = shaded_floor(2);
  const auto at = [&](const Receiver& receiver, PenumbraSamples samples) {
    DirectWorkspace work;
    return direct_irradiance(*l->light, receiver, {.penumbra_samples = samples}, 1, work);
  };
  double own = 0.0, together = 0.0; // the largest difference from all samples everywhere
  const VertexSamples field = make_samples(l->mesh);
  for (const Receiver& receiver : field.receivers) {
    const ArrivingLight light = at(receiver, PenumbraSamples::together);
    if (!light.in_part)
      continue;
    const double all = at(receiver, PenumbraSamples::everywhere).total.g;
    own = std::max(own, std::abs(at(receiver, PenumbraSamples::own).total.g / all - 1.0));
    together = std::max(together, std::abs(light.total.g / all - 1.0));
  }
  EXPECT_GT(own, 1.0 / 64.0);
  EXPECT_LT(together, 1.0 / 128.0);
}

// The same samples in the same vertices, whoever finds them.
TEST(PenumbraVertices, SameBitsForAnyNumberOfThreads) {
  const auto l = shaded_floor();
  const VertexSamples all = lit_vertices(*l);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const VertexSamples alone = lit_vertices(*l);
  EXPECT_EQ(all.field.irradiance, alone.field.irradiance);
  EXPECT_EQ(all.seen, alone.seen);
}

} // namespace
} // namespace meninas::test
