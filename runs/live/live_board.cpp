#include "runs/live/live_board.h"

#include "runs/walk/packed_numbers.h"
#include "runs/walk/walk_lamps.h"
#include "runs/walk/walk_page.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace meninas {

namespace {

constexpr std::size_t kept_states = 4;

nlohmann::json array_of(const Vec3& x) { return nlohmann::json::array({x.x, x.y, x.z}); }

/// The room's scale as long as halves hold the light well by it; else one of its own.
float scale_for(std::span<const glm::vec3> irradiance, float before) {
  constexpr float faintest = 512.0F, brightest = 60000.0F;
  float most = 0.0F;
  for (const glm::vec3& value : irradiance)
    most = std::max(most, largest(value));
  const bool fits = most == 0.0F || (most >= faintest * before && most <= brightest * before);
  return fits ? before : scale_of_halves(irradiance);
}

double shown_top(std::vector<glm::vec3> irradiance, const Rgb& ambient) {
  for (glm::vec3& value : irradiance)
    value += glm::vec3(ambient);
  return top_irradiance(irradiance);
}

std::string text_of(const nlohmann::json& object) {
  return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

} // namespace

std::shared_ptr<LiveBoard::State> LiveBoard::state_of(const LiveLight& light, std::optional<float> scale_before) {
  auto state = std::make_shared<State>();
  state->scale = scale_before ? scale_for(light.irradiance, *scale_before) : scale_of_halves(light.irradiance);
  state->top = shown_top(light.irradiance, light.ambient);
  state->ambient = light.ambient;
  state->halves.reserve(3 * light.irradiance.size());
  for (const glm::vec3& value : light.irradiance)
    for (int band = 0; band < 3; ++band)
      state->halves.push_back(static_cast<std::uint16_t>(half_bits(value[band] / state->scale)));
  return state;
}

void LiveBoard::changed(const StatusChange& change) {
  if (change)
    change(status_);
  ++version_;
  news_.notify_all();
}

void LiveBoard::show_room(std::string data, const Point3& middle, const LiveLight& light, ShownMesh mesh, const StatusChange& change) {
  const auto state = state_of(light, std::nullopt);
  state->number = state_number_ + 1; // nobody else writes
  const nlohmann::json head{{"room", room_number_ + 1},
                  {"state", state->number},
                  {"ambient", array_of(light.ambient)},
                  {"middle", array_of(middle)}};
  std::string text = text_of(head);
  text.back() = ','; // in place of its brace
  auto room = std::make_shared<const std::string>(std::move(text) + "\"data\":" + std::move(data) + "}");

  // Rooms may be large: this one is joined before readers wait, and the one before goes when they no longer do.
  decltype(states_) states_before;
  std::shared_ptr<const std::string> room_before;
  std::shared_ptr<const ShownMesh> mesh_before;
  const std::scoped_lock lock(mutex_);
  states_before.swap(states_);
  room_before.swap(room_);
  mesh_before.swap(mesh_);
  ++room_number_;
  ++state_number_;
  states_.push_back(state);
  room_ = std::move(room);
  mesh.room = room_number_;
  mesh_ = std::make_shared<const ShownMesh>(std::move(mesh));
  changed(change);
}

void LiveBoard::show_light(const LiveLight& light, const StatusChange& change) {
  std::optional<float> scale;
  if (const std::scoped_lock lock(mutex_); !states_.empty())
    scale = states_.back()->scale;
  const auto state = state_of(light, scale); // nobody waits for that
  const std::scoped_lock lock(mutex_);
  state->number = ++state_number_;
  states_.push_back(state);
  if (states_.size() > kept_states)
    states_.pop_front();
  changed(change);
}

void LiveBoard::change_status(const StatusChange& change) {
  const std::scoped_lock lock(mutex_);
  changed(change);
}

LiveStatus LiveBoard::status() const {
  const std::scoped_lock lock(mutex_);
  return status_;
}

std::string LiveBoard::announcement() const {
  const auto known = [](const auto& value) { return value ? nlohmann::json(*value) : nlohmann::json(nullptr); };
  return text_of({{"room", room_number_},
                  {"state", states_.empty() ? 0 : states_.back()->number},
                  {"stage", status_.stage},
                  {"done", status_.done},
                  {"secondsLeft", known(status_.seconds_left)},
                  {"seconds", status_.seconds},
                  {"shots", status_.shots},
                  {"unshot", known(status_.unshot)},
                  {"error", known(status_.error)},
                  {"elements", status_.elements},
                  {"paused", status_.paused},
                  {"gathers", status_.gathers},
                  {"solved", status_.solved},
                  {"keepsRows", status_.keeps_rows},
                  {"relit", status_.is_relit},
                  {"problem", status_.problem}});
}

std::optional<std::string> LiveBoard::next(std::uint64_t& seen, std::chrono::milliseconds patience) const {
  std::unique_lock lock(mutex_);
  if (!news_.wait_for(lock, patience, [&] { return version_ != seen; }))
    return std::nullopt;
  seen = version_;
  return announcement();
}

std::shared_ptr<const std::string> LiveBoard::room() const {
  const std::scoped_lock lock(mutex_);
  return room_;
}

std::shared_ptr<const ShownMesh> LiveBoard::mesh() const {
  const std::scoped_lock lock(mutex_);
  return mesh_;
}

std::shared_ptr<const std::string> LiveBoard::light(std::uint64_t base) const {
  std::shared_ptr<const State> newest, before;
  std::uint64_t room = 0;
  {
    const std::scoped_lock lock(mutex_);
    if (states_.empty())
      return nullptr;
    newest = states_.back();
    room = room_number_;
    const auto known = std::ranges::find(states_, base, [](const auto& state) { return state->number; });
    if (known != states_.end() && (*known)->scale == newest->scale)
      before = *known;
  }
  std::vector<std::uint32_t> bits(newest->halves.begin(), newest->halves.end());
  for (std::size_t k = 0; before && k < bits.size(); ++k)
    bits[k] -= before->halves[k];
  PackedNumbers packed;
  add_table(packed, "irradiance", bits, 3);
  const PackedTable& table = packed.tables.front();
  const std::string head = text_of({{"room", room},
                                    {"state", newest->number},
                                    {"base", before ? before->number : 0},
                                    {"scale", newest->scale},
                                    {"top", newest->top},
                                    {"ambient", array_of(newest->ambient)},
                                    {"rows", table.rows},
                                    {"columns", table.columns},
                                    {"bytes", table.bytes_each}});
  const std::vector<std::byte> body = deflated(packed.bytes, PackedSize::quick);
  return std::make_shared<const std::string>(joined_message(head, body));
}

std::string joined_message(const std::string& head, const std::vector<std::byte>& body) {
  std::string text;
  for (unsigned k = 0; k < 4; ++k)
    text += static_cast<char>(head.size() >> (8 * k) & 0xffU);
  text += head;
  text.append(reinterpret_cast<const char*>(body.data()), body.size());
  return text;
}

} // namespace meninas
