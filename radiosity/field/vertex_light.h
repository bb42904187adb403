// What a vertex gathers, and whether that counts:
// where something stands on a surface there is no light to interpolate.
#pragma once

#include "radiosity/light/row_cache.h"
#include "radiosity/light/point_irradiance.h"

namespace meninas {

/// What is over a point: nothing near, something within a fraction of an element,
/// or something that stands on it and leaves no way for light.
///
/// What little light there is under a low cover must not be interpolated out into the open.
/// But where a space is low all around, as in the corner of a wedge or where elements are larger
/// than the room, there is no open to spoil, and what arrives is what the surface shows:
/// the points around tell.
enum class Cover : std::uint8_t { open, low, shut };

struct VertexValue {
  ArrivingLight irradiance;
  ArrivingLight indirect; ///< the part of it that does not come from the source
  Cover cover = Cover::open;
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

/// The part that comes from the source alone.
ArrivingLight light_from_source(const PointGathering& gathering, const Receiver& receiver,
                                std::uint32_t seed, PointWorkspace& work);
/// The same with all samples of a penumbra.
ArrivingLight light_beside_penumbra(const PointGathering& gathering, const Receiver& receiver,
                                    std::uint32_t seed, PointWorkspace& work);

/// Whether a wall stands on the surface along a line through this very point.
/// Where nothing is covered the point still sees neither side of the wall, whose light
/// is brightest beside it: a form factor that is 1/2 on one side of the line is 0 on it.
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

/// What is over a point to which no light comes from the source, as far as few rays tell:
/// `shut` where nearly all that it sees is black, as inside something that stands on its surface.
Cover clearance_of_unlit(const LightScene& light, const FormFactorSettings& form_factors,
                        const Receiver& receiver, double element_size, std::uint32_t seed,
                        PointWorkspace& work);

} // namespace meninas
