#include "library/impl.h"

#include "radiosity/field/vertex_places.h"
#include "radiosity/solvers/solve.h"
#include "runs/resources.h"
#include "scenes/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace meninas {

/// Light that was not followed to its end is shared out among the rest of a row, so that it closes for a
/// solve. Here it is lost: a row without mirrors is that of black ones.
static void take_back_what_was_cut(FormFactors& factors) {
  Transport& rows = factors.transport;
  for (std::size_t row = 0; row < rows.size; ++row)
    for (std::uint64_t k = rows.row_begin[row]; k < rows.row_begin[row + 1]; ++k)
      for (int band = 0; band < rows.bands; ++band)
        rows.weights[k * static_cast<std::size_t>(rows.bands) + static_cast<std::size_t>(band)] *=
            1.0F - factors.closure[row].cut_light[band];
}

/// By column, as others expect it.
static void sort_rows(Transport& rows) {
  const auto bands = static_cast<std::size_t>(rows.bands);
  std::vector<std::uint64_t> order;
  for (std::size_t row = 0; row < rows.size; ++row) {
    const std::uint64_t begin = rows.row_begin[row], end = rows.row_begin[row + 1];
    order.resize(end - begin);
    std::iota(order.begin(), order.end(), begin);
    std::ranges::sort(order, {}, [&](std::uint64_t k) { return rows.columns[k]; });
    std::vector<std::uint32_t> columns;
    std::vector<float> weights;
    for (const std::uint64_t k : order) {
      columns.push_back(rows.columns[k]);
      for (std::size_t band = 0; band < bands; ++band)
        weights.push_back(rows.weights[k * bands + band]);
    }
    std::ranges::copy(columns, rows.columns.begin() + static_cast<std::ptrdiff_t>(begin));
    std::ranges::copy(weights, rows.weights.begin() + static_cast<std::ptrdiff_t>(begin * bands));
  }
}

RoomFactors Room::form_factors(const Settings& settings, const Listener& listener) const {
  return guarded([&] {
    RunSettings chosen = call_of(*impl_, settings, CallKind::form_factors).request.settings;
    chosen.mesh = MeshCut::uniform; // nodes of a hierarchy have no rows of their own
    const ThreadLimit limit(chosen.threads);
    const RunEvents events = events_of(listener);
    const PassOneSettings of_pass_one = two_pass_settings(chosen).pass_one;
    RunFigures figures;
    check_memory(impl_->scene, chosen, std::nullopt);
    const auto prepared = prepare_run(scene_under_lamps(*impl_, chosen), of_pass_one, events, figures);
    const LightScene& light = *prepared->light();
    const ElementMesh& mesh = light.mesh;
    auto impl = std::make_shared<RoomFactors::Impl>();
    impl->room = impl_;
    impl->factors = assemble_transport(light, of_pass_one.form_factors, events.progress);
    if (of_pass_one.form_factors.method != FormFactorMethod::analytic) // has not shared out anything
      take_back_what_was_cut(impl->factors);
    sort_rows(impl->factors.transport);
    impl->settings = settings;
    impl->area = mesh.area;
    impl->reflectance = flat<double>(mesh.reflectance);
    impl->emission = flat<double>(mesh.emission);
    std::vector<Vec3> centres, normals;
    for (std::uint32_t e = 0; e < element_count(mesh); ++e) {
      centres.push_back(centre_of(mesh, ElementId{e}));
      normals.push_back(mesh.sides[index(mesh.side_of_element[e])].normal);
    }
    impl->centre = flat<float>(centres);
    impl->normal = flat<float>(normals);
    describe_elements(mesh, nullptr, impl->nodes);
    return RoomFactors(std::move(impl));
  });
}

std::size_t RoomFactors::size() const { return impl_->factors.transport.size; }
int RoomFactors::channels() const { return impl_->factors.transport.bands; }
std::span<const std::uint64_t> RoomFactors::row_begin() const { return impl_->factors.transport.row_begin; }
std::span<const std::uint32_t> RoomFactors::columns() const { return impl_->factors.transport.columns; }
std::span<const float> RoomFactors::weights() const { return impl_->factors.transport.weights; }
std::span<const double> RoomFactors::area() const { return impl_->area; }
std::span<const float> RoomFactors::centre() const { return impl_->centre; }
std::span<const float> RoomFactors::normal() const { return impl_->normal; }
std::span<const double> RoomFactors::reflectance() const { return impl_->reflectance; }
std::span<const double> RoomFactors::emission() const { return impl_->emission; }
std::span<const std::uint32_t> RoomFactors::node_of_element() const { return impl_->nodes; }

/// Three numbers each as colours. Throws UsageError unless there are as many as elements, all finite and none negative.
static std::vector<Rgb> colours_at(std::span<const double> values, std::size_t elements) {
  if (values.size() != 3 * elements)
    throw UsageError("emission", fmt::format("has {} numbers, not three for each of {} elements",
                                             values.size(), elements));
  constexpr double brightest = 1e30; // of which sums are finite
  std::vector<Rgb> colours;
  for (std::size_t e = 0; e < elements; ++e) {
    const Rgb colour(values[3 * e], values[3 * e + 1], values[3 * e + 2]);
    for (int c = 0; c < 3; ++c)
      if (!(colour[c] >= 0.0) || colour[c] > brightest)
        throw UsageError("emission", fmt::format("{} of element {} is no light", colour[c], e));
    colours.push_back(colour);
  }
  return colours;
}

RoomFactors::Solved RoomFactors::solve(std::span<const double> emission,
                                       const Settings& settings,
                                       const Listener& listener) const {
  return guarded([&] {
    // Of the call that has made the rows only the number of threads still matters.
    Settings before = impl_->settings;
    std::erase_if(before, [](const auto& setting) { return setting.first != "threads"; });
    call_of(*impl_->room, settings, CallKind::solve_rows); // refuses what has no effect
    const RunSettings chosen =
        call_of(*impl_->room, merged(before, settings), CallKind::solve_rows).request.settings;
    const ThreadLimit limit(chosen.threads);
    const SolverSettings how = two_pass_settings(chosen).pass_one.solver;
    const auto own = std::span<const double>(impl_->emission);
    check_size(how.method, size());
    const SolverResult result =
        meninas::solve(impl_->factors.transport, colours_at(emission.empty() ? own : emission, size()),
                       colours_at(impl_->reflectance, size()), how,
                       {.shooters = {}, .watch = {}, .progress = events_of(listener).progress});
    return Solved{flat<double>(result.radiosity), result.iterations, result.residual,
                  result.error_bound, result.converged};
  });
}

} // namespace meninas
