#include "runs/bake/document_edit.h"

#include "scenes/gltf/stages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>
#include <string_view>

namespace meninas {

using gltf::Json;

namespace {

constexpr int array_buffer = 34962, element_array_buffer = 34963, unsigned_short = 5123, unsigned_int = 5125,
              floats = 5126;

template <typename Item>
std::vector<unsigned char> bytes_of_items(const std::vector<Item>& items) {
  std::vector<unsigned char> bytes(items.size() * sizeof(Item));
  if (!items.empty())
    std::memcpy(bytes.data(), items.data(), bytes.size());
  return bytes;
}

void add_accessors(const Json& primitive, std::set<std::size_t>& accessors) {
  const auto add_all = [&](const Json& attributes) {
    for (const auto& attribute : attributes.items())
      accessors.insert(gltf::size_value(attribute.value()));
  };
  add_all(primitive["attributes"]);
  if (const auto* targets = gltf::find(primitive, "targets"))
    for (const Json& target : *targets)
      add_all(target);
  if (const auto indices = gltf::index_at(primitive, "indices"))
    accessors.insert(*indices);
}

/// Calls visit(number) for every `bufferView` below: glTF and its extensions name views so.
template <typename Value, typename Visit>
void each_view(Value& item, Visit visit) {
  if (!item.is_structured())
    return;
  for (auto& [key, value] : item.items()) {
    if (item.is_object() && key == "extras")
      continue;
    if (item.is_object() && key == "bufferView" && value.is_number())
      visit(value);
    else
      each_view(value, visit);
  }
}

std::string mime_type_of(std::span<const unsigned char> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("\x89PNG"))
    return "image/png";
  if (text.starts_with("\xff\xd8\xff"))
    return "image/jpeg";
  if (text.starts_with("RIFF"))
    return "image/webp";
  return text.starts_with("\xabKTX 20") ? "image/ktx2" : "";
}

/// The bounds of these elements, where an accessor states any.
void restate_bounds(Json& accessor, const gltf::StoredElements& stored, std::span<const std::uint32_t> elements) {
  if (!accessor.contains("min") && !accessor.contains("max"))
    return;
  std::vector<double> low(stored.width, std::numeric_limits<double>::infinity()),
      high(stored.width, -std::numeric_limits<double>::infinity());
  for (const std::uint32_t element : elements)
    for (std::size_t c = 0; c < stored.width; ++c) {
      const double value = gltf::stored_number(stored, element, c);
      low[c] = std::min(low[c], value);
      high[c] = std::max(high[c], value);
    }
  if (stored.component == floats) {
    accessor["min"] = low;
    accessor["max"] = high;
  } else {
    accessor["min"] = std::vector<std::int64_t>(low.begin(), low.end());
    accessor["max"] = std::vector<std::int64_t>(high.begin(), high.end());
  }
}

/// What Draco has decoded is not quite within what was encoded.
void restate_bounds(Json& root, const gltf::Document& file, std::size_t accessor) {
  const gltf::StoredElements stored = gltf::stored_elements(file, accessor);
  std::vector<std::uint32_t> all(gltf::accessor_count(file, accessor));
  std::iota(all.begin(), all.end(), 0U);
  restate_bounds(root["accessors"][accessor], stored, all);
}

void erase_extension(Json& object, const char* name) {
  const auto extensions = object.find("extensions");
  if (extensions == object.end())
    return;
  extensions->erase(name);
  if (extensions->empty())
    object.erase("extensions");
}

} // namespace

DocumentEdit::DocumentEdit(const gltf::Document& file,
                           const std::set<std::pair<std::size_t, std::size_t>>& rewritten)
    : file_(file), root_(file.root) {
  for (std::size_t m = 0; m < gltf::count_of(root_, "meshes"); ++m) {
    Json& primitives = root_["meshes"][m]["primitives"];
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      if (!rewritten.contains({m, p}))
        add_accessors(primitives[p], kept_);
      const auto position = gltf::index_at(primitives[p]["attributes"], "POSITION");
      if (position && gltf::element(root_, "accessors", *position).contains("bufferView") &&
          gltf::find(primitives[p], {"extensions", "KHR_draco_mesh_compression"})) {
        restate_bounds(root_, file_, *position);
        erase_extension(primitives[p], "KHR_draco_mesh_compression");
      }
    }
  }
  for (std::size_t k = 0; k < gltf::count_of(root_, "bufferViews"); ++k)
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
      erase_extension(root_["bufferViews"][k], name);
  for (std::size_t a = 0; a < gltf::count_of(root_, "animations"); ++a)
    for (const Json& sampler : root_["animations"][a]["samplers"])
      for (const char* end : {"input", "output"})
        if (const auto accessor = gltf::index_at(sampler, end))
          kept_.insert(*accessor);
  for (std::size_t s = 0; s < gltf::count_of(root_, "skins"); ++s)
    if (const auto accessor = gltf::index_at(root_["skins"][s], "inverseBindMatrices"))
      kept_.insert(*accessor);
}

std::size_t DocumentEdit::add_view(std::vector<unsigned char> bytes, std::size_t stride, int target) {
  Json view{{"buffer", file_.buffers.size() + added_.size()}, {"byteLength", bytes.size()}};
  if (stride > 0)
    view["byteStride"] = stride;
  if (target != 0)
    view["target"] = target;
  added_.push_back(std::move(bytes));
  root_["bufferViews"].push_back(std::move(view));
  return root_["bufferViews"].size() - 1;
}

std::size_t DocumentEdit::gathered(std::size_t accessor, std::span<const std::uint32_t> elements) {
  auto found = stored_.find(accessor);
  if (found == stored_.end())
    found = stored_.emplace(accessor, gltf::stored_elements(file_, accessor)).first;
  const gltf::StoredElements& stored = found->second;
  const std::size_t stride = (stored.size() + 3) / 4 * 4; // as vertex attributes have to be
  std::vector<unsigned char> bytes(stride * elements.size());
  for (std::size_t k = 0; k < elements.size(); ++k)
    std::memcpy(bytes.data() + k * stride, stored.bytes.data() + elements[k] * stored.size(),
                stored.size());
  Json item = gltf::element(file_.root, "accessors", accessor);
  for (const char* key : {"byteOffset", "sparse"})
    item.erase(key);
  item["bufferView"] = add_view(std::move(bytes), stride, array_buffer);
  item["count"] = elements.size();
  restate_bounds(item, stored, elements);
  return put(accessor, std::move(item));
}

std::size_t DocumentEdit::put(std::optional<std::size_t> instead, Json accessor) {
  Json& accessors = root_["accessors"];
  if (instead && !kept_.contains(*instead) && claimed_.insert(*instead).second) {
    accessors[*instead] = std::move(accessor);
    return *instead;
  }
  accessors.push_back(std::move(accessor));
  return accessors.size() - 1;
}

std::size_t DocumentEdit::add_texcoords(const std::vector<glm::vec2>& values) {
  const std::size_t view = add_view(bytes_of_items(values), sizeof(glm::vec2), array_buffer);
  return put(std::nullopt,
             {{"bufferView", view}, {"componentType", floats}, {"count", values.size()}, {"type", "VEC2"}});
}

std::size_t DocumentEdit::add_indices(const std::vector<std::uint32_t>& indices, std::size_t vertices,
                                      std::optional<std::size_t> instead) {
  const bool are_short = vertices < 65535;
  const std::size_t view =
      add_view(are_short ? bytes_of_items(std::vector<std::uint16_t>(indices.begin(), indices.end()))
                         : bytes_of_items(indices),
               0, element_array_buffer);
  return put(instead, {{"bufferView", view},
                       {"componentType", are_short ? unsigned_short : unsigned_int},
                       {"count", indices.size()},
                       {"type", "SCALAR"}});
}

std::size_t DocumentEdit::add_image(const std::vector<std::byte>& png, const std::string& name, Json extras) {
  // Between texels as they are, and never beyond a chart: no coarser levels, no repeating.
  constexpr int linear = 9729, clamp_to_edge = 33071;
  root_["samplers"].push_back({{"magFilter", linear}, {"minFilter", linear}, {"wrapS", clamp_to_edge}, {"wrapT", clamp_to_edge}});
  std::vector<unsigned char> bytes(png.size());
  if (!png.empty())
    std::memcpy(bytes.data(), png.data(), png.size());
  Json image{{"name", name}, {"mimeType", "image/png"}, {"bufferView", add_view(std::move(bytes), 0, 0)}};
  if (!extras.is_null())
    image["extras"] = std::move(extras);
  root_["images"].push_back(std::move(image));
  root_["textures"].push_back(
      {{"source", root_["images"].size() - 1}, {"sampler", root_["samplers"].size() - 1}});
  return root_["textures"].size() - 1;
}

void DocumentEdit::use_extension(const std::string& name) {
  Json& used = root_["extensionsUsed"];
  if (std::ranges::find(used, Json(name)) == used.end())
    used.push_back(name);
}

std::span<const unsigned char> DocumentEdit::bytes_of_view(std::size_t view) const {
  const Json& item = root_["bufferViews"][view];
  const std::size_t buffer = gltf::size_value(item["buffer"]);
  if (buffer >= file_.buffers.size())
    return added_[buffer - file_.buffers.size()];
  return gltf::view_bytes(file_, view);
}

void DocumentEdit::take_in_images(std::vector<std::string>& warnings) {
  for (std::size_t k = 0; k < gltf::count_of(root_, "images"); ++k) {
    Json& image = root_["images"][k];
    if (!image.contains("uri"))
      continue;
    gltf::Resource resource = gltf::image_bytes(file_, k);
    std::string type = gltf::text_or(image, "mimeType", "");
    if (type.empty())
      type = mime_type_of(resource.bytes);
    if (!resource.problem.empty() || type.empty()) {
      warnings.push_back(fmt::format("{} stays outside of the file: {}", gltf::place(root_, "images", k),
                                     resource.problem.empty() ? "its kind is not known" : resource.problem));
      continue;
    }
    image.erase("uri");
    image["mimeType"] = type;
    image["bufferView"] = add_view(std::move(resource.bytes), 0, 0);
  }
}

void DocumentEdit::forget_extensions() {
  std::set<std::string> names;
  gltf::collect_extensions(root_, names);
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    const auto found = root_.find(list);
    if (found == root_.end())
      continue;
    for (const char* gone : {"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                             "KHR_meshopt_compression", "EXT_mesh_gpu_instancing"})
      if (!names.contains(gone))
        found->erase(std::remove(found->begin(), found->end(), Json(gone)), found->end());
    if (found->empty())
      root_.erase(list);
  }
}

std::vector<std::byte> DocumentEdit::finish(std::vector<std::string>& warnings) {
  take_in_images(warnings);
  std::set<std::size_t> used;
  each_view(root_, [&](const Json& view) { used.insert(gltf::size_value(view)); });
  std::vector<std::byte> binary;
  std::map<std::size_t, std::size_t> number;
  Json views = Json::array();
  for (const std::size_t view : used) {
    const auto bytes = bytes_of_view(view);
    binary.resize((binary.size() + 3) / 4 * 4);
    Json item = root_["bufferViews"][view];
    item["buffer"] = 0;
    item["byteOffset"] = binary.size();
    item["byteLength"] = bytes.size();
    const auto first = reinterpret_cast<const std::byte*>(bytes.data());
    binary.insert(binary.end(), first, first + bytes.size());
    number[view] = views.size();
    views.push_back(std::move(item));
  }
  each_view(root_, [&](Json& view) { view = number.at(gltf::size_value(view)); });
  root_["bufferViews"] = std::move(views);
  root_["buffers"] = Json::array({{{"byteLength", binary.size()}}});
  forget_extensions();
  return binary;
}

} // namespace meninas
