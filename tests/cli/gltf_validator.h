// What the Khronos validator says of files.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace meninas::test {

/// Whether `npm install --global gltf-validator` has been run here.
bool has_gltf_validator(const std::filesystem::path& folder);

/// Of each file in the folder [name, errors, warnings, what they are].
nlohmann::json validator_findings(const std::filesystem::path& folder, const std::vector<std::string>& files);

} // namespace meninas::test
