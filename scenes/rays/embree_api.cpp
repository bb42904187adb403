#include "scenes/rays/embree_api.h"

#include <cstring>

namespace meninas {

namespace {

constexpr std::size_t half_packet = packet_size / 2;

/// Fields are arrays of four bytes a ray, one behind the other, in packets of either size.
template <typename Eight, typename Sixteen>
void copy_half(const Sixteen& from, std::size_t first, Eight& to) {
  static_assert(2 * sizeof(Eight) == sizeof(Sixteen));
  constexpr std::size_t bytes = half_packet * sizeof(float);
  for (std::size_t field = 0; field < sizeof(Eight) / bytes; ++field)
    std::memcpy(reinterpret_cast<char*>(&to) + field * bytes,
                reinterpret_cast<const char*>(&from) + 2 * field * bytes + first * sizeof(float),
                bytes);
}

template <typename Eight, typename Sixteen>
void put_half(const Eight& from, std::size_t first, Sixteen& to) {
  constexpr std::size_t bytes = half_packet * sizeof(float);
  for (std::size_t field = 0; field < sizeof(Eight) / bytes; ++field)
    std::memcpy(reinterpret_cast<char*>(&to) + 2 * field * bytes + first * sizeof(float),
                reinterpret_cast<const char*>(&from) + field * bytes, bytes);
}

template <typename Eight, typename Sixteen>
void trace_halves(const TracedScene& scene, const std::int32_t* valid, QueryContext& context,
                  Sixteen& rays) {
  for (std::size_t first = 0; first < packet_size; first += half_packet) {
    Eight eight;
    alignas(32) std::int32_t chosen[half_packet];
    std::memcpy(chosen, valid + first, sizeof chosen);
    copy_half(rays, first, eight);
    trace(chosen, scene.scene, context, eight);
    put_half(eight, first, rays);
  }
}

} // namespace

PacketWidth packet_width(RTCDevice device) {
  const bool sixteen = rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0,
             eight = rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0;
  return eight && !sixteen ? PacketWidth::eight : PacketWidth::sixteen;
}

void trace(const TracedScene& scene, const std::int32_t* valid, QueryContext& context, RTCRayHit16& rays) {
  if (scene.width == PacketWidth::sixteen)
    trace(valid, scene.scene, context, rays);
  else
    trace_halves<RTCRayHit8>(scene, valid, context, rays);
}

void trace(const TracedScene& scene, const std::int32_t* valid, QueryContext& context, RTCRay16& rays) {
  if (scene.width == PacketWidth::sixteen)
    trace(valid, scene.scene, context, rays);
  else
    trace_halves<RTCRay8>(scene, valid, context, rays);
}

} // namespace meninas
