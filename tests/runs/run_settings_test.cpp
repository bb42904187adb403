#include "runs/run_settings.h"
#include "raytrace/two_pass.h"
#include "runs/steering/setting_options.h"
#include "tests/support/rooms.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace meninas::test {
namespace {

RunSettings with_quality(Quality quality) {
  RunSettings settings;
  settings.quality = quality;
  return settings;
}

// Drafts interpolate; others have direct light as fine as pixels, unless they are told otherwise.
TEST(DiffuseTerm, IsThePresets) {
  EXPECT_EQ(diffuse_term(with_quality(Quality::draft)), DiffuseTerm::interpolated);
  EXPECT_EQ(diffuse_term(with_quality(Quality::normal)), DiffuseTerm::direct);
  EXPECT_EQ(diffuse_term(with_quality(Quality::fine)), DiffuseTerm::direct);
  EXPECT_EQ(two_pass_settings(with_quality(Quality::fine)).render.diffuse.term,
            DiffuseTerm::direct);
}

TEST(DiffuseTerm, IsWhatIsAskedFor) {
  RunSettings settings = with_quality(Quality::fine);
  settings.diffuse = DiffuseTerm::interpolated;
  EXPECT_EQ(diffuse_term(settings), DiffuseTerm::interpolated);
  settings.quality = Quality::draft;
  settings.diffuse = DiffuseTerm::gather;
  EXPECT_EQ(diffuse_term(settings), DiffuseTerm::gather);
}

// Pass one alone is Gouraud shading,
// and a field that does not tell light of emitters apart knows nothing else.
TEST(DiffuseTerm, IsInterpolatedWherePassOneIsAllThereIs) {
  RunSettings settings = with_quality(Quality::fine);
  settings.mode = PictureMode::radiosity;
  EXPECT_EQ(diffuse_term(settings), DiffuseTerm::interpolated);

  settings = with_quality(Quality::fine);
  settings.form_factors = FormFactorMethod::analytic;
  EXPECT_EQ(diffuse_term(settings), DiffuseTerm::direct);
  settings.interpolation = Interpolation::average;
  EXPECT_EQ(diffuse_term(settings), DiffuseTerm::interpolated);
}

// Where small surfaces make up the mesh a draft, too, finds direct light where it is seen; it is told otherwise as ever.
TEST(DiffuseTerm, IsDirectWhereTheMeshIsFinerThanPicturesNeed) {
  Scene scene;
  const Material wall = diffuse(0.5);
  add_room(scene, Point3(0.0), Point3(1.0), {wall, wall, wall, wall, wall, wall});
  const auto prepared = prepare_scene(std::move(scene), {});
  LightScene coarse = *prepared->light(), fine = *prepared->light();
  coarse.finely_tessellated = false;
  fine.finely_tessellated = true;
  const auto term = [](const RunSettings& settings) { return diffuse_term(settings); };
  RunSettings draft = with_quality(Quality::draft);
  EXPECT_EQ(term(settled(draft, coarse)), DiffuseTerm::interpolated);
  EXPECT_EQ(term(settled(draft, fine)), DiffuseTerm::direct);
  EXPECT_EQ(term(settled(draft, fine, false)), DiffuseTerm::interpolated);
  EXPECT_EQ(term(settled(with_quality(Quality::normal), coarse, false)), DiffuseTerm::interpolated);
  draft.mode = PictureMode::radiosity;
  EXPECT_EQ(term(settled(draft, fine)), DiffuseTerm::interpolated);
  draft = with_quality(Quality::draft);
  draft.diffuse = DiffuseTerm::interpolated;
  EXPECT_EQ(term(settled(draft, fine)), DiffuseTerm::interpolated);
}

// A number of samples alone is that of every pixel.
TEST(Samples, AreAdaptiveUnlessTheirNumberIsAskedFor) {
  const auto render_of = [](const RunSettings& settings) { return two_pass_settings(settings).render; };
  EXPECT_EQ(render_of(with_quality(Quality::draft)).pixel_error, 0.0);
  for (const Quality quality : {Quality::normal, Quality::fine}) {
    RunSettings settings = with_quality(quality);
    const RenderSettings preset = render_of(settings);
    EXPECT_GT(preset.pixel_error, 0.0);
    EXPECT_EQ(preset.samples, 16 * preset.min_samples);
    settings.samples = 32;
    EXPECT_EQ(render_of(settings).samples, 32);
    EXPECT_EQ(render_of(settings).pixel_error, 0.0);
    settings.samples.reset();
    settings.pixel_error = 0.3;
    EXPECT_EQ(render_of(settings).samples, preset.samples);
    EXPECT_EQ(render_of(settings).pixel_error, 0.3);
    EXPECT_EQ(render_of(settings).min_samples, RenderSettings{}.min_samples) << "as few as the pixel needs";
  }
}

TEST(Elements, AreThePresetsUnlessTheyAreAskedFor) {
  const auto wanted = [](const RunSettings& settings) {
    return two_pass_settings(settings).pass_one.mesh.target_elements;
  };
  RunSettings settings = with_quality(Quality::draft);
  EXPECT_EQ(wanted(settings), 4500.0);
  settings.elements = 5000;
  EXPECT_EQ(wanted(settings), 5000.0);
  settings.form_factors = FormFactorMethod::analytic;
  EXPECT_EQ(wanted(settings), 5000.0) << "the user's word, however long it takes";
}

// Worlds behind two panes, each of which reflects a sixth: a draft leaves them to rays.
TEST(MirrorWorlds, OfADraftBringMoreThanItsNoise) {
  const Scene scene = facing_mirrors(Rgb(0.17));
  const auto depth_at = [&](Quality quality) {
    const PlanSettings plan = two_pass_settings(with_quality(quality)).pass_one.plan;
    int depth = 0;
    for (const MirrorWorld& world : plan_transport(scene, find_surfaces(scene), plan).worlds.worlds)
      depth = std::max(depth, world.depth);
    return depth;
  };
  EXPECT_EQ(depth_at(Quality::draft), 1) << "0.17^2 = 0.029 is below 0.03";
  EXPECT_EQ(depth_at(Quality::normal), 2) << "0.17^3 = 0.005 is below 0.01";
  EXPECT_EQ(depth_at(Quality::fine), 2);
}

// The options of a run are those that differ from what its preset does.
TEST(OptionsOf, SayTheDiffuseTermWhereThePresetDoesNot) {
  const auto said = [](const RunSettings& settings) {
    const std::vector<std::string> options = options_of(settings);
    const auto at = std::ranges::find(options, "--diffuse");
    return at == options.end() ? std::string() : *std::next(at);
  };
  RunSettings settings = with_quality(Quality::fine);
  EXPECT_EQ(said(settings), "");
  settings.diffuse = DiffuseTerm::direct;
  EXPECT_EQ(said(settings), "");
  settings.diffuse = DiffuseTerm::interpolated;
  EXPECT_EQ(said(settings), "interpolated");
  settings.quality = Quality::draft;
  EXPECT_EQ(said(settings), "");
  settings.diffuse = DiffuseTerm::direct;
  EXPECT_EQ(said(settings), "direct");
}

} // namespace
} // namespace meninas::test
