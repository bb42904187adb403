#include "scenes/rays/embree_scene.h"

#include "scenes/errors.h"
#include "scenes/rays/embree_filters.h"
#include "scenes/rays/embree_handles.h"

#include <algorithm>

namespace meninas {

namespace {

void check(RTCDevice device) {
  const auto code = rtcGetDeviceError(device);
  if (code == RTC_ERROR_NONE)
    return;
  throw OutputError("", "ray queries",
                    code == RTC_ERROR_OUT_OF_MEMORY
                        ? "not enough memory for the triangles of the scene"
                        : "Embree cannot be used on this machine");
}

Owned<RTCGeometry> make_mesh(RTCDevice device, const FrameGeometry& geometry) {
  Owned<RTCGeometry> mesh(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  check(device);
  auto* positions = static_cast<glm::vec3*>(
      rtcSetNewGeometryBuffer(mesh.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              sizeof(glm::vec3), geometry.positions.size()));
  check(device);
  std::ranges::transform(geometry.positions, positions,
                         [](const Point3& x) { return glm::vec3(x); });
  auto* triangles = static_cast<std::array<std::uint32_t, 3>*>(
      rtcSetNewGeometryBuffer(mesh.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), geometry.triangles.size()));
  check(device);
  std::ranges::transform(geometry.triangles, geometry.facts, triangles, met_by_rays);
  rtcSetGeometryBuildQuality(mesh.get(), RTC_BUILD_QUALITY_HIGH);
  // Filters cost time at every hit: none where nothing is cut out.
  if (std::ranges::any_of(geometry.facts, &TriangleFacts::cut_out)) {
    rtcSetGeometryUserData(mesh.get(), const_cast<FrameGeometry*>(&geometry));
    rtcSetGeometryIntersectFilterFunction(mesh.get(), filter_holes);
    rtcSetGeometryOccludedFilterFunction(mesh.get(), filter_holes);
  }
  rtcCommitGeometry(mesh.get());
  check(device);
  return mesh;
}

} // namespace

RayScene::RayScene(const Scene& scene, const SurfaceModel& surfaces, Holes holes)
    : impl_(std::make_unique<EmbreeHandles>()) {
  impl_->geometry = make_frame_geometry(scene, surfaces, std::move(holes));
  impl_->near_planes = find_near_planes(impl_->geometry, contact_reach);
  impl_->noise = static_cast<float>(impl_->geometry.noise) + lift;
  impl_->device.reset(rtcNewDevice(nullptr));
  check(impl_->device.get());
  impl_->width = packet_width(impl_->device.get());
  impl_->scene.reset(rtcNewScene(impl_->device.get()));
  check(impl_->device.get());

  // Robust traversal is watertight along shared edges.
  rtcSetSceneFlags(
      impl_->scene.get(),
      static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | filter_by_query));
  rtcSetSceneBuildQuality(impl_->scene.get(), RTC_BUILD_QUALITY_HIGH);
  if (!impl_->geometry.triangles.empty()) {
    const auto mesh = make_mesh(impl_->device.get(), impl_->geometry);
    rtcAttachGeometry(impl_->scene.get(), mesh.get());
  }
  rtcCommitScene(impl_->scene.get());
  check(impl_->device.get());
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

const RayFrame& RayScene::frame() const { return impl_->geometry.frame; }
const FrameGeometry& RayScene::geometry() const { return impl_->geometry; }

} // namespace meninas
