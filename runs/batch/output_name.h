// Names of output files from templates: {scene}, {camera}, {mode}, {frame}, {job}.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace meninas {

/// The values of a template's parts. Characters that are not allowed in file names everywhere (all but letters,
/// digits, '.', '_' and '-', and bytes of UTF-8) become '_'; a frame has at least four digits.
struct NameParts {
  std::string scene, camera, mode, job;
  int frame = 0;
};

/// The problem of a template: an unknown part (with a hint),
/// braces that do not match, a name that is no picture's or leaves the output folder.
std::optional<std::string> template_problem(const std::string& name_template);

/// Precondition: the template has no problem.
std::filesystem::path output_name(const std::string& name_template, const NameParts& parts);

} // namespace meninas
