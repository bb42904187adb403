// Shares as people read them.
#pragma once

#include <string>

namespace meninas {

/// "0.45 %", "12 %"; whole per cent from ten on, "over 100 %" beyond what an estimate can tell, and
/// "under 0.01 %" below what matters.
std::string readable_percent(double share);

} // namespace meninas
