// Materials after glTF's metallic-roughness model, and the reflectances the two passes take from them.
//
//   diffuse reflectance   rho_d = base_color (1 - metallic)
//   specular reflectance  rho_s = base_color metallic
//
// A metal whose roughness is at most `ideal_mirror_roughness` is an ideal mirror of constant reflectance rho_s.
// The lobes of rougher metals, coats and panes are in bsdf.h. Pass two shows those of metals and coats (lobes.h); transmission it does not model
// yet, and `plan` names it.
#pragma once

#include "scenes/types.h"

#include <optional>
#include <string>

namespace meninas {

inline constexpr double ideal_mirror_roughness = 0.01;

/// The Schlick coat of a dielectric shows up to this roughness; a rougher one counts as diffuse.
inline constexpr double visible_coat_roughness = 0.2;

/// Which texture, by which texture coordinates, after which affine map of them (KHR_texture_transform).
struct TextureUse {
  TextureId texture = none<TextureId>;
  int texcoord_set = 0;
  Vec2 offset{0.0};
  double rotation = 0.0; ///< radians, counter-clockwise
  Vec2 scale{1.0};
};

enum class AlphaMode { opaque, mask, blend };

struct Material {
  std::string name;
  Rgb base_color{0.8};   ///< in [0, 1] per channel
  double alpha = 1.0;    ///< in [0, 1]: matters where alpha_mode is not opaque
  double metallic = 0.0; ///< in [0, 1]
  double roughness = 1.0;
  Rgb emission{0.0};         ///< emitted radiance L, W/m^2/sr; emitted radiosity is E = pi L
  bool double_sided = false; ///< false: the front reflects, emits and mirrors, the back is opaque and black
  double ior = 1.5;
  double specular = 1.0; ///< KHR_materials_specular
  Rgb specular_color{1.0};
  double transmission = 0.0;
  AlphaMode alpha_mode = AlphaMode::opaque;
  double alpha_cutoff = 0.5;
  std::optional<TextureUse> base_color_texture;
  std::optional<TextureUse> metallic_roughness_texture;
  std::optional<TextureUse> emissive_texture;
};

/// The reflectance of the material in pass one, which scatters evenly: all that it reflects but the ideal reflection of metals (lobes.h).
Rgb diffuse_reflectance(const Material& material);

/// The reflectance of an ideal mirror; zero for everything that is not one.
Rgb mirror_reflectance(const Material& material);

bool is_mirror(const Material& material);
bool is_emitter(const Material& material);

/// A metal too rough for an ideal mirror.
bool is_glossy(const Material& material);

} // namespace meninas
