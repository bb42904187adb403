#include "library/impl.h"

#include "cli/settings.h"
#include "image/metrics/metrics.h"
#include "runs/outputs.h"
#include "runs/report/comparison.h"
#include "scenes/errors.h"

#include <algorithm>

namespace meninas {

RoomPicture RoomPicture::read(const std::filesystem::path& file) {
  return guarded([&] {
    ImageFile read = read_image(file, meninas::Picture::not_needed);
    auto impl = std::make_shared<Impl>();
    impl->picture.image = std::move(read.picture);
    impl->picture.layers = std::move(read.layers);
    impl->picture.attributes = std::move(read.attributes);
    impl->encoding = read.encoding;
    impl->inputs = {file};
    if (read.encoding == Encoding::srgb) { // shown as it was
      impl->shown.exposure = 0.0;
      impl->shown.transform = ViewTransform::srgb;
    }
    return RoomPicture(std::move(impl));
  });
}

int RoomPicture::width() const { return impl_->picture.image.width; }
int RoomPicture::height() const { return impl_->picture.image.height; }
std::span<const float> RoomPicture::pixels() const { return floats_of(impl_->picture.image.pixels); }

std::vector<std::string> RoomPicture::layers() const {
  std::vector<std::string> names;
  for (const Layer& layer : impl_->picture.layers)
    names.push_back(layer.name);
  return names;
}

std::span<const float> RoomPicture::layer(const std::string& name) const {
  const auto& layers = impl_->picture.layers;
  const auto found = std::ranges::find(layers, name, &Layer::name);
  if (found == layers.end())
    throw Error(Error::Kind::usage, "layer: there is no '" + name + "' in the picture");
  return floats_of(found->image.pixels);
}

std::string RoomPicture::stats() const { return impl_->stats; }

void RoomPicture::write(const std::filesystem::path& file, const Settings& settings) const {
  guarded([&] {
    const PictureSettings shown = picture_settings(impl_->shown, settings);
    check_outputs({.pictures = {file}, .solution = {}, .texts = {}}, impl_->inputs);
    const ViewPicture& picture = impl_->picture;
    write_pictures({file}, {picture.image, picture.layers, &picture.edges, picture.unit}, shown,
                   picture.attributes, {});
  });
}

PictureDistance distance(const RoomPicture& picture, const RoomPicture& reference) {
  return guarded([&] {
    const Image& a = picture.impl_->picture.image;
    const ComparedPicture b{reference.impl_->picture.image, reference.impl_->encoding, {}, {}};
    if (a.width != b.image.width || a.height != b.image.height)
      throw UsageError("distance", "the pictures are not of one size");
    for (const Image* image : {&a, &b.image})
      if (const auto bad = first_bad_pixel(*image))
        throw InputError("", "distance", *bad);
    const PictureDifference d = compare_pictures(a, b.image, metric_settings(b, std::nullopt));
    return PictureDistance{d.rmse, d.relmse, d.mae, d.psnr, d.max_abs, d.ssim, d.flip};
  });
}

} // namespace meninas
