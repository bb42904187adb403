#include "runs/live/live_answers.h"

#include "radiosity/solution/solution_file.h"
#include "runs/pages/view_page.h"
#include "runs/report/page.h"
#include "scenes/errors.h"

#include <charconv>
#include <cmath>

namespace meninas {

namespace {

using Query = std::map<std::string, std::string>;

WebReply text_reply(int status, const std::string& type, std::string text) {
  return {status, type, std::make_shared<const std::string>(std::move(text))};
}
WebReply bytes_reply(const std::string& type, const std::vector<std::byte>& bytes) {
  return text_reply(200, type, std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}
WebReply shared_reply(const std::string& type, std::shared_ptr<const std::string> body) {
  return body ? WebReply{200, type, std::move(body)} : WebReply{204, "", nullptr};
}

std::string value_in(const Query& query, const std::string& name) {
  const auto place = query.find(name);
  return place == query.end() ? "" : place->second;
}

template <typename Number>
std::optional<Number> number_in(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    return std::nullopt;
  if constexpr (std::is_floating_point_v<Number>)
    if (!std::isfinite(value))
      return std::nullopt;
  return value;
}

/// Numbers with this between them, as many as are asked for.
template <typename Number>
std::vector<Number> numbers_in(std::string_view text, char between, std::size_t count) {
  std::vector<Number> numbers;
  while (numbers.size() < count) {
    const auto end = std::min(text.find(between), text.size());
    const auto number = number_in<Number>(text.substr(0, end));
    if (!number || (end == text.size()) != (numbers.size() + 1 == count))
      return {};
    numbers.push_back(*number);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return numbers;
}

bool take_place(const Query& query, RestingView& view) {
  if (const auto camera = query.find("camera"); camera != query.end()) {
    view.camera = camera->second;
    return true;
  }
  const auto eye = numbers_in<double>(value_in(query, "eye"), ',', 3), target = numbers_in<double>(value_in(query, "target"), ',', 3);
  const auto angle = number_in<double>(value_in(query, "angle"));
  if (eye.empty() || target.empty() || !angle)
    return false;
  view.place = {{eye[0], eye[1], eye[2]}, {target[0], target[1], target[2]}, angle};
  try {
    static_cast<void>(camera_at(view.place, {}));
  } catch (const UserError&) {
    return false;
  }
  return true;
}

WebReply not_now(const std::string& why) { return text_reply(503, "text/plain", why + "\n"); }

WebReply picture_reply(RestingPictures& pictures, const WebRequest& request) {
  const auto view = view_of(request.query);
  if (!view)
    return text_reply(400, "text/plain", "no view\n");
  const bool exr = request.path == "save.exr";
  const RestingStep step =
      request.path == "picture" && value_in(request.query, "step") == "coarse" ? RestingStep::coarse : RestingStep::whole;
  try {
    const auto bytes = pictures.picture(*view, step, exr ? PictureFormat::exr : PictureFormat::png);
    return bytes ? bytes_reply(exr ? "image/x-exr" : "image/png", *bytes) : WebReply{204, "", nullptr};
  } catch (const NoPictureNow& reason) {
    return not_now(reason.why);
  } catch (const UserError& error) {
    return text_reply(400, "text/plain", error.what());
  }
}

WebReply command_reply(const RestingPictures& pictures, const WebRequest& request) {
  const auto view = view_of(request.query);
  const auto room = pictures.room();
  if (!view || !room)
    return view ? not_now(not_solved_yet) : text_reply(400, "text/plain", "no view\n");
  const std::string name = value_in(request.query, "name");
  return text_reply(200, "text/plain", command_of(*room, *view, name.empty() ? "view" : name));
}

/// Once it is solved there are no shots to stop.
void change_steps(LiveBoard& board, ShotSteps& steps, const std::string& how) {
  board.change_status([&](LiveStatus& status) {
    if (status.solved)
      return;
    if (how == "step")
      steps.step();
    else
      steps.pause(how == "pause");
    status.paused = steps.paused();
  });
}

WebReply solution_reply(const RestingPictures& pictures) {
  const auto room = pictures.room();
  if (!room)
    return not_now(not_solved_yet);
  return bytes_reply("model/gltf-binary",
                     solution_bytes(room->scene_hash, room->lit.prepared->mesh, room->solution,
                                    two_pass_settings(room->settings).pass_one.mesh, room->scene.string()));
}

WebReply factors_reply(const LiveBoard& board, FactorRows& factors, const Query& query) {
  const auto room = number_in<std::uint64_t>(value_in(query, "room")), element = number_in<std::uint64_t>(value_in(query, "element"));
  if (!room || !element)
    return text_reply(400, "text/plain", "no element of a room\n");
  const auto mesh = board.mesh();
  if (!mesh || mesh->room != *room)
    return not_now("Another room is shown by now.");
  try {
    return text_reply(200, "application/octet-stream", factors.row(*mesh, *element));
  } catch (const UserError& error) {
    return text_reply(400, "text/plain", std::string(error.what()) + "\n");
  }
}

/// POST
WebReply change(const LiveAnswers& all, const WebRequest& request) {
  const auto number = number_in<std::uint64_t>(value_in(request.query, "number"));
  if (request.path == "step" || request.path == "pause" || request.path == "go-on")
    change_steps(all.board, all.steps, request.path);
  else if (request.path == "gather" || request.path == "shoot")
    all.steps.gather(request.path == "gather");
  else if (request.path == "moved" && number)
    all.pictures.moved(value_in(request.query, "viewer").substr(0, 32), *number);
  else
    return text_reply(404, "text/plain", "404\n");
  return {204, "", nullptr};
}

} // namespace

std::optional<RestingView> view_of(const Query& query) {
  constexpr int longest_side = 4096;
  RestingView view;
  const auto size = numbers_in<int>(value_in(query, "size"), 'x', 2);
  const auto exposure = number_in<double>(value_in(query, "exposure"));
  const auto number = number_in<std::uint64_t>(value_in(query, "number"));
  constexpr double max_stops = 100.0;
  if (size.empty() || !exposure || std::abs(*exposure) > max_stops || !number || !take_place(query, view))
    return std::nullopt;
  for (const int side : size)
    if (side < 1 || side > longest_side)
      return std::nullopt;
  view.viewer = value_in(query, "viewer").substr(0, 32);
  view.number = *number;
  view.size = {size[0], size[1]};
  view.exposure = *exposure;
  return view;
}

WebReply LiveAnswers::operator()(const WebRequest& request) const {
  if (request.changes_something)
    return change(*this, request);
  if (request.path.empty())
    return text_reply(200, "text/html; charset=utf-8", fill_page(view_page, "null"));
  if (request.path == "room")
    return shared_reply("application/json", board.room());
  if (request.path == "light")
    return shared_reply("application/octet-stream",
                        board.light(number_in<std::uint64_t>(value_in(request.query, "base")).value_or(0)));
  if (request.path == "picture" || request.path == "save.exr" || request.path == "save.png")
    return picture_reply(pictures, request);
  if (request.path == "factors")
    return factors_reply(board, factors, request.query);
  if (request.path == "command")
    return command_reply(pictures, request);
  if (request.path == "solution")
    return solution_reply(pictures);
  return text_reply(404, "text/plain", "404\n");
}

} // namespace meninas
