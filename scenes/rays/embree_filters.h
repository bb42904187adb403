// Filters: which of the hits that Embree finds count, by the rules of hit_rules.h.
#pragma once

#include "scenes/rays/embree_api.h"
#include "scenes/rays/hit_rules.h"

#include <vector>

namespace meninas {

/// Embree's context, with the rule that its filter applies.
struct RayContext : QueryContext {
  RayRule rule;
};
/// All hits of one ray by the rule.
struct CollectingContext : RayContext {
  std::vector<LaneHit>* hits = nullptr;
};
struct LegContext : QueryContext {
  LegJudge judge;
};

/// The filter of legs: tells blockers from surfaces that touch the ends.
void filter_legs(const RTCFilterFunctionNArguments* args);
/// The filter that every query has before its own: rays pass holes.
void filter_holes(const RTCFilterFunctionNArguments* args);

RayContext make_context(const RayRule& rule, Coherence coherence);
/// Each hit is kept and passed, so that the search goes on to the ray's end.
CollectingContext make_context(const RayRule& rule, std::vector<LaneHit>& hits);

} // namespace meninas
