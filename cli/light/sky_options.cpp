#include "cli/light/sky_options.h"

#include "cli/values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <chrono>
#include <cmath>

namespace meninas {

namespace {

// As of emission in files:
// its square is still in the range of the floats that pictures are made of.
constexpr double brightest_background = 1e30;

/// Two numbers between these bounds, A,B.
Vec2 parse_pair(const std::string& option, const std::string& text, const Vec2& low,
                const Vec2& high) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos)
    throw UsageError(option, fmt::format("'{}' is not two numbers A,B", text));
  const Vec2 pair(parse_number(option, text.substr(0, comma), Sign::any),
                  parse_number(option, text.substr(comma + 1), Sign::any));
  for (int k = 0; k < 2; ++k)
    if (pair[k] < low[k] || pair[k] > high[k])
      throw UsageError(option, fmt::format("{:g} is not between {:g} and {:g} degrees", pair[k],
                                           low[k], high[k]));
  return pair;
}

/// 2026-06-21T12:00Z, with seconds or none; Z or an offset from it, +02:00.
UtcTime parse_time(const std::string& option, const std::string& text) {
  const auto wrong = [&]() -> UsageError {
    return UsageError(option, fmt::format("'{}' is not a time such as 2026-06-21T12:00Z or "
                                          "2026-06-21T14:00+02:00",
                                          text));
  };
  std::size_t at = 0;
  const auto number = [&](std::size_t digits, int low, int high) {
    int value = 0;
    if (text.size() < at + digits)
      throw wrong();
    const char *first = text.data() + at, *last = first + digits;
    if (const auto [end, error] = std::from_chars(first, last, value);
        error != std::errc{} || end != last || value < low || value > high)
      throw wrong();
    at += digits;
    return value;
  };
  const auto skip = [&](char c) {
    const bool is_there = at < text.size() && text[at] == c;
    at += is_there ? 1 : 0;
    return is_there;
  };
  const auto expect = [&](char c) {
    if (!skip(c))
      throw wrong();
  };
  UtcTime time;
  time.year = number(4, 1800, 2100);
  expect('-');
  time.month = number(2, 1, 12);
  expect('-');
  time.day = number(2, 1, 31);
  using namespace std::chrono;
  if (!year_month_day(year(time.year), month(static_cast<unsigned>(time.month)),
                      day(static_cast<unsigned>(time.day)))
           .ok())
    throw wrong();
  expect('T');
  time.hours = number(2, 0, 24);
  expect(':');
  time.hours += number(2, 0, 59) / 60.0;
  if (skip(':'))
    time.hours += number(2, 0, 60) / 3600.0;
  if (time.hours > 24.0)
    throw wrong();
  if (!skip('Z')) {
    const bool east = skip('+');
    if (!east)
      expect('-');
    double offset = number(2, 0, 14);
    expect(':');
    offset += number(2, 0, 59) / 60.0;
    time.hours += east ? -offset : offset;
  }
  if (at != text.size())
    throw wrong();
  return time;
}

void add_sun_options(Options& command, EnvironmentChoice& sky) {
  command
      .add("--sun", "AZIMUTH,ELEVATION",
           "--sky clear|preetham: where the sun stands, degrees clockwise from north (-Z) and above "
           "the horizon",
           [&](const std::string& text) {
             const Vec2 angles = parse_pair("--sun", text, {-360.0, -90.0}, {360.0, 90.0});
             sky.sun = SunAngles{angles.x, angles.y};
           })
      .group(sky_group);
  command
      .add("--place", "LAT,LON", "the same by place, degrees north and east, and --date",
           [&](const std::string& text) {
             const Vec2 place = parse_pair("--place", text, {-90.0, -180.0}, {90.0, 180.0});
             sky.place = GeographicPlace{place.x, place.y};
           })
      .group(sky_group);
  command
      .add("--date", "TIME", "--place: when, such as 2026-06-21T12:00Z or 2026-06-21T14:00+02:00",
           [&](const std::string& text) { sky.time = parse_time("--date", text); })
      .group(sky_group);
  command
      .add("--turbidity", "T",
           fmt::format("--sky clear|preetham: haze, from 2 (very clear) to 10 [{:g}]",
                       SkySettings{}.turbidity),
           [&](const std::string& text) {
             const double turbidity = parse_number("--turbidity", text, Sign::positive);
             if (turbidity < 2.0 || turbidity > 10.0)
               throw UsageError("--turbidity",
                                fmt::format("{:g} is not between 2 and 10", turbidity));
             sky.turbidity = turbidity;
           })
      .group(sky_group);
}

} // namespace

void add_sky_options(Options& command, RunSettings& settings) {
  EnvironmentChoice& sky = settings.environment;
  command
      .add("--background", "L|R,G,B", "radiance of the sky around the scene, W/m^2/sr [0]",
           [&](const std::string& text) {
             const Rgb radiance = parse_colour("--background", text);
             if (!glm::all(glm::lessThanEqual(radiance, Rgb(brightest_background)))) {
               throw UsageError("--background",
                                fmt::format("'{}' is over {:g} W/m^2/sr", text, brightest_background));
             }
             settings.background = radiance;
           })
      .group(light_group);
  command
      .add("--environment", "FILE",
           "a picture of the sky around the scene, equirectangular, .hdr or .exr, W/m^2/sr [none]",
           [&](const std::string& text) { sky.file = text; })
      .group(sky_group);
  command
      .add("--environment-rotation", "DEGREES",
           "turn the sky about the vertical, counter-clockwise seen from above [0]",
           [&](const std::string& text) {
             sky.rotation = parse_number("--environment-rotation", text, Sign::any);
           })
      .group(sky_group);
  command
      .add("--environment-strength", "X", "multiply the radiance of --environment [1]",
           [&](const std::string& text) {
             sky.strength = parse_number("--environment-strength", text, Sign::positive);
           })
      .group(sky_group);
  std::vector<std::string> names;
  for (const SkyKind kind : all_sky_kinds)
    names.emplace_back(name_of(kind));
  command
      .add("--sky", fmt::format("{}", fmt::join(names, "|")),
           "a sky by formula, over a grey ground; clear and preetham with their sun [none]",
           [&sky, names](const std::string& text) {
             for (const SkyKind kind : all_sky_kinds)
               if (name_of(kind) == text) {
                 sky.sky = kind;
                 return;
               }
             refuse_choice("--sky", text, names);
           })
      .group(sky_group);
  add_sun_options(command, sky);
  command
      .add("--sky-illuminance", "LUX",
           fmt::format("--sky: horizontal illuminance without the sun [{:g}, preetham its own]",
                       usual_illuminance),
           [&](const std::string& text) {
             sky.illuminance = parse_number("--sky-illuminance", text, Sign::positive);
           })
      .group(sky_group);
}

} // namespace meninas
