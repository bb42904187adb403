#include "scenes/rays/embree_filters.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace meninas {

namespace {

/// The lanes whose hit is to be judged.
std::uint32_t hit_lanes(const RTCFilterFunctionNArguments& args) {
  LaneFlags valid{};
  if (args.N == packet_size)
    std::memcpy(valid.data(), args.valid, sizeof valid);
  else
    std::copy_n(args.valid, std::min<std::size_t>(args.N, packet_size), valid.begin());
  return bits_of(valid);
}

Candidate candidate(const RTCFilterFunctionNArguments& args, unsigned lane) {
  const auto n = args.N;
  return {RTCHitN_primID(args.hit, n, lane),
          RTCRayN_id(args.ray, n, lane),
          {RTCHitN_Ng_x(args.hit, n, lane), RTCHitN_Ng_y(args.hit, n, lane),
           RTCHitN_Ng_z(args.hit, n, lane)},
          {RTCRayN_dir_x(args.ray, n, lane), RTCRayN_dir_y(args.ray, n, lane),
           RTCRayN_dir_z(args.ray, n, lane)},
          RTCRayN_tfar(args.ray, n, lane)};
}

} // namespace

static void filter_rays(const RTCFilterFunctionNArguments* args) {
  const auto& context = *static_cast<const RayContext*>(args->context);
  for (auto rest = hit_lanes(*args); rest != 0; rest &= rest - 1) {
    const auto lane = static_cast<unsigned>(std::countr_zero(rest));
    if (!is_hit(context.rule, candidate(*args, lane)))
      args->valid[lane] = 0;
  }
}

static void collect_hits(const RTCFilterFunctionNArguments* args) {
  const auto& context = *static_cast<const CollectingContext*>(args->context);
  for (auto rest = hit_lanes(*args); rest != 0; rest &= rest - 1) {
    const auto lane = static_cast<unsigned>(std::countr_zero(rest));
    const Candidate met = candidate(*args, lane);
    if (is_hit(context.rule, met))
      context.hits->push_back({met.triangle, met.distance, RTCHitN_u(args->hit, args->N, lane),
                               RTCHitN_v(args->hit, args->N, lane),
                               glm::dot(met.normal, met.direction) < 0.0F});
    args->valid[lane] = 0;
  }
}

void filter_legs(const RTCFilterFunctionNArguments* args) {
  auto& context = *static_cast<LegContext*>(args->context);
  for (auto rest = hit_lanes(*args); rest != 0; rest &= rest - 1) {
    const auto lane = static_cast<unsigned>(std::countr_zero(rest));
    if (!context.judge.blocks(candidate(*args, lane)))
      args->valid[lane] = 0;
  }
}

void filter_holes(const RTCFilterFunctionNArguments* args) {
  const auto& [valid, geometry, context, ray, hit, n] = *args;
  for (auto rest = hit_lanes(*args); rest != 0; rest &= rest - 1) {
    const auto lane = static_cast<unsigned>(std::countr_zero(rest));
    if (is_hole(*static_cast<const FrameGeometry*>(geometry), RTCHitN_primID(hit, n, lane),
                {RTCHitN_u(hit, n, lane), RTCHitN_v(hit, n, lane)}))
      valid[lane] = 0;
  }
}

RayContext make_context(const RayRule& rule, Coherence coherence) {
  RayContext context;
  init_context(context, coherence, filter_rays);
  context.rule = rule;
  return context;
}

CollectingContext make_context(const RayRule& rule, std::vector<LaneHit>& hits) {
  CollectingContext context;
  init_context(context, Coherence::incoherent, collect_hits);
  context.rule = rule;
  context.hits = &hits;
  return context;
}

} // namespace meninas
