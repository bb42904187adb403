#include "library/impl.h"

#include "radiosity/relight.h"
#include "radiosity/solution/solution_file.h"
#include "raytrace/diffuse_term.h"
#include "runs/outputs.h"
#include "runs/resources.h"
#include "runs/solve_run.h"
#include "scenes/content_hash.h"
#include "scenes/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace meninas {

/// What the arrays of the API are, once the field is known.
static std::shared_ptr<const RoomSolution::Impl> described(std::shared_ptr<RoomSolution::Impl> impl) {
  const ElementMesh& mesh = impl->solution.field.mesh();
  impl->vertices = flat<float>(mesh.vertices);
  describe_elements(mesh, &impl->elements, impl->nodes);
  return impl;
}

/// Settings that a solution has no use for.
static void check_pass_one(const Settings& settings) {
  for (const char* name : {"lamp", "camera", "size", "layers", "mode", "view", "error", "time"})
    if (std::ranges::find(settings, name, &Settings::value_type::first) != settings.end())
      throw UsageError(name, std::string(name) == "lamp"
                                 ? "a solution is relit by RoomSolution::relit"
                                 : "is of pictures, not of a solution");
}

RoomSolution Room::solve(const Settings& settings, const Listener& listener) const {
  return guarded([&] {
    check_pass_one(settings);
    Call call = call_of(*impl_, settings);
    RunSettings& chosen = call.request.settings;
    check_reading(*impl_, chosen);
    chosen.lamps = call.by_lamp;
    chosen.lamp_factors.clear();
    const ThreadLimit limit(chosen.threads);
    const RunEvents events = events_of(listener);
    auto impl = std::make_shared<RoomSolution::Impl>();
    impl->room = impl_;
    impl->settings = two_pass_settings(chosen).pass_one;
    impl->mesh = impl->settings.mesh;
    impl->figures.threads = limit.threads();
    check_memory(impl_->scene, chosen, std::nullopt);
    impl->prepared = prepare_run(impl_->scene, impl->settings, events, impl->figures);
    impl->solution = solve_pass_one(impl->prepared->light, impl->settings, events.progress);
    add_solution(impl->figures, impl->solution);
    warn_of_solution(*impl->prepared, impl->figures.solver, impl->figures.closure, events);
    return RoomSolution(described(std::move(impl)));
  });
}

RoomSolution Room::read_solution(const std::filesystem::path& file, const Listener& listener) const {
  return guarded([&] {
    const Call call = call_of(*impl_, {});
    const ThreadLimit limit(call.request.settings.threads);
    auto impl = std::make_shared<RoomSolution::Impl>();
    impl->room = impl_;
    impl->settings = two_pass_settings(call.request.settings).pass_one;
    impl->figures.threads = limit.threads();
    impl->mesh = meninas::read_solution(file, impl_->scene).mesh;
    LitScene lit = read_lit_scene(file, impl_->scene, impl->settings, events_of(listener),
                                  impl->figures, LampsApart::if_known);
    impl->settings.mesh = impl->mesh;
    impl->prepared = std::move(lit.prepared);
    impl->solution.field = std::move(lit.field);
    impl->solution.solver = impl->figures.solver;
    impl->solution.links = impl->figures.links;
    impl->solution.energy = impl->figures.energy;
    impl->solution.closure = impl->figures.closure;
    return RoomSolution(described(std::move(impl)));
  });
}

void RoomSolution::write(const std::filesystem::path& file) const {
  guarded([&] {
    check_outputs({.pictures = {}, .solution = file, .texts = {}}, {impl_->room->file});
    write_solution(file, content_hash(impl_->room->scene), impl_->prepared->mesh, impl_->solution,
                   impl_->mesh);
  });
}

RoomPicture RoomSolution::render(const Settings& settings, const Listener& listener) const {
  return guarded([&] {
    const Room::Impl& room = *impl_->room;
    RenderRequest request = call_of(room, settings).request;
    check_reading(room, request.settings);
    if (request.settings.mode == PictureMode::reference || request.goal)
      throw UsageError("mode", "reference, error and time are of Room::render");
    const auto& lamps = request.settings.lamp_factors;
    if ((!lamps.empty() || request.settings.lamp_layers) && impl_->solution.field.by_lamp.empty())
      throw UsageError("lamp", "the solution does not know its lamps apart: solve with by-lamp");
    const ThreadLimit limit(request.settings.threads);
    const RunEvents events = events_of(listener);
    const Camera chosen = choose_camera(impl_->prepared->scene, request.camera, request.settings, events);
    const PictureSize size = choose_size(request.size, chosen);
    const Camera camera = cut_open(impl_->prepared->scene, chosen, size, events);
    LitScene lit{impl_->prepared, impl_->solution.field};
    if (!lamps.empty() && !request.settings.lamp_layers)
      lit = under_lamps(lit, request.settings);
    RunFigures figures = impl_->figures;
    figures.threads = limit.threads();
    auto impl = std::make_shared<RoomPicture::Impl>();
    impl->picture = picture_of_solution(request, lit, camera, size, events, figures);
    impl->shown = request.picture;
    impl->stats = stats_json(figures);
    return RoomPicture(std::move(impl));
  });
}

RoomSolution RoomSolution::relit(const std::vector<std::pair<std::string, Colour>>& factors) const {
  return guarded([&] {
    if (impl_->solution.field.by_lamp.empty())
      throw UsageError("relit", "the solution does not know its lamps apart: solve with by-lamp");
    std::vector<LampFactor> given;
    for (const auto& [lamp, factor] : factors) {
      for (const double channel : factor)
        if (!(channel >= 0.0) || channel > std::numeric_limits<float>::max())
          throw UsageError("relit", fmt::format("{} is no factor of lamp '{}'", channel, lamp));
      given.push_back({lamp, Rgb(factor[0], factor[1], factor[2])});
    }
    const auto& field = impl_->solution.field;
    auto impl = std::make_shared<Impl>();
    impl->room = impl_->room;
    impl->prepared = impl_->prepared;
    impl->mesh = impl_->mesh;
    impl->settings = impl_->settings;
    impl->figures = impl_->figures;
    impl->solution.solver = impl_->solution.solver;
    impl->solution.links = impl_->solution.links;
    impl->solution.energy = impl_->solution.energy;
    impl->solution.closure = impl_->solution.closure;
    impl->solution.field =
        meninas::relit(field, factors_of_lamps(field.scene->lamp_groups->names, given));
    return RoomSolution(described(std::move(impl)));
  });
}

std::vector<Arriving> RoomSolution::irradiance_at(std::span<const MeasuringPoint> points) const {
  return guarded([&] {
    std::vector<QueryPoint> queries;
    for (const MeasuringPoint& point : points) {
      const Vec3 normal(point.normal[0], point.normal[1], point.normal[2]);
      const Point3 position(point.position[0], point.position[1], point.position[2]);
      const double length = glm::length(normal);
      if (!(length > 0.0) || !std::isfinite(length) ||
          !std::isfinite(position.x + position.y + position.z))
        throw UsageError("irradiance_at", fmt::format("point {} is not finite, or its normal has no length", queries.size()));
      queries.push_back({position, normal / length});
    }
    const auto& field = impl_->solution.field;
    const auto found = irradiance_at_points(*field.scene, sent_light(field), queries,
                                            point_query_settings(impl_->settings));
    const auto colour = [](const Rgb& c) { return Colour{c.r, c.g, c.b}; };
    std::vector<Arriving> result;
    for (const PointIrradiance& at : found)
      result.push_back({colour(at.total), colour(at.direct), colour(at.by_mirrors), at.inside});
    return result;
  });
}

std::span<const float> RoomSolution::vertices() const { return impl_->vertices; }
std::span<const float> RoomSolution::irradiance() const {
  return floats_of(impl_->solution.field.irradiance);
}
std::span<const std::uint32_t> RoomSolution::elements() const { return impl_->elements; }
std::span<const std::uint32_t> RoomSolution::node_of_element() const { return impl_->nodes; }
std::span<const double> RoomSolution::area() const { return impl_->solution.field.mesh().area; }
std::string RoomSolution::stats() const { return stats_json(impl_->figures); }

} // namespace meninas
