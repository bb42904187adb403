// Settings of the loader: the scene of a file that is read, its state, and the rights of the file.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace meninas {

/// The files that a glTF file may name:
/// a stranger's file must not make the program read the user's others.
enum class ExternalFiles { inside_folder, anywhere };

/// The units of the numbers of a file: W/m^2/sr, W/sr and W/m^2, or cd/m^2, candela and lux.
enum class LightUnits { radiometric, photometric };

/// In which of its states a file is shown, and how its numbers are taken.
struct SceneState {
  std::optional<std::string> variant = std::nullopt; ///< of materials: KHR_materials_variants
  std::optional<double> at = std::nullopt; ///< seconds into its animations; the rest pose otherwise
  double light_scale = 1.0; ///< times the intensities of its KHR_lights_punctual
  /// The units of emission and KHR_lights_punctual; as the file says (asset.extras.light_units) or radiometric
  /// otherwise.
  std::optional<LightUnits> units = std::nullopt;
  double luminous_efficacy = 683.0;           ///< lm/W: divides what is photometric
  std::map<std::string, std::string> luminaires = {}; ///< IES files by the node whose light they replace
  auto operator<=>(const SceneState&) const = default;
};

struct GltfSettings {
  /// Name or index of the scene in the file; the file's default otherwise.
  std::optional<std::string> scene = std::nullopt;
  ExternalFiles external_files = ExternalFiles::inside_folder;
  /// Bytes; files and geometry that need more are refused before they are read or decoded.
  std::uint64_t memory_limit = std::uint64_t{1} << 32;
  SceneState state = {};
};

} // namespace meninas
