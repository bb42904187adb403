// Filters: which of the hits that Embree finds count, by the rules of hit_rules.h.
#pragma once

#include "scenes/rays/hit_rules.h"

#include <embree3/rtcore.h>

namespace meninas {

/// Embree's context, with the rule that its filter applies.
struct RayContext : RTCIntersectContext {
  RayRule rule;
};
struct LegContext : RTCIntersectContext {
  LegJudge judge;
};

/// The filter of legs: tells blockers from surfaces that touch the ends.
void filter_legs(const RTCFilterFunctionNArguments* args);
/// The filter that every query has before its own: rays pass holes.
void filter_holes(const RTCFilterFunctionNArguments* args);

RTCIntersectContextFlags flags_for(Coherence coherence);
RayContext make_context(const RayRule& rule, RTCIntersectContextFlags flags);

} // namespace meninas
