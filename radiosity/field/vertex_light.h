// The light gathered at a vertex,
//
//   H(x) = D(x) + 1/N sum over N cosine-distributed rays of tau B(landing) + secondary emitters,      W/m^2
//
// (light/point_irradiance.h), and its clearance: where something stands on a surface there is no light to
// interpolate. Clearance is tested by sixteen rays as long as 0.35 of an element.
#pragma once

#include "radiosity/light/row_cache.h"
#include "radiosity/light/point_irradiance.h"

namespace meninas {

/// The space above a point: open, low (something within a fraction of an element), or enclosed by an object
/// that stands on it and leaves no way for light.
///
/// The little light under a low cover must not be interpolated into the open floor. If the space is low
/// on all sides (tip of a wedge, elements larger than the room), there is no open floor and the value
/// is kept. The neighbouring points decide.
enum class Clearance : std::uint8_t { open, low, enclosed };

struct VertexValue {
  ArrivingLight irradiance;
  ArrivingLight indirect; ///< the part of it that is not direct light
  Clearance clearance = Clearance::open;
  ArrivingLight emission{}; ///< of that part, what rays have met of emitters
  std::uint32_t hits = 0;   ///< so many rays
};

/// A point at which light is gathered, in elements of a size.
struct GatheringPoint {
  const Receiver& receiver;
  double element_size; ///< metres
  std::uint32_t seed;
};

/// H there, W/m^2. `irradiance` by ElementId tells which elements are lit.
VertexValue value_at(const PointGathering& gathering, const std::vector<Rgb>& irradiance,
                     const GatheringPoint& at, PointWorkspace& work);

/// The indirect part alone; `irradiance` of the result is the same.
/// Takes the rays that are `kept`, or keeps them there for the next time.
VertexValue indirect_value_at(const PointGathering& gathering, const std::vector<Rgb>& irradiance,
                              const GatheringPoint& at, PointWorkspace& work,
                              VertexRays* kept = nullptr);

/// Direct light alone.
ArrivingLight direct_light_at(const PointGathering& gathering, const Receiver& receiver,
                              std::uint32_t seed, PointWorkspace& work);
/// The same by other settings than those of the gathering.
ArrivingLight direct_light_by(const PointGathering& gathering, const DirectSettings& settings,
                              const Receiver& receiver, std::uint32_t seed, PointWorkspace& work);
/// The same with all samples of a penumbra.
ArrivingLight light_beside_penumbra(const PointGathering& gathering, const Receiver& receiver,
                                    std::uint32_t seed, PointWorkspace& work);

/// True if a wall stands on a line through this point. An uncovered point on the line sees neither side
/// of the wall, though its light is strongest there: the form factor to the wall is 1/2 beside the line
/// and 0 on it.
bool touches_wall(const LightScene& light, const Receiver& receiver);

/// Whether more than half of what a point sees is blocked within a fraction of an element:
/// it is covered or nearly so, under an edge.
bool is_nearly_under_something(const LightScene& light, const Receiver& receiver,
                               double element_size);

/// Whether nothing is or nearly is over a point, as far as few rays tell.
bool is_open(const PointGathering& gathering, const std::vector<Rgb>& irradiance,
             const GatheringPoint& at, PointWorkspace& work);

/// Whether something lies on the surface here: nearly all of the hemisphere
/// is blocked within a fraction of an element, as under a box that stands on a floor.
bool is_under_something(const LightScene& light, const Receiver& receiver, double element_size);

/// The clearance of a point without direct light, as far as few rays tell: `enclosed` where nearly all that it
/// sees is black, as inside an object that stands on its surface.
Clearance clearance_of_unlit(const LightScene& light, const FormFactorSettings& form_factors,
                        const Receiver& receiver, double element_size, std::uint32_t seed,
                        PointWorkspace& work);

} // namespace meninas
