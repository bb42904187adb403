#include "scenes/materials/bsdf.h"

#include "scenes/materials/lobes.h"
#include "scenes/materials/microfacets.h"
#include "scenes/materials/refraction.h"
#include "scenes/materials/sheen.h"
#include "scenes/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

namespace {

/// The coat's Fresnel reflectance for light that meets a facet at this cosine (Schlick 1994),
/// over the whole surface.
Rgb coat_fresnel(const Bsdf& bsdf, double cosine) {
  if (bsdf.coat == 0.0)
    return Rgb(0.0);
  const double x = 1.0 - std::clamp(cosine, 0.0, 1.0);
  const Rgb base = glm::mix(bsdf.coat_f0, Rgb(bsdf.coat_f90), x * x * x * x * x);
  return bsdf.film.share == 0.0 ? base
                                : below_film(bsdf.film, base, film_over_coat(bsdf, cosine));
}

/// 1 - E of the facets: the share of light from a direction that meets them more than once.
double met_again(const Bsdf& bsdf, const Direction& w) {
  const SchlickAlbedo e = lobe_albedo(bsdf, w);
  return std::max(0.0, 1.0 - e.f0 - e.f90);
}

bool has_facets_of_metal(const Bsdf& bsdf) { return bsdf.alpha > 0.0 && bsdf.metal != Rgb(0.0); }

/// What comes out of it in the end:
/// rho^2 E_avg / (1 - rho (1 - E_avg)), as every further meeting reflects rho again.
Rgb spread_by_facets(const Bsdf& bsdf, double mean_again) {
  return bsdf.metal * bsdf.metal * (1.0 - mean_again) / (1.0 - bsdf.metal * mean_again);
}

SchlickAlbedo mean_lobe_albedo(const Bsdf& bsdf) {
  return has_round_facets(bsdf) ? mean_schlick_albedo(bsdf.roughness)
                                : mean_schlick_albedo(facets_of(bsdf));
}

double mean_met_again(const Bsdf& bsdf) {
  const SchlickAlbedo mean = mean_lobe_albedo(bsdf);
  return std::max(0.0, 1.0 - mean.f0 - mean.f90);
}

/// Chances to choose the lobes: what they reflect, about.
struct LobeChances {
  double diffuse = 0.0, reflection = 0.0, transmission = 0.0, passed = 0.0;
};
LobeChances lobe_chances(const Bsdf& bsdf, const Direction& out) {
  const double e = coat_albedo(bsdf, out);
  LobeChances chances{largest(bsdf.diffuse) * (1.0 - e), largest(bsdf.metal) + bsdf.coat * e};
  chances.passed = largest(bsdf.passed) * (1.0 - e);
  if (bsdf.sheen != Rgb(0.0))
    chances.diffuse += largest(bsdf.sheen) * sheen_albedo(bsdf.sheen_roughness, out.z);
  if (bsdf.glass > 0.0) {
    const GlassShares glass = glass_shares(bsdf.pane, out.z);
    chances.reflection += bsdf.glass * largest(glass.reflected);
    chances.transmission = bsdf.glass * largest(glass.passed);
  }
  if (has_facets_of_metal(bsdf)) {
    const double again = met_again(bsdf, out);
    chances.diffuse += again * largest(spread_by_facets(bsdf, mean_met_again(bsdf)));
    chances.reflection -= again * largest(bsdf.metal);
  }
  const double sum = chances.diffuse + chances.reflection + chances.transmission + chances.passed;
  if (sum > 0.0) {
    chances.diffuse /= sum;
    chances.reflection /= sum;
    chances.transmission /= sum;
    chances.passed /= sum;
  }
  return chances;
}

/// 1 - e_avg: the share of even light that gets below the coat.
double mean_below_coat(const Bsdf& bsdf) {
  if (bsdf.coat == 0.0)
    return 1.0;
  const SchlickAlbedo mean = mean_lobe_albedo(bsdf);
  const double base = mean.f0 * largest(bsdf.coat_f0) + mean.f90 * bsdf.coat_f90;
  return std::max(0.0, 1.0 - std::lerp(base, (mean.f0 + mean.f90) * bsdf.film_on_coat.largest,
                                       bsdf.film.share));
}

/// What the coat reflects of even light.
Rgb mean_of_coat(const Bsdf& bsdf) {
  if (bsdf.coat == 0.0)
    return Rgb(0.0);
  const SchlickAlbedo mean = mean_lobe_albedo(bsdf);
  const Rgb base = mean.f0 * bsdf.coat_f0 + Rgb(mean.f90 * bsdf.coat_f90);
  return bsdf.coat * below_film(bsdf.film, base, (mean.f0 + mean.f90) * bsdf.film_on_coat.reflectance);
}

/// rho (1 - e(o)) (1 - e(i)) / (1 - e_avg) of rho_d or tau_d, and likewise below fibres. With both
/// the mean of the product is below that of either: never too much.
Rgb coupled(const Bsdf& bsdf, const Rgb& rho, const Direction& out, const Direction& in) {
  if (bsdf.coat == 0.0 && bsdf.sheen == Rgb(0.0))
    return rho;
  const double below = std::min(mean_below_coat(bsdf), mean_below_sheen(bsdf));
  if (below == 0.0)
    return Rgb(0.0);
  const double both = below_sheen(bsdf, out.z) * below_sheen(bsdf, in.z);
  return rho *
         ((1.0 - coat_albedo(bsdf, out)) * (1.0 - coat_albedo(bsdf, in)) * both / below);
}

/// (1 - E(o)) (1 - E(i)) / (pi (1 - E_avg)) of what facets of metal spread.
Rgb spread_metal(const Bsdf& bsdf, const Direction& out, const Direction& in) {
  const double mean_again = mean_met_again(bsdf);
  if (mean_again < 1e-6)
    return Rgb(0.0);
  return spread_by_facets(bsdf, mean_again) *
         (met_again(bsdf, out) * met_again(bsdf, in) / (std::numbers::pi * mean_again));
}

/// D G2 / (4 cos_o cos_i) and the density of sampling visible facets and reflecting at them.
struct FacetLobe {
  double f = 0.0, density = 0.0, cosine = 0.0; ///< cosine: o.h
};
FacetLobe facet_lobe(const Bsdf& bsdf, const Direction& out, const Direction& in) {
  const Direction h = glm::normalize(out + in);
  const Facets facets = facets_of(bsdf);
  const double d = facet_density(facets, h);
  const double lambda_out = smith_lambda(facets, out), lambda_in = smith_lambda(facets, in);
  const double quarter = 0.25 / out.z;
  return {d * quarter / (in.z * (1.0 + lambda_out + lambda_in)), d * quarter / (1.0 + lambda_out),
          glm::dot(out, h)};
}

BsdfSample spread_sample(const Bsdf& bsdf, const Direction& out, const Direction& in) {
  const double density = sample_density(bsdf, out, in);
  const Rgb weight =
      density > 0.0 ? evaluate(bsdf, out, in) * (std::abs(in.z) / density) : Rgb(0.0);
  return {in, weight, density, Lobe::spread};
}

} // namespace

/// To the light of punctual lights a solid is two sheets,
/// each of which takes half of what its thickness does.
static Rgb left_by_half(const Material& material, const MaterialPoint& point) {
  return is_solid_glass(material) ? attenuation(material, 0.5 * point.thickness) : Rgb(1.0);
}

SchlickAlbedo lobe_albedo(const Bsdf& bsdf, const Direction& w) {
  return has_round_facets(bsdf) ? schlick_albedo(bsdf.roughness, w.z)
                                : schlick_albedo(facets_of(bsdf), w);
}

double coat_albedo(const Bsdf& bsdf, const Direction& w) {
  if (bsdf.coat == 0.0)
    return 0.0;
  const SchlickAlbedo e = lobe_albedo(bsdf, w);
  const double base = e.f0 * largest(bsdf.coat_f0) + e.f90 * bsdf.coat_f90;
  if (bsdf.film.share == 0.0)
    return std::min(1.0, base);
  // The film is met at the cosine at which (1 - c)^5 has its mean over the lobe: at a grazing look the
  // facets face the eye more than the surface does. The table does not tell them apart at a steep one.
  const double all = e.f0 + e.f90, grazing = std::max(0.0, e.f90 / all);
  const double cosine = std::clamp(std::max(w.z, 1.0 - std::pow(grazing, 0.2)), 0.0, 1.0);
  const double of_film = all * largest(film_over_coat(bsdf, cosine));
  return std::min(1.0, std::lerp(base, of_film, bsdf.film.share));
}

Rgb straight_transmission(const Bsdf& bsdf, double cosine) {
  return is_open(bsdf) || (bsdf.alpha == 0.0 && bsdf.pane.faces == GlassFaces::both)
             ? facet_transmittance(bsdf, cosine)
             : Rgb(0.0);
}

Rgb ideal_reflection(const Bsdf& bsdf, double cosine) {
  return bsdf.alpha == 0.0 ? below_sheen(bsdf, cosine) * facet_reflectance(bsdf, cosine)
                           : Rgb(0.0);
}

Rgb facet_reflectance(const Bsdf& bsdf, double cosine) {
  Rgb reflected = metal_reflectance(bsdf, cosine) + bsdf.coat * coat_fresnel(bsdf, cosine);
  if (bsdf.glass > 0.0)
    reflected += bsdf.glass * glass_shares(bsdf.pane, cosine).reflected;
  return reflected;
}

Rgb facet_transmittance(const Bsdf& bsdf, double cosine) {
  return bsdf.glass > 0.0 ? bsdf.glass * glass_shares(bsdf.pane, cosine).passed : Rgb(0.0);
}

Rgb reflection_lobe(const Bsdf& bsdf, const Direction& out, const Direction& in) {
  if (bsdf.alpha == 0.0 || (bsdf.coat == 0.0 && bsdf.glass == 0.0 && bsdf.metal == Rgb(0.0)))
    return Rgb(0.0);
  const FacetLobe lobe = facet_lobe(bsdf, out, in);
  return lobe.f * lobe_below_sheen(bsdf, out.z, in.z) * facet_reflectance(bsdf, lobe.cosine);
}

LobeShares lobe_shares(const Bsdf& bsdf, const Direction& out, const Direction& in) {
  const Rgb lobe = reflection_lobe(bsdf, out, in);
  if (lobe == Rgb(0.0))
    return {};
  const Rgb f = evaluate(bsdf, out, in);
  LobeShares shares;
  for (int band = 0; band < 3; ++band)
    shares.gloss[band] = f[band] > 0.0 ? std::min(1.0, lobe[band] / f[band]) : 0.0;
  if (bsdf.glass == 0.0)
    return shares;
  Bsdf alone = bsdf;
  alone.metal = Rgb(0.0);
  alone.coat = 0.0;
  const Rgb of_glass = reflection_lobe(alone, out, in) / glm::max(lobe, Rgb(1e-300));
  shares.glass = shares.gloss * glm::min(of_glass, Rgb(1.0));
  shares.gloss -= shares.glass;
  return shares;
}

Rgb even_reflectance(const Bsdf& bsdf, const Direction& out) {
  Rgb share = bsdf.diffuse * (1.0 - coat_albedo(bsdf, out));
  if (has_facets_of_metal(bsdf))
    share += spread_by_facets(bsdf, mean_met_again(bsdf)) * met_again(bsdf, out);
  if (bsdf.sheen == Rgb(0.0))
    return share;
  return below_sheen(bsdf, out.z) * share +
         bsdf.sheen * sheen_albedo(bsdf.sheen_roughness, out.z);
}

Rgb metal_all_in_lobe(const Bsdf& bsdf, const Direction& out) {
  if (!has_facets_of_metal(bsdf))
    return bsdf.metal;
  const double again = met_again(bsdf, out);
  return bsdf.metal + spread_by_facets(bsdf, mean_met_again(bsdf)) * (again / (1.0 - again));
}

Rgb even_transmittance(const Bsdf& bsdf, const Direction& out) {
  return bsdf.passed * ((1.0 - coat_albedo(bsdf, out)) * below_sheen(bsdf, out.z));
}

/// Without fibres.
static Rgb mean_below_fibres(const Bsdf& bsdf) {
  Rgb share = bsdf.diffuse;
  if (bsdf.coat > 0.0)
    share = share * mean_below_coat(bsdf) + mean_of_coat(bsdf);
  if (!has_facets_of_metal(bsdf))
    return share + bsdf.metal;
  const double again = mean_met_again(bsdf);
  return share + bsdf.metal * (1.0 - again) + spread_by_facets(bsdf, again) * again;
}

Rgb mean_reflectance(const Bsdf& bsdf) {
  const Rgb below = mean_below_fibres(bsdf);
  return bsdf.sheen == Rgb(0.0) ? below
                                : mean_below_sheen(bsdf) * below +
                                      bsdf.sheen * mean_sheen_albedo(bsdf.sheen_roughness);
}

bool has_lobes(const Material& material) {
  const bool is_painted_mirror =
      is_mirror(material) && (material.base_color_texture || material.iridescence > 0.0);
  return is_glass(material) || is_glossy(material) || has_visible_coat(material) ||
         is_painted_mirror || material.sheen_color != Rgb(0.0);
}

bool has_visible_coat(const Material& material) {
  const bool all_glass =
      material.transmission == 1.0 && !material.transmission_texture && !is_blended(material);
  if (material.specular == 0.0 || all_glass)
    return false;
  return material.metallic_roughness_texture ||
         (material.metallic < 1.0 && material.roughness <= visible_coat_roughness);
}

Rgb diffuse_reflectance(const Material& material) {
  return diffuse_reflectance(material, untextured(material));
}

Rgb diffuse_reflectance(const Material& material, const MaterialPoint& point) {
  Bsdf bsdf = make_bsdf(material, point);
  if (is_mirror(material))
    bsdf.metal = Rgb(0.0);
  if (!has_mirror_coat(material))
    return mean_reflectance(bsdf);
  bsdf.roughness = bsdf.alpha = 0.0;
  return bsdf.diffuse * mean_below_coat(bsdf);
}

Rgb diffuse_transmittance(const Material& material, const MaterialPoint& point) {
  const Bsdf bsdf = make_bsdf(material, point);
  return bsdf.passed * (mean_below_coat(bsdf) * mean_below_sheen(bsdf));
}

Bsdf clear_glass(const Material& material, const MaterialPoint& point) {
  // Rays meet glass by the million, and a film's means over metals and coats that are left out here take long.
  MaterialPoint bare = point;
  if (!is_mirror(material))
    bare.film.share = 0.0;
  Bsdf clear = make_bsdf(material, bare);
  clear.film = point.film;
  if (clear.pane.faces != GlassFaces::none)
    clear.pane.film = point.film;
  if (!is_mirror(material))
    clear.metal = Rgb(0.0);
  clear.diffuse = clear.passed = clear.sheen = Rgb(0.0);
  clear.coat = 0.0;
  clear.roughness = clear.alpha = 0.0;
  clear.pane.tint *= left_by_half(material, point);
  return clear;
}

Bsdf mirror_coat(const Material& material) {
  Bsdf coat = make_bsdf(material, untextured(material));
  coat.diffuse = coat.passed = coat.metal = coat.sheen = Rgb(0.0);
  coat.glass = 0.0;
  coat.roughness = coat.alpha = 0.0;
  return coat;
}

Rgb coat_transmittance(const Bsdf& coat, double cosine) {
  const double below = mean_below_coat(coat);
  return Rgb(below > 0.0 ? (1.0 - coat_albedo(coat, {0.0, 0.0, cosine})) / below : 0.0);
}

GlassShares mean_shares(const Bsdf& clear) {
  const GlassShares mean = mean_glass_shares(clear.pane);
  return {clear.metal + mean_of_coat(clear) + clear.glass * mean.reflected,
          clear.glass * mean.passed};
}

Rgb evaluate(const Bsdf& bsdf, const Direction& out, const Direction& in) {
  if (out.z <= 0.0 || in.z == 0.0)
    return Rgb(0.0);
  if (in.z < 0.0) {
    const Direction above{in.x, in.y, -in.z};
    Rgb f(0.0);
    if (bsdf.passed != Rgb(0.0))
      f = coupled(bsdf, bsdf.passed, out, above) * std::numbers::inv_pi;
    if (bsdf.alpha == 0.0 || bsdf.glass == 0.0 || is_open(bsdf))
      return f;
    const FacetLobe lobe = facet_lobe(bsdf, out, above);
    return f + lobe.f * facet_transmittance(bsdf, lobe.cosine);
  }
  Rgb f = coupled(bsdf, bsdf.diffuse, out, in) * std::numbers::inv_pi;
  f += reflection_lobe(bsdf, out, in);
  if (has_facets_of_metal(bsdf))
    f += lobe_below_sheen(bsdf, out.z, in.z) * spread_metal(bsdf, out, in);
  return f + sheen_lobe(bsdf, out.z, in.z);
}

double sample_density(const Bsdf& bsdf, const Direction& out, const Direction& in) {
  if (out.z <= 0.0 || in.z == 0.0)
    return 0.0;
  const LobeChances chances = lobe_chances(bsdf, out);
  const double facet_chance = in.z > 0.0     ? chances.reflection
                              : is_open(bsdf) ? 0.0
                                              : chances.transmission;
  double density =
      (in.z > 0.0 ? chances.diffuse : chances.passed) * std::abs(in.z) * std::numbers::inv_pi;
  if (bsdf.alpha > 0.0 && facet_chance > 0.0)
    density += facet_chance * facet_lobe(bsdf, out, {in.x, in.y, std::abs(in.z)}).density;
  return density;
}

std::optional<BsdfSample> sample(const Bsdf& bsdf, const Direction& out,
                                 const std::array<double, 3>& u) {
  const LobeChances chances = lobe_chances(bsdf, out);
  const double even = chances.diffuse + chances.passed;
  if (out.z <= 0.0 || even + chances.reflection + chances.transmission == 0.0)
    return std::nullopt;
  if (u[0] < even) {
    const glm::vec3 in = cosine_hemisphere(static_cast<float>(u[1]), static_cast<float>(u[2]));
    return spread_sample(bsdf, out,
                         glm::normalize(Vec3(in.x, in.y, u[0] < chances.diffuse ? in.z : -in.z)));
  }
  const bool through = u[0] >= even + chances.reflection && chances.transmission > 0.0;
  if (bsdf.alpha == 0.0 || (through && is_open(bsdf))) {
    if (through) {
      const auto behind = direction_behind(bsdf.pane, out);
      if (!behind)
        return std::nullopt;
      return BsdfSample{*behind, facet_transmittance(bsdf, out.z) / chances.transmission, 0.0,
                        Lobe::straight};
    }
    return BsdfSample{{-out.x, -out.y, out.z},
                      ideal_reflection(bsdf, out.z) / chances.reflection,
                      0.0,
                      Lobe::ideal_reflection};
  }
  const Direction h = visible_facet(facets_of(bsdf), out, u[1], u[2]);
  const Direction in = 2.0 * glm::dot(out, h) * h - out;
  if (in.z <= 0.0)
    return std::nullopt;
  return spread_sample(bsdf, out, {in.x, in.y, through ? -in.z : in.z});
}

} // namespace meninas
