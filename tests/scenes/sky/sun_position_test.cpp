// The sun's place against published values.
#include "scenes/sky/sun_position.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meninas::test {
namespace {

struct Published {
  const char* what;
  GeographicPlace place;
  UtcTime time;
  SunAngles sun;
  double error; ///< degrees
};

TEST(SunPosition, AgreesWithPublishedPlaces) {
  const Published cases[] = {
      // Reda and Andreas 2008, Solar Position Algorithm, NREL/TP-560-34302, table A5.1: the sun
      // without refraction, 39.87205 above the horizon, azimuth 194.34024, at 12:30:30 local time, 7 hours behind.
      {"Golden, Colorado", {39.742476, -105.1786}, {2003, 10, 17, 19.0 + 30.5 / 60.0},
       {194.34024, 39.87205}, 0.01},
      // The June solstice of 2026 at noon by the sun on the northern tropic: the sun is overhead to a few hundredths.
      {"the tropic of Cancer", {23.436, 0.0}, {2026, 6, 21, 12.0 + 1.87 / 60.0}, {180.0, 90.0}, 0.05},
      // Meeus 1998, example 25.a: declination -7.78507 degrees at 0 h on 13 October 1992; at the north pole that
      // is the elevation.
      {"the pole", {90.0, 0.0}, {1992, 10, 13, 0.0}, {180.0, -7.78507}, 0.005}};
  for (const Published& known : cases) {
    SCOPED_TRACE(known.what);
    const SunAngles sun = sun_angles(known.place, known.time);
    EXPECT_NEAR(sun.elevation, known.sun.elevation, known.error);
    const Direction found = direction_of(sun), expected = direction_of(known.sun);
    if (known.sun.elevation < 89.0 && known.place.latitude < 89.0) {
      EXPECT_LT(glm::degrees(std::acos(std::min(1.0, glm::dot(found, expected)))), 0.02);
    }
  }
}

TEST(SunPosition, NorthIsMinusZAndEastPlusX) {
  EXPECT_LT(glm::distance(direction_of({0.0, 0.0}), Direction(0, 0, -1)), 1e-12);
  EXPECT_LT(glm::distance(direction_of({90.0, 0.0}), Direction(1, 0, 0)), 1e-12);
  EXPECT_LT(glm::distance(direction_of({17.0, 90.0}), Direction(0, 1, 0)), 1e-12);
}

TEST(SunPosition, TheSunRisesInTheEastAndStandsInTheSouthAtNoon) {
  const GeographicPlace madrid{40.4168, -3.7038};
  EXPECT_NEAR(sun_angles(madrid, {2026, 3, 20, 6.4}).azimuth, 90.0, 4.0);
  const SunAngles noon = sun_angles(madrid, {2026, 6, 21, 12.28});
  EXPECT_NEAR(noon.azimuth, 180.0, 1.0);
  EXPECT_NEAR(noon.elevation, 90.0 - 40.4168 + 23.436, 0.02);
  // South of the tropics it stands in the north.
  EXPECT_NEAR(std::cos(glm::radians(sun_angles({-33.9, 18.4}, {2026, 6, 21, 10.8}).azimuth)), 1.0, 0.01);
}

} // namespace
} // namespace meninas::test
