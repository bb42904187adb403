#include "library/impl.h"

#include "radiosity/relight.h"
#include "radiosity/solution/solution_file.h"
#include "raytrace/diffuse_term.h"
#include "runs/outputs.h"
#include "runs/resources.h"
#include "runs/solve_run.h"
#include "scenes/content_hash.h"
#include "scenes/errors.h"
#include "scenes/stopwatch.h"

#include <fmt/format.h>

#include <cmath>

namespace meninas {

/// What the arrays of the API are, once the field is known.
static std::shared_ptr<const RoomSolution::Impl> described(std::shared_ptr<RoomSolution::Impl> impl) {
  const ElementMesh& mesh = impl->solution.field.mesh();
  impl->vertices = flat<float>(mesh.vertices);
  describe_elements(mesh, &impl->elements, impl->nodes);
  return impl;
}

/// Whether light of a solution is told apart by lamps; what to do where it is not.
static void check_lamps_apart(const RoomSolution::Impl& impl, const char* asked) {
  if (!impl.solution.field.by_lamp.empty())
    return;
  if (impl.is_relit)
    throw UsageError(asked, "a solution that was relit does not know its lamps: relight the one that it was made from");
  throw UsageError(asked, "the solution does not know its lamps apart: solve with by-lamp");
}

/// A solution with another field, of which the rest is that of this one.
static std::shared_ptr<RoomSolution::Impl> with_field(const RoomSolution::Impl& of, IrradianceField field) {
  auto impl = std::make_shared<RoomSolution::Impl>();
  impl->room = of.room;
  impl->prepared = of.prepared;
  impl->mesh = of.mesh;
  impl->settings = of.settings;
  impl->figures = of.figures;
  impl->is_relit = true;
  impl->solution.solver = of.solution.solver;
  impl->solution.links = of.solution.links;
  impl->solution.energy = of.solution.energy;
  impl->solution.closure = of.solution.closure;
  impl->solution.field = std::move(field);
  return impl;
}

RoomSolution Room::solve(const Settings& settings, const Listener& listener) const {
  return guarded([&] {
    Call call = call_of(*impl_, settings, CallKind::solution);
    RunSettings& chosen = call.request.settings;
    chosen.lamps = call.by_lamp;
    Stopwatch total;
    const ThreadLimit limit(chosen.threads);
    const RunEvents events = events_of(listener);
    auto impl = std::make_shared<RoomSolution::Impl>();
    impl->room = impl_;
    impl->settings = two_pass_settings(chosen).pass_one;
    impl->mesh = impl->settings.mesh;
    impl->figures.threads = limit.threads();
    check_memory(impl_->scene, chosen, std::nullopt);
    impl->prepared = prepare_run(impl_->scene, impl->settings, events, impl->figures);
    impl->solution = solve_pass_one(impl->prepared->light(), impl->settings, events.progress);
    add_solution(impl->figures, impl->solution);
    impl->figures.seconds.total = total.lap();
    impl->figures.peak_memory_bytes = peak_memory_bytes();
    warn_of_solution(*impl->prepared, impl->figures.solver, impl->figures.closure, events);
    return RoomSolution(described(std::move(impl)));
  });
}

RoomSolution Room::read_solution(const std::filesystem::path& file, const Listener& listener) const {
  return guarded([&] {
    const Call call = call_of(*impl_, {}, CallKind::solution);
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
    check_outputs({.pictures = {}, .solution = file, .texts = {}}, files_of(*impl_->room));
    write_solution(file, content_hash(impl_->room->scene), impl_->prepared->mesh, impl_->solution,
                   impl_->mesh);
  });
}

RoomPicture RoomSolution::render(const Settings& settings, const Listener& listener) const {
  return guarded([&] {
    const Room::Impl& room = *impl_->room;
    const RenderRequest request = call_of(room, settings, CallKind::picture_of_solution).request;
    if (request.settings.mode == PictureMode::reference)
      throw UsageError("mode", "a reference has no solution: it is of Room::render");
    const auto& lamps = request.settings.lamp_factors;
    if (!lamps.empty() || request.settings.lamp_layers)
      check_lamps_apart(*impl_, lamps.empty() ? "layers" : "lamp");
    if (request.settings.layers == WithLayers::yes && (impl_->is_relit || !lamps.empty()))
      throw UsageError("layers", "what mirrors bring is not known of lamps: light does not go with other lamps than all at 1");
    Stopwatch total;
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
    impl->inputs = files_of(room);
    figures.seconds.total = total.lap();
    figures.peak_memory_bytes = peak_memory_bytes();
    impl->stats = stats_json(figures);
    return RoomPicture(std::move(impl));
  });
}

RoomSolution RoomSolution::relit(const std::vector<std::pair<std::string, Colour>>& factors) const {
  return guarded([&] {
    constexpr double brightest = 1e6; // as on the command line
    check_lamps_apart(*impl_, "relit");
    std::vector<LampFactor> given;
    for (const auto& [lamp, factor] : factors) {
      for (const double channel : factor)
        if (!(channel >= 0.0) || channel > brightest)
          throw UsageError("relit", fmt::format("{} is no factor of lamp '{}': it is from 0 to {:g}", channel, lamp, brightest));
      given.push_back({lamp, Rgb(factor[0], factor[1], factor[2])});
    }
    const auto& field = impl_->solution.field;
    return RoomSolution(described(
        with_field(*impl_, meninas::relit(field, factors_of_lamps(field.scene->lamp_groups->names, given)))));
  });
}

std::vector<Arriving> RoomSolution::irradiance_at(std::span<const MeasuringPoint> points,
                                                  const Listener& listener) const {
  return guarded([&] {
    constexpr double farthest = 1e6; // m, as where cameras may stand
    std::vector<QueryPoint> queries;
    for (const MeasuringPoint& point : points) {
      const Vec3 normal(point.normal[0], point.normal[1], point.normal[2]);
      const Point3 position(point.position[0], point.position[1], point.position[2]);
      const double length = glm::length(normal);
      if (!(glm::length(position) <= farthest) || !(length > 0.0) || !std::isfinite(length))
        throw UsageError("irradiance_at", fmt::format("point {} is no place within {:g} m, or its normal has no length",
                                                      queries.size(), farthest));
      queries.push_back({position, normal / length});
    }
    const auto& field = impl_->solution.field;
    const auto found = irradiance_at_points(*field.scene, sent_light(field), queries,
                                            point_query_settings(impl_->settings),
                                            events_of(listener).progress);
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
