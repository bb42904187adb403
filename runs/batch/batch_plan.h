// The plan of a batch: its jobs taken apart into single pictures, each with its scene, camera and settings.
//
// Pictures are in the order of jobs, scenes, times, cameras, frames and modes:
// the same for every process that reads the same files.
//
// A scene at a time of its animations is a scene of its own, known by its content: where cameras
// alone move, all times have one content and one solution.
#pragma once

#include "runs/batch/batch_file.h"
#include "runs/steering/memory.h"

#include <cstdint>

namespace meninas {

/// The facts about a scene that have to be known before it is rendered.
struct SceneFacts {
  std::uint64_t hash = 0; ///< of everything light depends on, content_hash
  std::vector<Camera> cameras;
  Bounds bounds;
  SceneSizes sizes;
};
SceneFacts facts_of(const Scene& scene);

/// Why something cannot even be begun.
struct BatchProblem {
  std::string what; ///< FILE: WHERE: WHAT
  int exit_code = 0;
};

struct BatchPicture {
  std::size_t number = 0; ///< place in the batch, from 0
  std::string name; ///< of its first output, for people; of job and scene where there is a problem
  std::string job, mode;
  std::filesystem::path scene;
  std::shared_ptr<const SceneFacts> facts;
  Camera camera;
  int frame = 0;
  PictureSize size;
  RenderRequest request;                      ///< without files
  std::vector<std::filesystem::path> outputs; ///< relative to the batch's folder
  std::string
      key; ///< a hash of all that its outputs depend on: scene, camera, settings, their names, the program's version
  std::string solution_key; ///< of all that pass one depends on; empty where there is none
  std::optional<BatchProblem> problem; ///< a scene that cannot be read, a camera it does not have
};

/// Reads every scene once in each of its states.
/// Throws InputError, at the job's place, when two pictures would be one file.
std::vector<BatchPicture> plan_batch(const std::filesystem::path& file,
                                     const std::vector<BatchJob>& jobs,
                                     const GltfSettings& gltf = {});

/// Pictures by their numbers, both ends among them.
struct NumberRange {
  std::size_t first = 0, last = 0;
};

/// The pictures of some numbers; all where none are given, each once, in the batch's order.
/// Throws UsageError for a number that no picture has.
std::vector<BatchPicture> pictures_of(std::vector<BatchPicture> pictures,
                                      const std::vector<NumberRange>& only);

/// Part `number` of `count`, from 0: neighbours stay together, so that few parts need the same scene.
struct Shard {
  int number = 0, count = 1;
};
std::vector<BatchPicture> pictures_of(std::vector<BatchPicture> pictures, const Shard& shard);

} // namespace meninas
