// Embree 3 or 4, whichever the build has found, with one set of names: the only place that tells them apart.
//
// Packets are of sixteen rays. Where the processor has no instructions for sixteen at once, Embree 4 takes such a
// packet apart into single rays (3 into packets of eight); two packets of eight are then quicker, and find the same
// hits.
#pragma once

#include "scenes/rays/rays.h"

#ifdef MENINAS_EMBREE_4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace meninas {

#ifdef MENINAS_EMBREE_4

/// Flags and filter of a query, and whatever else its filter has to know. Embree 4 takes the first two apart from it.
struct QueryContext : RTCRayQueryContext {
  RTCRayQueryFlags flags = RTC_RAY_QUERY_FLAG_NONE;
  RTCFilterFunctionN filter = nullptr;
};

inline constexpr auto filter_by_query = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

inline void init_context(QueryContext& context, Coherence coherence, RTCFilterFunctionN filter) {
  rtcInitRayQueryContext(&context);
  context.flags = static_cast<RTCRayQueryFlags>(
      (coherence == Coherence::coherent ? RTC_RAY_QUERY_FLAG_COHERENT
                                        : RTC_RAY_QUERY_FLAG_INCOHERENT) |
      (filter == nullptr ? RTC_RAY_QUERY_FLAG_NONE : RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER));
  context.filter = filter;
}

template <typename Arguments>
Arguments filled(Arguments arguments, QueryContext& context) {
  arguments.flags = context.flags;
  arguments.context = &context;
  arguments.filter = context.filter;
  return arguments;
}
inline RTCIntersectArguments intersect_arguments(QueryContext& context) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  return filled(arguments, context);
}
inline RTCOccludedArguments occluded_arguments(QueryContext& context) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  return filled(arguments, context);
}

inline void trace(RTCScene scene, QueryContext& context, RTCRayHit& ray) {
  auto arguments = intersect_arguments(context);
  rtcIntersect1(scene, &ray, &arguments);
}
inline void trace(const int* valid, RTCScene scene, QueryContext& context, RTCRayHit8& rays) {
  auto arguments = intersect_arguments(context);
  rtcIntersect8(valid, scene, &rays, &arguments);
}
inline void trace(const int* valid, RTCScene scene, QueryContext& context, RTCRayHit16& rays) {
  auto arguments = intersect_arguments(context);
  rtcIntersect16(valid, scene, &rays, &arguments);
}
inline void trace(const int* valid, RTCScene scene, QueryContext& context, RTCRay8& rays) {
  auto arguments = occluded_arguments(context);
  rtcOccluded8(valid, scene, &rays, &arguments);
}
inline void trace(const int* valid, RTCScene scene, QueryContext& context, RTCRay16& rays) {
  auto arguments = occluded_arguments(context);
  rtcOccluded16(valid, scene, &rays, &arguments);
}

#else

using QueryContext = RTCIntersectContext;

inline constexpr auto filter_by_query = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

inline void init_context(QueryContext& context, Coherence coherence, RTCFilterFunctionN filter) {
  rtcInitIntersectContext(&context);
  context.flags = coherence == Coherence::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                   : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  context.filter = filter;
}

inline void trace(RTCScene scene, QueryContext& context, RTCRayHit& ray) {
  rtcIntersect1(scene, &context, &ray);
}
inline void trace(const int* valid, RTCScene scene, QueryContext& context, RTCRayHit8& rays) {
  rtcIntersect8(valid, scene, &context, &rays);
}
inline void trace(const int* valid, RTCScene scene, QueryContext& context, RTCRayHit16& rays) {
  rtcIntersect16(valid, scene, &context, &rays);
}
inline void trace(const int* valid, RTCScene scene, QueryContext& context, RTCRay8& rays) {
  rtcOccluded8(valid, scene, &context, &rays);
}
inline void trace(const int* valid, RTCScene scene, QueryContext& context, RTCRay16& rays) {
  rtcOccluded16(valid, scene, &context, &rays);
}

#endif

enum class PacketWidth { eight, sixteen };

/// Eight where the device has instructions for eight rays at once and none for sixteen.
PacketWidth packet_width(RTCDevice device);

struct TracedScene {
  RTCScene scene = nullptr;
  PacketWidth width = PacketWidth::sixteen;
};

/// Closest hits of sixteen rays, and whether they meet anything; `valid` is -1 for those that are traced.
void trace(const TracedScene& scene, const std::int32_t* valid, QueryContext& context, RTCRayHit16& rays);
void trace(const TracedScene& scene, const std::int32_t* valid, QueryContext& context, RTCRay16& rays);

} // namespace meninas
