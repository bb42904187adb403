#include "runs/snapshots.h"

#include "image/display.h"
#include "image/whole_file.h"

#include <fmt/format.h>

#include <set>

namespace meninas {
namespace {

namespace fs = std::filesystem;

class SnapshotWriter {
public:
  SnapshotWriter(const SnapshotRequest& request, const PreparedScene& prepared,
                 const Camera& camera, RenderSettings render, const std::vector<fs::path>& like,
                 const PictureSettings& settings)
      : folder_(request.folder), prepared_(prepared), camera_(camera), render_(render),
        settings_(settings) {
    render_.layers = WithLayers::no; // of an average nothing is known but the sum
    render_.diffuse.term = DiffuseTerm::interpolated; // light on its way is as soft as it is
    for (const fs::path& file : like) {
      const PictureFormat format = picture_format(file);
      extensions_.insert(format == PictureFormat::exr   ? ".exr"
                         : format == PictureFormat::hdr ? ".hdr"
                                                        : ".png");
    }
  }

  void operator()(const PassOneSoFar& state) {
    VertexIrradiance lit = state.field;
    for (auto* irradiances : {&lit.irradiance, &lit.indirect}) {
      for (glm::vec3& irradiance : *irradiances) {
        irradiance += glm::vec3(state.ambient);
      }
    }
    const Rendering with_ambient = picture(lit);
    if (!settings_.exposure) {
      settings_.exposure = automatic_exposure(with_ambient.image);
      if (render_.display)
        render_.display->exposure = settings_.exposure;
    }
    const std::string name = fmt::format("shots-{:06}", state.shots);
    write(name + "-ambient", with_ambient, state.shots);
    write(name, picture(state.field), state.shots);
  }

private:
  Rendering picture(const VertexIrradiance& values) const {
    return render({values, prepared_.light()}, camera_, render_);
  }
  void write(const std::string& name, const Rendering& shown, int shots) const {
    std::vector<fs::path> files;
    for (const std::string& extension : extensions_) {
      files.push_back(folder_ / (name + extension));
    }
    write_pictures(files, {shown.image, {}, &shown.edges}, settings_,
                   {{"shots", std::to_string(shots)}}, {});
  }

  fs::path folder_;
  const PreparedScene& prepared_;
  const Camera& camera_;
  RenderSettings render_;
  PictureSettings settings_;
  std::set<std::string> extensions_;
};

} // namespace

void prepare_snapshots(const SnapshotRequest& request) {
  make_folder(request.folder);
  check_writable_file(request.folder / "shots-000000.png");
}

PassOneWatch snapshot_watch(const SnapshotRequest& request, const PreparedScene& prepared,
                            const Camera& camera, const RenderSettings& render,
                            const std::vector<fs::path>& like, const PictureSettings& settings) {
  return {request.every, SnapshotWriter(request, prepared, camera, render, like, settings)};
}

} // namespace meninas
