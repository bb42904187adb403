// Shares as people read them.
#pragma once

#include <string>

namespace meninas {

/// "0.45 %", "12 %"; whole per cent from ten on, "over 100 %" beyond what an estimate can tell, and
/// "under 0.01 %" below what matters.
std::string readable_percent(double share);

/// The same of an estimate: "about 0.45 %", but "over 100 %" and "under 0.01 %".
std::string about_percent(double share);

} // namespace meninas
