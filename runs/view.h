// One view of a scene: the picture, and what it says about itself, whichever command asks for it.
//
// Pass one does not know the view:
// a LitScene serves any number of them, from any number of threads.
#pragma once

#include "image/image_file.h"
#include "runs/run_events.h"
#include "runs/run_settings.h"
#include "runs/report/picture_units.h"
#include "runs/report/stats.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace meninas {

/// A scene with its diffuse light, as far as pass one finds it.
struct LitScene {
  std::shared_ptr<const PreparedScene> prepared;
  IrradianceField field;
};

/// Pass one, run now; the figures of its stages are filled in, its warnings said.
/// `kept`, if given, is written: a solution file that `read_lit_scene` takes.
LitScene solve_lit_scene(Scene scene, const PassOneSettings& settings,
                         const std::optional<std::filesystem::path>& kept, const RunEvents& events,
                         RunFigures& figures);

/// Whether the light of lamps is wanted as well.
enum class LampsApart { no, yes, if_known };

/// Pass one of an earlier run, whose figures are repeated.
/// Throws InputError when the file is damaged or belongs to another scene or version, or has no
/// lamps apart where they are wanted.
LitScene read_lit_scene(const std::filesystem::path& solution, Scene scene,
                        PassOneSettings settings, const RunEvents& events, RunFigures& figures,
                        LampsApart lamps = LampsApart::no);

/// The same with lamps as bright as the settings say. Precondition: lamps are known apart.
LitScene under_lamps(const LitScene& lit, const RunSettings& settings);

/// A picture and what it is:
/// the same bits belong to the same attributes, whether pass one was run or read.
struct ViewPicture {
  Image image;
  SampleCounts samples;
  ShownPixels edges; ///< of a PNG
  std::vector<ShownPixels> likely_edges; ///< Rendering::likely_edges
  std::vector<Layer> layers;
  Attributes attributes;
  std::string_view unit = unit_of_radiance; ///< of the image
  std::shared_ptr<const IrradianceField> finer = nullptr; ///< Rendering::finer
};

/// The picture that the two passes have rendered, with the attributes of this view.
ViewPicture picture_of(const Scene& scene, const Camera& camera, const RunSettings& settings,
                       Rendering rendering);

/// The settings as far as a preset leaves them to this field and its scene (run_settings.h).
RunSettings settled(const RunSettings& settings, const IrradianceField& field);

/// Pass two, or the view for those who debug, with settled settings. Settings of pass one are not heeded,
/// but by the view `closure`; layers need a field that knows its mirrored part.
ViewPicture render_view(const LitScene& lit, const Camera& camera, PictureSize size,
                        const RunSettings& asked, const RunEvents& events, RunFigures& figures);

/// A layer `lamp.NAME` of the light of each lamp, as bright as the settings say, and their sum in
/// floats, in this order, for picture. Precondition: lamps are known apart.
ViewPicture render_lamp_layers(const LitScene& lit, const Camera& camera, PictureSize size,
                               const RunSettings& settings, const RunEvents& events,
                               RunFigures& figures);

/// By the path tracer; the layer `variance` comes last.
ViewPicture render_reference_view(Scene scene, const Camera& camera, PictureSize size,
                                  const RunSettings& settings, const RunEvents& events,
                                  RunFigures& figures);

} // namespace meninas
