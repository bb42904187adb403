// Pages in a real browser.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace meninas::test {

/// Opens the page, a file in `folder`, in a window of so many pixels; runs its scripts and then
/// `use`, the body of a function, and returns what that returns.
nlohmann::json browse_page(const std::filesystem::path& folder, const std::string& page,
                           const std::string& use, int width = 1200);

} // namespace meninas::test
