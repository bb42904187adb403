#include "raytrace/beams/coherent_beams.h"

#include "raytrace/scattering.h"
#include "raytrace/specular_rays.h"
#include "raytrace/pixels/render_context.h"
#include "raytrace/tile.h"
#include "raytrace/wide_lanes.h"
#include "scenes/rays/frame_geometry.h"

#include <algorithm>
#include <limits>

namespace meninas {

namespace {

constexpr int min_rays = 16; ///< of a block: fewer are traced sooner than asked

struct Block {
  int x, y, width, height; ///< pixels of the tile
};

PictureBlock picture_block(const Block& block) {
  const double half_u = 0.5 * block.width, half_v = 0.5 * block.height;
  return {block.x + half_u, block.y + half_v, half_u, half_v};
}

/// A tile in search of its paths.
struct Search {
  const RenderContext& context;
  const TileArea& tile;
  CoherentBeams& sure;
  int min_pixels;

  /// Finds what reaches into the tile's frustum.
  std::uint32_t add_leg(FrustumLeg leg) {
    const Vec2 corner(tile.width, tile.height);
    const Frustum f = frustum_of(leg.rays, corner);
    leg.longest = longest_direction(leg.rays, corner);
    leg.first = static_cast<std::uint32_t>(sure.pieces.size());
    for (const FrustumFace& face : context.frustum_faces) {
      if (face.plane == leg.leaving || is_outside(f, face.around))
        continue;
      const ConvexPolygon part =
          clip_to(f, ConvexPolygon(std::span(face.corners).first(face.corner_count)));
      if (!part.empty())
        sure.pieces.push_back({&face, view_of(leg.rays, face, part)});
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

  /// Asks a block for its path behind the mirrors of a leg,
  /// of which the pieces from `first` to `last` come near it.
  void ask(const Block& block, std::uint32_t leg, std::size_t first, std::size_t last) {
    const PictureBlock seen = picture_block(block);
    const double longest = sure.legs[leg].longest;
    const std::size_t begin = sure.in_block.size();
    for (std::size_t k = first; k < last; ++k) {
      const std::uint32_t candidate = sure.in_block[k];
      const FrustumPiece& piece = sure.pieces[candidate];
      // The eye looks through backs.
      const bool unseen = leg == 0 && piece.face->single_sided && sees_back(piece.view, seen);
      if (!unseen && !is_outside(piece.view, seen, longest))
        sure.in_block.push_back(candidate);
    }
    if (!settle(block, leg, seen, begin) && block.width * block.height >= 2 * min_pixels)
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

  /// Whether all else in the block is behind a piece that covers it.
  bool is_first(const FrustumPiece& piece, const PictureBlock& block, std::size_t begin) const {
    return std::ranges::all_of(std::span(sure.in_block).subspan(begin), [&](std::uint32_t k) {
      const FrustumPiece& other = sure.pieces[k];
      // Rays meet the side of a sheet that faces them.
      return &other == &piece ||
             (other.face->plane == piece.face->plane && other.face->single_sided &&
              sees_back(other.view, block)) ||
             is_behind(piece.view, other.view, block);
    });
  }

  /// The piece that all rays of the block meet, if that is certain.
  const FrustumPiece* met_by_all(const PictureBlock& block, double longest,
                                 std::size_t begin) const {
    const FrustumPiece* first = nullptr;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = begin; k < sure.in_block.size(); ++k) {
      const FrustumPiece& piece = sure.pieces[sure.in_block[k]];
      const double distance = distance_in_middle(piece.view, block);
      if (distance < nearest && piece.face->can_be_sure &&
          !(piece.face->single_sided && sees_back(piece.view, block)) &&
          covers(piece.view, block, longest)) {
        first = &piece;
        nearest = distance;
      }
    }
    return first && is_first(*first, block, begin) ? first : nullptr;
  }

  /// Whether nothing is gained by dividing the block.
  bool settle(const Block& block, std::uint32_t at, const PictureBlock& seen, std::size_t begin) {
    const std::size_t end = sure.in_block.size();
    if (begin == end) {
      // The sky is looked up by rays that have directions.
      if (context.visible.sky == nullptr)
        mark(block, at, nullptr, true);
      return true;
    }
    const FrustumPiece* piece = met_by_all(seen, sure.legs[at].longest, begin);
    if (!piece)
      return false;
    const FrustumFace* met = piece->face;
    const bool front = !sees_back(piece->view, seen);
    const LightScene& light = context.light;
    const FaceRecord& face = light.landing.faces[2 * std::size_t{met->triangle} + (front ? 0 : 1)];
    const bool has_side = face.side != FaceRecord::nothing;
    const bool shows_lobes = !context.bsdfs.empty() && (has_side || face.mirrors) &&
                             has_lobes(material_of(light.scene, TriangleId{met->triangle}));
    const bool turns = face.mapped || (face.mirrors && face.curved);
    const bool shows_lights = face.mirrors && !light.scene.area_lights.empty();
    if (shows_lobes || turns || shows_lights ||
        (has_side && (face.mirrors || context.visible.shading[face.side].is_by_point())))
      return true;
    if (!face.mirrors || context.settings.mode != RenderMode::hybrid) {
      mark(block, at, met, front);
      return true;
    }
    constexpr std::int32_t max_mirrors = 12;
    const FrustumLeg& leg = sure.legs[at];
    if (leg.mirrors == max_mirrors ||
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
        sure.paths, [&](const CoherentBeam& path) { return path.leg == at && path.triangle == id; });
    const auto number = static_cast<std::uint16_t>(known - sure.paths.begin());
    if (known == sure.paths.end())
      sure.paths.push_back(path_to(at, met, front));
    for (int y = block.y; y < block.y + block.height; ++y)
      for (int x = block.x; x < block.x + block.width; ++x)
        sure.path_of[static_cast<std::size_t>(y * tile.width + x)] = number;
  }

  CoherentBeam path_to(std::uint32_t at, const FrustumFace* met, bool front) const {
    const FrustumLeg& leg = sure.legs[at];
    CoherentBeam path{.leg = at, .front = front, .mirrors = leg.mirrors, .throughput = leg.throughput};
    if (!met)
      return path;
    path.triangle = met->triangle;
    const Vec2 size(context.settings.width, context.settings.height);
    path.corner = glm::vec2(Vec2(tile.x0, tile.y0) / size);
    const LandingForms forms =
        landing_forms(corners_of(context.light.rays.geometry(), met->triangle), leg.rays);
    const Vec3 in_pictures(1.0, size);
    path.b1 = in_pictures * forms.b1;
    path.b2 = in_pictures * forms.b2;
    path.over = in_pictures * forms.over;
    return path;
  }
};

/// The rays of the camera, at (x, y) pixels of the tile.
PictureRays rays_of(const CameraFrame& camera, const TileArea& tile,
                    const RenderSettings& settings) {
  const Vec2 pixel = 1.0 / Vec2(settings.width, settings.height);
  const double x = tile.x0 * pixel.x, y = tile.y0 * pixel.y;
  // Rays that start in a section plane are those from the eye, from there on.
  const double section = camera.section;
  const auto from_eye = [&](const glm::vec3& origin, const glm::vec3& direction) {
    return section > 0.0 ? Vec3(origin) - section * Vec3(direction) : Vec3(origin);
  };
  const Vec3 origin_x = from_eye(camera.origin_x, camera.direction_x),
             origin_y = from_eye(camera.origin_y, camera.direction_y);
  PictureRays rays{from_eye(camera.origin, camera.direction) + x * origin_x + y * origin_y,
                   pixel.x * origin_x,
                   pixel.y * origin_y,
                   Vec3(camera.direction) + x * Vec3(camera.direction_x) +
                       y * Vec3(camera.direction_y),
                   pixel.x * Vec3(camera.direction_x),
                   pixel.y * Vec3(camera.direction_y),
                   {}};
  const Vec2 corner(tile.width, tile.height);
  // All of the picture goes ahead from the plane through its middle ray;
  // of that of a tile's own, not even all of the tile where the view is wide.
  const Direction n = glm::normalize(Vec3(camera.direction) + 0.5 * Vec3(camera.direction_x) +
                                     0.5 * Vec3(camera.direction_y));
  rays.near = {n, glm::dot(n, rays.origin) + section +
                      std::min(0.0, corner.x * glm::dot(n, rays.origin_x)) +
                      std::min(0.0, corner.y * glm::dot(n, rays.origin_y))};
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

void find_coherent_beams(const RenderContext& context, const TileArea& tile, CoherentBeams& sure) {
  const auto pixels = static_cast<std::size_t>(tile.width * tile.height);
  const std::size_t samples = context.net_x.size();
  sure.paths.clear();
  sure.path_of.assign(pixels, CoherentBeams::unknown);
  const std::size_t rays = samples * chosen_pixels(context, tile);
  if (context.filter || context.frustum_faces.empty() ||
      rays < rays_to_a_face * context.frustum_faces.size())
    return;
  sure.legs.clear();
  sure.pieces.clear();
  sure.in_block.clear();
  Search search{context, tile, sure, std::max(1, min_rays / static_cast<int>(samples))};
  search.add_leg({.rays = rays_of(context.camera, tile, context.settings)});
  if (rays < rays_to_a_piece * sure.pieces.size())
    return;
  for (std::uint32_t k = 0; k < sure.pieces.size(); ++k)
    sure.in_block.push_back(k);
  search.ask({0, 0, tile.width, tile.height}, 0, 0, sure.in_block.size());
}

MENINAS_WIDE_LANES
void land_surely(const CoherentBeam& path, const std::array<float, packet_size>& x,
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
