#include "runs/report/percent.h"

#include <fmt/format.h>

namespace meninas {

std::string readable_percent(double share) {
  constexpr double least = 1e-4, ten_percent = 0.0995; // that rounds to 10
  if (share > 1.0)
    return "over 100 %";
  if (share > 0.0 && share < least)
    return "under 0.01 %";
  return share < ten_percent ? fmt::format("{:.2g} %", 100.0 * share)
                             : fmt::format("{:.0f} %", 100.0 * share);
}

std::string about_percent(double share) {
  const std::string text = readable_percent(share);
  return text.starts_with("over") || text.starts_with("under") ? text : "about " + text;
}

} // namespace meninas
