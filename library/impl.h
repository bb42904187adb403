// What the handles of meninas.h stand for, and how calls go in and out of the library: settings by
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
  Scene scene;
};

struct RoomPicture::Impl {
  ViewPicture picture;
  PictureSettings shown; ///< what the settings said of files
  std::string stats;
};

struct RoomSolution::Impl {
  std::shared_ptr<const Room::Impl> room;
  std::shared_ptr<const PreparedScene> prepared;
  RadiositySolution solution; ///< its field is that of the solution
  MeshSettings mesh;
  PassOneSettings settings;
  RunFigures figures;
  std::vector<float> vertices;
  std::vector<std::uint32_t> elements, nodes;
};

struct RoomFactors::Impl {
  std::shared_ptr<const Room::Impl> room;
  FormFactors factors;
  SolverSettings solver;
  std::vector<float> centre, normal;
  std::vector<double> area, reflectance, emission;
  std::vector<std::uint32_t> nodes;
};

/// A call with its settings: those of the room and its own, which go over them by name.
struct Call {
  RenderRequest request;
  std::optional<LampGrouping> by_lamp; ///< of a solution
};
/// Throws UsageError; of what only a room can say, `loaded` is what it said.
Call call_of(const Room::Impl& room, const Settings& settings);

/// Throws UsageError where a call wants the file read in another way than the room has.
void check_reading(const Room::Impl& room, const RunSettings& settings);

/// The listener as runs know it. What it throws, and Cancelled where it says so, ends the work.
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
