// The daylight model of Preetham, Shirley and Smits 1999, appendix A.2: luminance and chromaticities
// of a cloudless sky by turbidity T and zenith angle of the sun t_s, each by the formula of Perez
//
//   F(t, s) = (1 + A e^(B / cos t)) (1 + C e^(D s) + E cos^2 s),   value = value_z F(t, s) / F(0, t_s)
//
// with t the angle from the zenith and s that from the sun. Luminance in kcd/m^2, here divided by
// 683 lm/W: W/m^2/sr, linear Rec.709, what is out of its gamut cut off. Fitted for T from 2 to 6 and
// used up to 10; near the horizon it is too bright by up to a half (Zotti, Wilkie, Purgathofer 2007).
#pragma once

#include "scenes/types.h"

namespace meninas {

/// Zenith values: luminance in kcd/m^2 and the chromaticities x and y.
struct SkyColour {
  double luminance = 0.0, x = 0.0, y = 0.0;
};
SkyColour preetham_zenith(double turbidity, double sun_zenith_angle);

/// The sky of one sun.
class PreethamSky {
public:
  PreethamSky(double turbidity, const Direction& sun);
  /// The colour and radiance of a direction above the horizon.
  SkyColour colour(const Direction& d) const;
  Rgb radiance(const Direction& d) const;

private:
  struct Perez {
    double a, b, c, d, e, over_zenith;
    double operator()(double cos_zenith, double from_sun) const;
  };
  static Perez perez(const double (&slope)[5], const double (&offset)[5], double turbidity,
                     double zenith_value, double sun_zenith_angle);
  Direction sun_;
  Perez luminance_, x_, y_;
};

/// Linear Rec.709 of CIE 1931 XYZ, both relative to the same white of Y = 1; may be negative.
Rgb rec709_of_xyz(const Vec3& xyz);

} // namespace meninas
