// Materials after glTF's metallic-roughness model,
// and the reflectances the two passes take from them.
//
//   diffuse reflectance   rho_d = base_color (1 - metallic)
//   specular reflectance  rho_s = base_color metallic
//
// A metal whose roughness is at most `ideal_mirror_roughness`,
// without a texture of that, is an ideal mirror of constant reflectance rho_s.
// The lobes of other metals, coats and glass are in bsdf.h. Pass two shows them;
// pass one spreads those of metals and coats evenly, takes smooth metals, and the coats
// of large flat surfaces, for ideal mirrors (smooth_surfaces.h) and glass for clear (lobes.h).
//
// An anisotropic surface (KHR_materials_anisotropy, strength s), brushed metal say, has facets as wide
// as its roughness says across a direction in the surface, and wider along it (materials/microfacets.h):
//
//   alpha_b = roughness^2,   alpha_t = alpha_b + (1 - alpha_b) s^2
//
// Whether it is a mirror or smooth goes by the wider, whether its coat shows by the narrower.
//
// Glass (transmission > 0) is there from both sides: the loader makes it double-sided.
// Without thickness a sheet of it is a whole pane, with both of its faces;
// with one it is the surface of a solid (KHR_materials_volume).
// Where a transmission texture is black, the surface is opaque from both sides.
//
// A translucent surface (diffuse_transmission > 0, KHR_materials_diffuse_transmission: cloth, paper, a
// leaf) passes evenly, as from its other side, what it does not reflect of what gets below its coat,
// and is there from both sides as well:
//
//   rho_d = base_color (1 - t) (1 - metallic),   tau_d = t diffuse_transmission_color (1 - metallic)
//
// A thin film (iridescence > 0, KHR_materials_iridescence) reflects in place of metal, coat and glass
// what interference leaves (materials/thin_film.h).
//
// Alpha of alphaMode BLEND is coverage (materials/coverage.h): such a surface is a pane that passes
// 1 - alpha straight.
#pragma once

#include "scenes/materials/thin_film.h"
#include "scenes/types.h"

#include <limits>
#include <optional>
#include <string>

namespace meninas {

inline constexpr double ideal_mirror_roughness = 0.01;

/// The Schlick coat of a dielectric shows up to this roughness; a rougher one counts as diffuse.
inline constexpr double visible_coat_roughness = 0.2;

/// Which texture, by which texture coordinates,
/// after which affine map of them (KHR_texture_transform).
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
  Rgb emission{0.0}; ///< emitted radiance L, W/m^2/sr; emitted radiosity is E = pi L
  bool specular_in_pass_one =
      false; ///< what this rough metal, or this coat, throws, pass one carries as an ideal mirror does (smooth_surfaces.h)
  bool double_sided =
      false; ///< false: the front reflects, emits and mirrors, the back is opaque and black
  bool unlit = false; ///< KHR_materials_unlit: it shows its base colour, whatever light it receives
  double ior = 1.5;
  double specular = 1.0; ///< KHR_materials_specular
  Rgb specular_color{1.0};
  Rgb sheen_color{0.0}; ///< KHR_materials_sheen (materials/sheen.h), in [0, 1]; black: there is none
  double sheen_roughness = 0.0; ///< in [0, 1]
  double diffuse_transmission = 0.0;   ///< t, in [0, 1]: above 0 it is a translucent surface
  Rgb diffuse_transmission_color{1.0}; ///< in [0, 1]
  double iridescence = 0.0; ///< KHR_materials_iridescence (materials/thin_film.h): the film's share
  double film_ior = 1.3;    ///< in [1, 5]
  double film_min_thickness = 100.0, film_thickness = 400.0; ///< nm, at black and white of its texture
  double transmission = 0.0;
  double thickness =
      0.0; ///< KHR_materials_volume, metres: above 0 what is behind the surface is full of the glass
  Rgb attenuation_color{1.0}; ///< what is left of light after `attenuation_distance` in there
  double attenuation_distance = std::numeric_limits<double>::infinity(); ///< metres
  AlphaMode alpha_mode = AlphaMode::opaque;
  double alpha_cutoff = 0.5;
  std::optional<TextureUse> base_color_texture;
  std::optional<TextureUse> metallic_roughness_texture;
  std::optional<TextureUse> emissive_texture;
  std::optional<TextureUse> transmission_texture; ///< red
  std::optional<TextureUse> thickness_texture;    ///< green
  std::optional<TextureUse> normal_texture;       ///< materials/normal_map.h
  double normal_scale = 1.0;                      ///< of its red and green
  double anisotropy = 0.0; ///< s, in [0, 1]; at the most, where there is a texture
  Vec2 anisotropy_direction{1.0, 0.0}; ///< unit, along the tangent and the bitangent (normal_map.h)
  std::optional<TextureUse> anisotropy_texture; ///< red, green: one to be turned by it; blue: of s
  std::optional<TextureUse> diffuse_transmission_texture; ///< alpha
  std::optional<TextureUse> diffuse_transmission_color_texture;
  std::optional<TextureUse> iridescence_texture;    ///< red
  std::optional<TextureUse> film_thickness_texture; ///< green

  // What is decided before anything is decided by the material, and gone by then:
  // of these textures the constant ones become factors, the others are left out
  // (constant_textures.h).
  double clear_coat = 0.0, clear_coat_roughness = 0.0; ///< lacquer, in [0, 1] (clear_coat.h)
  std::optional<TextureUse> specular_texture;          ///< alpha
  std::optional<TextureUse> specular_color_texture;
  std::optional<TextureUse> sheen_color_texture;
  std::optional<TextureUse> sheen_roughness_texture;      ///< alpha
  std::optional<TextureUse> clear_coat_texture;           ///< red
  std::optional<TextureUse> clear_coat_roughness_texture; ///< green
};

/// An unlit surface (KHR_materials_unlit) has the radiance of its base colour to the eye, by way of
/// mirrors too. To the light of others it is diffuse of that colour: it is no lamp.

/// The reflectance of the material in pass one, which scatters evenly:
/// all that it reflects but the ideal reflection of metals (lobes.h).
Rgb diffuse_reflectance(const Material& material);

/// The reflectance of what is a mirror in pass one, of thin films the mean; zero for everything that
/// is not one.
Rgb mirror_reflectance(const Material& material);

/// The film's share of it all over, or at the most where a texture limits it; its thickness where there
/// is no texture, or the mean of that texture's bounds.
ThinFilm film_of(const Material& material);

/// sqrt(alpha_t): the roughness itself where facets are round.
double widest_roughness(const Material& material);

/// In pass one: an ideal mirror, or a metal that throws light as one.
bool is_mirror(const Material& material);

/// In pass one: diffuse below a coat that is an ideal mirror by Schlick's R(cos).
bool has_mirror_coat(const Material& material);
bool is_emitter(const Material& material);

/// A metal too rough for an ideal mirror, or with a texture that says where it is smooth and metal.
bool is_glossy(const Material& material);

/// alphaMode BLEND with some of the surface left open: its transmission is what is open at the
/// most, and at a point 1 - alpha.
bool is_blended(const Material& material);

/// It passes light evenly to its other side.
bool is_translucent(const Material& material);

/// It lets light through straight or refracted: a pane, the surface of a solid, or what is blended.
bool is_glass(const Material& material);

/// The surface of a solid.
bool is_solid_glass(const Material& material);

} // namespace meninas
