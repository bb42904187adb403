// Shots by rays: columns of the transport on the fly, by reciprocity T_ij = A_j / A_i F_ji.
//
// Block J shoots N rays. Ray r starts on the element of the block that the r-th of N equal parts
// of its unshot power belongs to, at a point and into a cosine-distributed direction of Sobol's
// sequence, so that the directions of the whole block and those of every element are spread evenly.
// Rays are reflected exactly by mirrors (hemisphere_rays.h). A ray that lands on i adds power / A_i
// to its irradiance. All rays of a shot together carry the unshot power of its elements, exactly;
// light that is cut at the last mirror is shared out among the rest.
//
// N is in proportion to the share of the unshot power in all there is:
// rays of all shots carry about the same, so that the noise of an element's
// irradiance falls with the square root of the rays per element, or faster.
// Noise of single elements is larger than that of rows with as many rays, which look at radiosities
// and do not wait to be hit; means over many elements, as vertices gather, are as good.
#pragma once

#include "radiosity/transport/hemisphere_rays.h"
#include "radiosity/solvers/hemisphere_survey.h"
#include "radiosity/solvers/shooting.h"

#include <tbb/enumerable_thread_specific.h>

namespace meninas {

template <typename Value>
class RayShots {
public:
  RayShots(const LightScene& light, const HemisphereSurvey& survey, const FormFactorSettings& settings)
      : light_(light), survey_(survey), settings_(settings) {}

  /// A ColumnSource (solvers/shooting.h), of blocks.
  void shoot(std::size_t block, ShotState<Value>& state);

  std::uint64_t rays_traced() const { return rays_traced_; }

private:
  /// The result of a chunk of the rays.
  struct ChunkResult {
    std::vector<ElementHit> landings;
    Rgb kept{0.0}; ///< light that has left and was not cut
    std::uint64_t traced = 0;
  };
  struct Shot;

  ChunkResult follow(const Shot& shot, std::uint32_t first, std::uint32_t end);

  const LightScene& light_;
  const HemisphereSurvey& survey_;
  const FormFactorSettings& settings_;
  tbb::enumerable_thread_specific<GatherWorkspace> workspaces_;
  std::uint64_t rays_traced_ = 0;
};

} // namespace meninas
