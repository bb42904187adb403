// The objects behind the handles of meninas.h, and the conversions at the library's border: settings by
// the parser of the command line, events to a listener, and exceptions as Error.
#pragma once

#include "library/meninas.h"

#include "raytrace/two_pass.h"
#include "runs/render_run.h"
#include "runs/steering/memory.h"

#include <optional>

namespace meninas {

struct Room::Impl {
  std::filesystem::path file;
  Settings settings;   ///< of all calls
  RunSettings loaded;  ///< with which the file was read
  Scene scene;         ///< without the warnings that were told
  std::vector<std::string> told; ///< these
  double seconds = 0.0; ///< that reading took
};

struct RoomPicture::Impl {
  ViewPicture picture;
  Encoding encoding = Encoding::linear; ///< of the file that it was read from
  PictureSettings shown; ///< what the settings said of files
  std::string stats;
  std::vector<std::filesystem::path> inputs; ///< files that it comes of
};

struct RoomSolution::Impl {
  std::shared_ptr<const Room::Impl> room;
  std::shared_ptr<const PreparedScene> prepared;
  RadiositySolution solution; ///< its field is that of the solution
  MeshSettings mesh;
  PassOneSettings settings;
  bool is_relit = false; ///< and so does not know its lamps
  RunFigures figures;
  std::vector<float> vertices;
  std::vector<std::uint32_t> elements, nodes;
};

struct RoomFactors::Impl {
  std::shared_ptr<const Room::Impl> room;
  Settings settings; ///< of the call
  FormFactors factors;
  std::vector<float> centre, normal;
  std::vector<double> area, reflectance, emission;
  std::vector<std::uint32_t> nodes;
};

/// A call with its settings: those of the room and its own, which go over them by name.
struct Call {
  RenderRequest request;
  std::optional<LampGrouping> by_lamp; ///< of a solution
};

/// The kind of a call. Its own settings that have no effect there are refused; those of its room are ignored.
enum class CallKind { room, plan, picture, solution, picture_of_solution, form_factors, solve_rows };

/// Throws UsageError; also where a call wants the file read in another way than the room has.
Call call_of(const Room::Impl& room, const Settings& settings, CallKind kind);

/// The settings, of which some stand for others with the same name further ahead.
Settings merged(const Settings& before, const Settings& after);

/// The settings for writing a file of pixels: the new ones over those before.
PictureSettings picture_settings(PictureSettings before, const Settings& settings);

/// The scene with lamps as bright as the call says, and the files it has been read from.
Scene scene_under_lamps(const Room::Impl& room, const RunSettings& settings);
std::vector<std::filesystem::path> files_of(const Room::Impl& room);

/// The listener as runs know it. Its exceptions, and Cancelled where it asks for that, end the work.
RunEvents events_of(const Listener& listener);
struct Cancelled {};

/// Elements as the API has them: four vertices and a node each.
void describe_elements(const ElementMesh& mesh, std::vector<std::uint32_t>* corners,
                       std::vector<std::uint32_t>& nodes);

/// Throws what is being handled as an Error. To be called where an exception was caught.
[[noreturn]] void throw_error();

/// The outcome of a call, of which all that goes wrong is an Error.
template <typename Work>
auto guarded(const Work& work) -> decltype(work()) {
  try {
    return work();
  } catch (...) {
    throw_error();
  }
}

/// Three numbers for each colour or point, as the API has them.
template <typename To, typename From>
std::vector<To> flat(const std::vector<From>& values) {
  std::vector<To> result;
  result.reserve(3 * values.size());
  for (const From& value : values)
    for (int c = 0; c < 3; ++c)
      result.push_back(static_cast<To>(value[c]));
  return result;
}

/// Pixels as they lie in memory.
inline std::span<const float> floats_of(const std::vector<glm::vec3>& values) {
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  return {values.empty() ? nullptr : &values.front().x, 3 * values.size()};
}

} // namespace meninas
