#include "raytrace/sure_paths.h"

#include "raytrace/scattering.h"
#include "raytrace/specular_paths.h"
#include "raytrace/tile.h"
#include "raytrace/wide_lanes.h"
#include "scenes/frame_geometry.h"

#include <algorithm>
#include <limits>

namespace meninas {

namespace {

constexpr int least_rays = 16; ///< of a block: fewer are traced sooner than asked

struct Block {
  int x, y, width, height; ///< pixels of the tile
};

/// A tile in search of its paths.
struct Search {
  const RenderContext& context;
  const TileArea& tile;
  SurePaths& sure;
  int least_pixels;

  Frustum frustum_of_block(const FrustumLeg& leg, const Block& block) const {
    const Vec2 size(context.settings.width, context.settings.height);
    const Vec2 from(tile.x0 + block.x, tile.y0 + block.y);
    return frustum_of(leg.rays, from / size, (from + Vec2(block.width, block.height)) / size);
  }

  /// Finds what reaches into the tile's frustum.
  std::uint32_t add_leg(FrustumLeg leg) {
    const Frustum f = frustum_of_block(leg, {0, 0, tile.width, tile.height});
    leg.first = static_cast<std::uint32_t>(sure.pieces.size());
    for (const FrustumFace& face : context.frustum_faces) {
      if (face.plane == leg.leaving || is_outside(f, face.around))
        continue;
      const ConvexPolygon part =
          clip_to(f, ConvexPolygon(std::span(face.corners).first(face.corner_count)));
      if (!part.empty())
        sure.pieces.push_back({&face, part, ball_around(part.span())});
    }
    leg.last = static_cast<std::uint32_t>(sure.pieces.size());
    sure.legs.push_back(leg);
    return static_cast<std::uint32_t>(sure.legs.size() - 1);
  }

  /// The leg behind a mirror.
  std::uint32_t leg_behind(std::uint32_t parent, const FaceRecord& mirror) {
    for (std::uint32_t k = 1; k < sure.legs.size(); ++k)
      if (sure.legs[k].parent == parent && sure.legs[k].leaving == mirror.plane_class &&
          sure.legs[k].rays.near.normal == mirror.normal)
        return k;
    FrustumLeg leg = sure.legs[parent];
    leg.rays = reflected(leg.rays, {mirror.normal, mirror.frame_offset});
    leg.leaving = mirror.plane_class;
    leg.parent = parent;
    ++leg.mirrors;
    leg.throughput = mirror.reflectance * leg.throughput;
    return add_leg(leg);
  }

  /// Asks a block for its path behind the mirrors of a leg, of which the pieces from `first` to `last` come near it.
  void ask(const Block& block, std::uint32_t leg, std::size_t first, std::size_t last) {
    const Frustum f = frustum_of_block(sure.legs[leg], block);
    const std::size_t begin = sure.in_block.size();
    for (std::size_t k = first; k < last; ++k) {
      const std::uint32_t candidate = sure.in_block[k];
      const FrustumPiece& piece = sure.pieces[candidate];
      // The eye looks through backs.
      const bool unseen = leg == 0 && piece.face->single_sided && sees_back(f, piece.face->normal);
      if (!unseen && !is_outside(f, piece.around) && !is_outside(f, piece.polygon.span()))
        sure.in_block.push_back(candidate);
    }
    if (!settle(block, leg, f, begin) && block.width * block.height >= 2 * least_pixels)
      divide(block, leg, begin);
    sure.in_block.resize(begin);
  }

  void divide(const Block& block, std::uint32_t leg, std::size_t begin) {
    const std::size_t end = sure.in_block.size();
    const int w = (block.width + 1) / 2, h = (block.height + 1) / 2;
    for (const int y : {0, h})
      for (const int x : {0, w}) {
        const Block part{block.x + x, block.y + y, std::min(w, block.width - x),
                         std::min(h, block.height - y)};
        if (part.width > 0 && part.height > 0)
          ask(part, leg, begin, end);
      }
  }

  /// Whether all else in the block's frustum is behind a face that covers it.
  bool is_first(const FrustumFace& face, const Frustum& f, std::size_t begin) const {
    const double side = sees_back(f, face.normal) ? -1.0 : 1.0;
    return std::ranges::all_of(std::span(sure.in_block).subspan(begin), [&](std::uint32_t k) {
      const FrustumPiece& other = sure.pieces[k];
      // Of a sheet, the side that faces the rays is met.
      if (other.face == &face || (other.face->plane == face.plane && other.face->single_sided &&
                                  sees_back(f, other.face->normal)))
        return true;
      return is_behind(face, side, other.polygon.span()) ||
             is_behind(face, side, clip_to(f, other.polygon).span());
    });
  }

  /// The face that all rays of the block meet, if that is certain.
  const FrustumFace* met_by_all(const Frustum& f, std::size_t begin) const {
    const FrustumFace* first = nullptr;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = begin; k < sure.in_block.size(); ++k) {
      const FrustumFace& face = *sure.pieces[sure.in_block[k]].face;
      const bool dark_back = face.single_sided && sees_back(f, face.normal);
      const double distance = distance_to(face, f, 0);
      if (distance < nearest && face.can_be_sure && !dark_back && covers(face, f)) {
        first = &face;
        nearest = distance;
      }
    }
    return first && is_first(*first, f, begin) ? first : nullptr;
  }

  /// Whether nothing is gained by dividing the block.
  bool settle(const Block& block, std::uint32_t at, const Frustum& f, std::size_t begin) {
    const std::size_t end = sure.in_block.size();
    if (begin == end) {
      mark(block, at, nullptr, true);
      return true;
    }
    const FrustumFace* met = met_by_all(f, begin);
    if (!met)
      return false;
    const bool front = !sees_back(f, met->normal);
    const LightScene& light = context.light;
    const FaceRecord& face = light.landing.faces[2 * std::size_t{met->triangle} + (front ? 0 : 1)];
    const bool has_side = face.side != FaceRecord::nothing;
    const bool shows_lobes = !context.bsdfs.empty() && (has_side || face.mirrors) &&
                             has_lobes(material_of(light.scene, TriangleId{met->triangle}));
    if (shows_lobes || (has_side && (face.mirrors || context.visible.shading[face.side].textured)))
      return true;
    if (!face.mirrors || context.settings.mode != RenderMode::hybrid) {
      mark(block, at, met, front);
      return true;
    }
    constexpr std::int32_t most_mirrors = 12;
    const FrustumLeg& leg = sure.legs[at];
    if (leg.mirrors == most_mirrors ||
        !goes_on(context, leg.mirrors + 1, face.reflectance * leg.throughput, 1.0F))
      return true;
    const std::uint32_t behind = leg_behind(at, face);
    for (std::uint32_t k = sure.legs[behind].first; k < sure.legs[behind].last; ++k)
      sure.in_block.push_back(k);
    ask(block, behind, end, sure.in_block.size());
    sure.in_block.resize(end);
    return true;
  }

  void mark(const Block& block, std::uint32_t at, const FrustumFace* met, bool front) {
    const std::uint32_t id = met ? met->triangle : index(none<TriangleId>);
    const auto known = std::ranges::find_if(
        sure.paths, [&](const SurePath& path) { return path.leg == at && path.triangle == id; });
    const auto number = static_cast<std::uint16_t>(known - sure.paths.begin());
    if (known == sure.paths.end())
      sure.paths.push_back(path_to(at, met, front));
    for (int y = block.y; y < block.y + block.height; ++y)
      for (int x = block.x; x < block.x + block.width; ++x)
        sure.path_of[static_cast<std::size_t>(y * tile.width + x)] = number;
  }

  SurePath path_to(std::uint32_t at, const FrustumFace* met, bool front) const {
    const FrustumLeg& leg = sure.legs[at];
    SurePath path{.leg = at, .front = front, .mirrors = leg.mirrors, .throughput = leg.throughput};
    if (!met)
      return path;
    path.triangle = met->triangle;
    path.corner =
        glm::vec2(Vec2(tile.x0, tile.y0) / Vec2(context.settings.width, context.settings.height));
    PictureRays rays = leg.rays;
    const double x = path.corner.x, y = path.corner.y;
    rays.origin += x * rays.origin_x + y * rays.origin_y;
    rays.direction += x * rays.direction_x + y * rays.direction_y;
    const LandingForms forms =
        landing_forms(corners_of(context.light.rays.geometry(), met->triangle), rays);
    path.b1 = forms.b1;
    path.b2 = forms.b2;
    path.over = forms.over;
    return path;
  }
};

PictureRays rays_of(const CameraFrame& camera) {
  PictureRays rays{camera.origin,
                   camera.origin_x,
                   camera.origin_y,
                   camera.direction,
                   camera.direction_x,
                   camera.direction_y,
                   {}};
  const Direction n = glm::normalize(rays.direction + 0.5 * (rays.direction_x + rays.direction_y));
  rays.near = {n, glm::dot(n, rays.origin) + std::min(0.0, glm::dot(n, rays.origin_x)) +
                      std::min(0.0, glm::dot(n, rays.origin_y))};
  return rays;
}

std::size_t chosen_pixels(const RenderContext& context, const TileArea& tile) {
  std::size_t chosen = 0;
  for (int y = tile.y0; y < tile.y0 + tile.height; ++y)
    for (int x = tile.x0; x < tile.x0 + tile.width; ++x)
      chosen += is_chosen(context, x, y) ? 1 : 0;
  return chosen;
}

} // namespace

void find_sure_paths(const RenderContext& context, const TileArea& tile, SurePaths& sure) {
  const auto pixels = static_cast<std::size_t>(tile.width * tile.height);
  const std::size_t samples = context.net_x.size();
  sure.paths.clear();
  sure.path_of.assign(pixels, SurePaths::unknown);
  const std::size_t rays = samples * chosen_pixels(context, tile);
  if (context.filter || context.frustum_faces.empty() ||
      rays < rays_to_a_face * context.frustum_faces.size())
    return;
  sure.legs.clear();
  sure.pieces.clear();
  sure.in_block.clear();
  Search search{context, tile, sure, std::max(1, least_rays / static_cast<int>(samples))};
  search.add_leg({.rays = rays_of(context.camera)});
  if (rays < rays_to_a_piece * sure.pieces.size())
    return;
  for (std::uint32_t k = 0; k < sure.pieces.size(); ++k)
    sure.in_block.push_back(k);
  search.ask({0, 0, tile.width, tile.height}, 0, 0, sure.in_block.size());
}

MENINAS_WIDE_LANES
void land_surely(const SurePath& path, const std::array<float, packet_size>& x,
                 const std::array<float, packet_size>& y, HitPacket& hits) {
  const glm::vec3 f1 = path.b1, f2 = path.b2, over = path.over;
  const float x0 = path.corner.x, y0 = path.corner.y;
  for (std::size_t k = 0; k < packet_size; ++k) {
    const float u = x[k] - x0, v = y[k] - y0;
    const float scale = 1.0F / (over.x + u * over.y + v * over.z);
    hits.b1[k] = scale * (f1.x + u * f1.y + v * f1.z);
    hits.b2[k] = scale * (f2.x + u * f2.y + v * f2.z);
  }
  std::fill_n(hits.triangle, packet_size, path.triangle);
  std::fill_n(hits.distance, packet_size, 0.0F);
  std::fill_n(hits.front, packet_size, path.front ? 1 : 0);
}

} // namespace meninas
