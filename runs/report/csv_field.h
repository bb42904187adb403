// A field of a table of comma-separated values (RFC 4180).
#pragma once

#include <string>

namespace meninas {

/// The text, in quotes where it holds what ends a field or a row; a semicolon too, which ends fields in some countries'
/// spreadsheets.
std::string csv_field(const std::string& text);

} // namespace meninas
