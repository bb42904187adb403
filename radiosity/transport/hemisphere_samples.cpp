#include "radiosity/transport/hemisphere_samples.h"

#include "radiosity/mesh/element_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meninas {

namespace {

// The loops over lanes are plain enough for the compiler
// to make them run over several lanes at once.

LaneFloats unit_floats(const std::array<std::uint32_t, packet_size>& bits, std::uint32_t shift) {
  LaneFloats floats;
  for (std::size_t k = 0; k < packet_size; ++k)
    floats[k] = static_cast<float>(static_cast<std::int32_t>((bits[k] ^ shift) >> 8U)) * 0x1p-24F;
  return floats;
}

/// Sine and cosine for |x| <= pi / 4 to the rounding of floats:
/// minimax polynomials of the Cephes library.
float near_sine(float x) {
  const float x2 = x * x;
  return x + x * x2 * (-1.6666654611e-1F + x2 * (8.3321608736e-3F - x2 * 1.9515295891e-4F));
}
float near_cosine(float x) {
  const float x2 = x * x;
  return 1.0F - 0.5F * x2 +
         x2 * x2 * (4.166664568e-2F + x2 * (-1.388731625e-3F + x2 * 2.443315712e-5F));
}

/// Origins are computed in double: on the plane to the rounding of a float.
void set_origins(const LanePlaces& places, const ReceiverArea& area, RayPacket& packet) {
  if (area.region != nullptr) {
    for (std::size_t k = 0; k < packet_size; ++k) {
      const Point3 x = point_in_region(area, Vec2(places.s[k], places.t[k]));
      packet.origin_x[k] = static_cast<float>(x.x);
      packet.origin_y[k] = static_cast<float>(x.y);
      packet.origin_z[k] = static_cast<float>(x.z);
    }
    return;
  }
  alignas(64) std::array<double, packet_size> s, t;
  for (std::size_t k = 0; k < packet_size; ++k) {
    const bool fold = area.triangle & (places.s[k] + places.t[k] > 1.0F);
    s[k] = fold ? 1.0F - places.s[k] : places.s[k];
    t[k] = fold ? 1.0F - places.t[k] : places.t[k];
  }
  const Point3 corner = area.corner;
  const Vec3 u = area.edge_u, v = area.edge_v, uv = area.edge_uv;
  for (std::size_t k = 0; k < packet_size; ++k) {
    packet.origin_x[k] =
        static_cast<float>(corner.x + s[k] * u.x + t[k] * v.x + s[k] * t[k] * uv.x);
    packet.origin_y[k] =
        static_cast<float>(corner.y + s[k] * u.y + t[k] * v.y + s[k] * t[k] * uv.y);
    packet.origin_z[k] =
        static_cast<float>(corner.z + s[k] * u.z + t[k] * v.z + s[k] * t[k] * uv.z);
  }
}

} // namespace

Point3 point_in_region(const ReceiverArea& area, Vec2 st) {
  // The triangle that holds the share s of the area, and in it what is left of s.
  const std::vector<double>& up_to = area.region->area_up_to;
  const double wanted = std::clamp(st.x, 0.0, 1.0) * up_to.back();
  const auto k = std::min(static_cast<std::size_t>(std::ranges::upper_bound(up_to, wanted) -
                                                   up_to.begin()),
                          up_to.size() - 1);
  const double before = k == 0 ? 0.0 : up_to[k - 1];
  const double root = std::sqrt(std::clamp((wanted - before) / (up_to[k] - before), 0.0, 1.0));
  const auto& [a, b, c] = area.region->triangles[k];
  const Point3 x = (1.0 - root) * a + root * ((1.0 - st.y) * b + st.y * c);
  return area.region_scale * (x - area.region_centre);
}

HemisphereSamples make_direction_net(int rays, int before) {
  HemisphereSamples net;
  const auto all = static_cast<std::size_t>(std::max(rays, 1));
  net.first = static_cast<std::uint32_t>(before);
  net.points.resize(all - net.first);
  for (std::uint32_t k = 0; k < net.points.size(); ++k) {
    const auto point = sobol4(net.first + k, 0);
    for (std::size_t d = 0; d < 4; ++d)
      net.points[k][d] = static_cast<std::uint32_t>(point[d] * 0x1p32F);
  }

  // Group by the leading bits of the direction:
  // a power-of-two net puts sixteen points into each of its N / 16 cells.
  int cells_log2 = 0;
  while ((all >> (cells_log2 + 4)) > 1)
    ++cells_log2;
  const int bits_u = (cells_log2 + 1) / 2, bits_v = cells_log2 / 2;
  const auto cell_of = [bits_u, bits_v](const std::array<std::uint32_t, 4>& p) {
    const std::uint32_t u = bits_u == 0 ? 0 : p[2] >> (32 - bits_u),
                        v = bits_v == 0 ? 0 : p[3] >> (32 - bits_v);
    return (u << bits_v) | v;
  };
  std::stable_sort(net.points.begin(), net.points.end(),
                   [&cell_of](const auto& a, const auto& b) { return cell_of(a) < cell_of(b); });

  net.packets.resize((net.points.size() + packet_size - 1) / packet_size);
  for (std::size_t k = 0; k < net.points.size(); ++k)
    for (std::size_t d = 0; d < 4; ++d)
      net.packets[k / packet_size].coordinates[d][k % packet_size] = net.points[k][d];
  return net;
}

RaySource ray_source(const ReceiverArea& receiver, const RayFrame& frame, std::uint32_t seed) {
  RaySource source{receiver, frame_along(receiver.normal, receiver.tangent), {}};
  source.area.corner = (receiver.corner - frame.centre) * frame.scale;
  source.area.edge_u *= frame.scale;
  source.area.edge_v *= frame.scale;
  source.area.edge_uv *= frame.scale;
  source.area.region_centre = receiver.region_centre + frame.centre / receiver.region_scale;
  source.area.region_scale = receiver.region_scale * frame.scale;
  for (std::uint32_t d = 0; d < 4; ++d)
    source.shift[d] = hash(seed, d);
  return source;
}

LanePlaces places_of(const NetPacket& net, const RaySource& source) {
  return {unit_floats(net.coordinates[0], source.shift[0]),
          unit_floats(net.coordinates[1], source.shift[1])};
}

LaneDirections cosine_hemisphere(const LaneFloats& u, const LaneFloats& v) {
  constexpr float quarter = std::numbers::pi_v<float> / 4.0F;
  LaneDirections d;
  for (std::size_t k = 0; k < packet_size; ++k) {
    // Squares about the centre become circles; the angle is counted from the nearer axis.
    const float x = 2.0F * u[k] - 1.0F;
    const float y = 2.0F * v[k] - 1.0F;
    const bool wide = std::abs(x) > std::abs(y);
    const float radius = wide ? x : y;
    const float across = wide ? y : x;
    const float angle = quarter * (across / (radius == 0.0F ? 1.0F : radius));
    const float along = radius * near_cosine(angle);
    const float aside = radius * near_sine(angle);
    d.x[k] = wide ? along : aside;
    d.y[k] = wide ? aside : along;
    d.z[k] = 1.0F - radius * radius;
  }
  // The height on the unit sphere;
  // the floor keeps the direction off the plane where rounding has eaten it.
  for (std::size_t k = 0; k < packet_size; ++k)
    d.z[k] = std::sqrt(d.z[k] > 1e-7F ? d.z[k] : 1e-7F);
  return d;
}

void set_directions(const LaneDirections& local, const RaySource& source, RayPacket& packet) {
  const glm::vec3 a(source.tangents.tangent), b(source.tangents.bitangent), n(source.area.normal);
  for (std::size_t k = 0; k < packet_size; ++k) {
    packet.direction_x[k] = local.x[k] * a.x + local.y[k] * b.x + local.z[k] * n.x;
    packet.direction_y[k] = local.x[k] * a.y + local.y[k] * b.y + local.z[k] * n.y;
    packet.direction_z[k] = local.x[k] * a.z + local.y[k] * b.z + local.z[k] * n.z;
  }
}

/// A ray starts on the face that holds the share s of the cluster's area, at what is left of s: a map that keeps
/// shares of area. It leaves about the normal of that face.
static void set_rays_of_faces(const NetPacket& net, const RaySource& source, RayPacket& packet) {
  const LanePlaces places = places_of(net, source);
  const auto local = cosine_hemisphere(unit_floats(net.coordinates[2], source.shift[2]),
                                       unit_floats(net.coordinates[3], source.shift[3]));
  const std::vector<double>& up_to = source.area_up_to;
  for (std::size_t k = 0; k < packet_size; ++k) {
    const double wanted = double{places.s[k]} * up_to.back();
    const auto at = std::ranges::upper_bound(up_to, wanted) - up_to.begin();
    const auto f = std::min(static_cast<std::size_t>(at), up_to.size() - 1);
    const double before = f == 0 ? 0.0 : up_to[f - 1];
    const RaySource& face = source.faces[f];
    const double width = up_to[f] - before;
    const double s = width > 0.0 ? std::clamp((wanted - before) / width, 0.0, 1.0) : 0.5;
    const Point3 x = point_in(face.area, Vec2(s, double{places.t[k]}));
    const Vec3 d = double{local.x[k]} * face.tangents.tangent +
                   double{local.y[k]} * face.tangents.bitangent + double{local.z[k]} * face.area.normal;
    packet.origin_x[k] = static_cast<float>(x.x);
    packet.origin_y[k] = static_cast<float>(x.y);
    packet.origin_z[k] = static_cast<float>(x.z);
    packet.direction_x[k] = static_cast<float>(d.x);
    packet.direction_y[k] = static_cast<float>(d.y);
    packet.direction_z[k] = static_cast<float>(d.z);
    packet.leaving[k] = index(face.area.plane_class);
  }
  std::fill_n(packet.max_distance, packet_size, std::numeric_limits<float>::infinity());
}

void set_rays(const NetPacket& net, const RaySource& source, RayPacket& packet) {
  if (!source.faces.empty()) {
    set_rays_of_faces(net, source, packet);
    return;
  }
  set_origins(places_of(net, source), source.area, packet);
  const auto directions = cosine_hemisphere(unit_floats(net.coordinates[2], source.shift[2]),
                                            unit_floats(net.coordinates[3], source.shift[3]));
  set_directions(directions, source, packet);
  std::fill_n(packet.max_distance, packet_size, std::numeric_limits<float>::infinity());
  std::fill_n(packet.leaving, packet_size, index(source.area.plane_class));
}

} // namespace meninas
