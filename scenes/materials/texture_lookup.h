// Materials at a point: textures decoded, wrapped as their samplers say, and interpolated
// bilinearly between texels; vertex colours, interpolated linearly over their triangle.
//
// A point that stands for a part of its surface, as a sample of a pixel does,
// gets the mean over that part, its footprint: by trilinear look-ups in a pyramid of means,
// as many along the footprint's longer axis as it is longer than the other (McCormack,
// Perry, Farkas, Jouppi 1999, "Feline"), at most 16;
// so textures far away come out as their mean, without moire. Holes are never averaged:
// the colour beside them is that of what is there, and of blended materials the mean weighed by alpha.
// Where metal is where a colour is, the mean of base colour times metalness is not the product of their
// means; it is looked up in a pyramid of its own, and the point keeps the difference, their covariance.
//
// KHR_texture_transform takes (u, v) to offset + R (scale (u, v)) with R = (cos, sin;
// -sin, cos), counter-clockwise as glTF sees it: v runs down the image.
// Texel (i, j) of a w x h image has its centre at ((i + 1/2) / w, (j + 1/2) / h).
//
// Images are decoded by the caller's function, because this folder reads no pictures:
// image/'s decode_image, usually.
#pragma once

#include "scenes/materials/bsdf_parameters.h"
#include "scenes/materials/texture_pixels.h"
#include "scenes/scene.h"

#include <functional>
#include <memory>

namespace meninas {

using DecodeTexture = std::function<TexturePixels(const Texture&, TextureContent)>;

/// The pyramids of the base colour c of a material after its image, which count a texel by the share w of it
/// that is there: texels are the means of (w c, w) and, with the metalness m, of (w c m, w).
/// Empty where plain means do. Limit: the alpha of vertex colours does not count in w.
struct WeighedColours {
  std::vector<TexturePixels> base, metal;
};

/// By TextureId; without texels where no material uses it so.
struct DecodedTextures {
  std::vector<TexturePixels> colours, numbers;
  std::vector<std::shared_ptr<const WeighedColours>> weighed = {}; ///< by MaterialId, from weigh_colours(); null: plain means do
};

/// The textures of a scene that has none.
const DecodedTextures& no_textures();

DecodedTextures decode_textures(const Scene& scene, const DecodeTexture& decode);

/// The pyramids of base colours that are weighed: by the alpha of cut-out and blended materials,
/// and by a texture of metalness that varies and lies as the base colour does. Materials of the same images share
/// them. Once the materials are settled.
void weigh_colours(const Scene& scene, DecodedTextures& textures);

/// Where on the image a texture coordinate falls.
Vec2 transformed_texcoord(const TextureUse& use, Vec2 texcoord);

/// The part of a surface that a point stands for:
/// a parallelogram about it, by its sides. Each function states their unit.
struct Footprint {
  Vec2 longer{0.0}, shorter{0.0};
};

/// The texture's value; `texture` says how it wraps. The footprint is in texture coordinates.
glm::dvec4 texture_value(const TexturePixels& pixels, const Texture& texture, Vec2 uv,
                         const Footprint& footprint = {});

/// The value of a texture at a point of a triangle that shows it, from one of the two lists.
glm::dvec4 texel_at(const Scene& scene, const std::vector<TexturePixels>& list,
                    const TextureUse& use, TriangleId triangle, Vec2 barycentric,
                    const Footprint& footprint);

/// Whether its colours or numbers vary by texture. Normal maps turn it, no more.
bool is_textured(const Material& material);

/// Whether COLOR_0 changes anything on a triangle.
bool has_vertex_colors(const Scene& scene, TriangleId triangle);

/// Factors times textures times vertex colours at a point of a triangle,
/// given by the weights of its second and third corner, as the footprint is.
MaterialPoint material_at(const Scene& scene, const DecodedTextures& textures, TriangleId triangle,
                          Vec2 barycentric, const Footprint& footprint = {});

/// A hole of a cut-out material (alphaMode MASK): nothing is there.
inline bool is_cut_out(const Material& material, const MaterialPoint& point) {
  return material.alpha_mode == AlphaMode::mask && point.alpha < material.alpha_cutoff;
}

} // namespace meninas
