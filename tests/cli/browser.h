// Pages in a real browser.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace meninas::test {

/// Opens the page, a file in `folder`, in a window of so many pixels; runs its scripts and then
/// `use`, the body of a function, and returns what that returns.
nlohmann::json browse_page(const std::filesystem::path& folder, const std::string& page,
                           const std::string& use, int width = 1200);

/// RFC 4648, section 4, up to its padding.
std::vector<std::byte> from_base64(const std::string& text);

/// The same with WebGL 2 in software, at `#fragment` of the page; `use` is the body of an async function.
/// Null where the browser does not say what came of it.
nlohmann::json browse_drawn_page(const std::filesystem::path& folder, const std::string& page,
                                 const std::string& fragment, const std::string& use);

/// Whether there is a browser to do it.
bool has_browser();

} // namespace meninas::test
