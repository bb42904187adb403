// The newest state of a room that is being solved, for any number of readers: the room, its light, and the
// progress of the work.
//
// A room is sent once, its light by changes. Light is irradiance H, W/m^2, at the vertices of the room, without the
// ambient term, as halves h times a scale of the room's,
//
//   H = scale h,     error 2^-11 of each channel
//
// and a change of it is the difference of the bits of h since a state that the reader has, packed as
// walk/packed_numbers.h says: where nothing has changed it is next to nothing. A few states are kept to differ
// from; whoever has an older one gets all of it.
#pragma once

#include "radiosity/scene/light_scene.h"
#include "radiosity/transport/form_factor_rows.h"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace meninas {

/// The progress of the work.
struct LiveStatus {
  std::string stage;
  double done = 0.0;                  ///< of the stage that is shown, 0 to 1
  std::optional<double> seconds_left; ///< until the solution is there
  double seconds = 0.0;               ///< since the scene was read
  int shots = 0;
  std::optional<double> unshot; ///< the share of the first light that is still to be shot
  std::optional<double> error;  ///< ||B - B_k|| / ||B||, at the most
  std::size_t elements = 0;
  bool paused = false; ///< no shot is made without a step
  bool gathers = false; ///< shots are sweeps
  bool solved = false;
  bool keeps_rows = false; ///< under other light alone it is relit
  bool is_relit = false;   ///< it was shown by kept rows, before it was solved anew
  std::string problem; ///< why the file is not shown as it is now
};

/// The light of one moment.
struct LiveLight {
  std::vector<glm::vec3> irradiance; ///< by vertex of the room, without the ambient term
  Rgb ambient{0.0};                  ///< irradiance that light still to be shot would bring, everywhere
};

/// The mesh that is shown, for who asks of its elements.
struct ShownMesh {
  std::shared_ptr<const LightScene> light;
  std::vector<ElementId> elements; ///< by element of the page (walk_room.h)
  FormFactorSettings form_factors;
  std::uint64_t room = 0; ///< which room it is of
};

using StatusChange = std::function<void(LiveStatus&)>;

/// One writes; any number read.
class LiveBoard {
public:
  /// Another room: the JSON of walk_page_data(), in whose coordinates `middle` is 0, with its light. `change` is told
  /// with it, not before, and may not ask the board.
  void show_room(std::string data, const Point3& middle, const LiveLight& light, ShownMesh mesh = {}, const StatusChange& change = {});
  /// Other light of that room.
  void show_light(const LiveLight& light, const StatusChange& change = {});
  void change_status(const StatusChange& change);
  LiveStatus status() const;

  /// JSON of what there is, once it is newer than `seen`; nothing where it is not after so long.
  std::optional<std::string> next(std::uint64_t& seen, std::chrono::milliseconds patience) const;
  /// JSON of the room; null before there is one.
  std::shared_ptr<const std::string> room() const;
  /// The mesh of that room's elements; null before there is one.
  std::shared_ptr<const ShownMesh> mesh() const;
  /// The newest light, as joined_message(): bits, or their differences since the state `base`. Null before there is a
  /// room.
  std::shared_ptr<const std::string> light(std::uint64_t base) const;

private:
  struct State {
    std::uint64_t number = 0;
    float scale = 1.0F;
    double top = 1.0;
    Rgb ambient{0.0};
    std::vector<std::uint16_t> halves;
  };
  static std::shared_ptr<State> state_of(const LiveLight& light, std::optional<float> scale_before);
  std::string announcement() const;
  void changed(const StatusChange& change);

  mutable std::mutex mutex_;
  mutable std::condition_variable news_;
  std::uint64_t version_ = 0, room_number_ = 0, state_number_ = 0;
  std::shared_ptr<const std::string> room_;
  std::shared_ptr<const ShownMesh> mesh_;
  std::deque<std::shared_ptr<const State>> states_; ///< of this room, newest last
  LiveStatus status_;
};

/// Four bytes with the length of some JSON, lowest first, that, and a deflated table.
std::string joined_message(const std::string& head, const std::vector<std::byte>& body);

} // namespace meninas
