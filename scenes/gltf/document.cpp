#include "scenes/gltf/document.h"

#include <fmt/format.h>

#include <algorithm>

namespace meninas::gltf {

static constexpr std::size_t names_per_line = 8;

Document read_document(Bytes bytes, const std::filesystem::path& file,
                       const GltfSettings& settings) {
  Document document;
  document.file = file.string();
  document.folder = file.parent_path().empty() ? "." : file.parent_path();
  document.settings = settings;

  auto container = parse_container(document.file, std::move(bytes), settings.memory_limit);
  check_structure(document.file, container.root);

  document.root = std::move(container.root);
  document.buffers = load_buffers(document, std::move(container.binary));
  for (const auto& buffer : document.buffers)
    document.buffer_bytes += buffer.size();
  decode_meshopt(document);
  decode_draco(document);
  return document;
}

std::size_t add_buffer(Document& document, Bytes bytes) {
  document.root["buffers"].push_back({{"byteLength", bytes.size()}});
  document.buffer_bytes += bytes.size();
  document.buffers.push_back(std::move(bytes));
  return document.buffers.size() - 1;
}

std::uint64_t memory_left(const Document& document) {
  const auto limit = document.settings.memory_limit;
  return limit - std::min(limit, document.buffer_bytes);
}

const Json* find(const Json& object, std::string_view key) {
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

const Json* find(const Json& object, std::initializer_list<std::string_view> path) {
  const Json* at = &object;
  for (const auto key : path) {
    at = find(*at, key);
    if (!at)
      return nullptr;
  }
  return at;
}

std::uint64_t size_value(const Json& value) {
  if (value.is_number_unsigned())
    return value.get<std::uint64_t>();
  return static_cast<std::uint64_t>(value.get<double>());
}

std::uint64_t size_or(const Json& object, std::string_view key, std::uint64_t otherwise) {
  const auto* value = find(object, key);
  return value ? size_value(*value) : otherwise;
}

std::optional<std::size_t> index_at(const Json& object, std::string_view key) {
  const auto* value = find(object, key);
  if (!value)
    return std::nullopt;
  return size_value(*value);
}

double number_or(const Json& object, std::string_view key, double otherwise) {
  const auto* value = find(object, key);
  return value ? value->get<double>() : otherwise;
}

std::string text_or(const Json& object, std::string_view key, const std::string& otherwise) {
  const auto* value = find(object, key);
  return value ? value->get<std::string>() : otherwise;
}

std::vector<double> numbers_at(const Json& object, std::string_view key) {
  const auto* value = find(object, key);
  return value ? value->get<std::vector<double>>() : std::vector<double>{};
}

Vec3 vec3_or(const Json& object, std::string_view key, const Vec3& otherwise) {
  const auto numbers = numbers_at(object, key);
  return numbers.size() < 3 ? otherwise : Vec3(numbers[0], numbers[1], numbers[2]);
}

/// Those of extensions have a place of their own.
static const Json* array_of(const Json& root, std::string_view array) {
  if (array == "lights")
    return find(root, {"extensions", "KHR_lights_punctual", array});
  if (array == "iesLights")
    return find(root, {"extensions", "EXT_lights_ies", "lights"});
  if (array == "areaLights")
    return find(root, {"extensions", "EXT_lights_area", "lights"});
  if (array == "imageBasedLights")
    return find(root, {"extensions", "EXT_lights_image_based", "lights"});
  if (array == "variants")
    return find(root, {"extensions", "KHR_materials_variants", array});
  return find(root, array);
}

std::size_t count_of(const Json& root, std::string_view array) {
  const auto* value = array_of(root, array);
  return value && value->is_array() ? value->size() : 0;
}

const Json& element(const Json& root, std::string_view array, std::size_t index) {
  const auto* value = array_of(root, array);
  expects(value && index < value->size(), "an index into the glTF file that was not checked");
  return (*value)[index];
}

void collect_extensions(const Json& json, std::set<std::string>& names) {
  if (!json.is_structured())
    return;
  for (const auto& [key, value] : json.items()) {
    if (json.is_object() && key == "extras")
      continue;
    if (json.is_object() && key == "extensions" && value.is_object())
      for (const auto& extension : value.items())
        names.insert(extension.key());
    collect_extensions(value, names);
  }
}

std::string one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
  return text;
}

std::string name_of(const Json& object) {
  const auto* value = object.is_object() ? find(object, "name") : nullptr;
  if (!value || !value->is_string())
    return "";
  return one_line(value->get<std::string>());
}

std::string excerpt(std::string_view text) {
  constexpr std::size_t most = 100;
  if (text.size() <= most)
    return one_line(std::string(text));
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
    --end;
  return one_line(std::string(text.substr(0, end))) + "...";
}

std::string place(const Json& root, std::string_view array, std::size_t index) {
  const auto* given = find(element(root, array, index), "name");
  const auto name =
      given && given->is_string() ? excerpt(given->get_ref<const std::string&>()) : "";
  return name.empty() ? fmt::format("{}[{}]", array, index)
                      : fmt::format("{}[{}] '{}'", array, index, name);
}

void Findings::about(const std::string& text, const std::string& name) {
  auto found = std::ranges::find(findings_, text, &Finding::text);
  if (found == findings_.end())
    found = findings_.insert(found, {text, {}, {}});
  if (!found->names.insert(name).second)
    return;
  if (found->first_names.size() < names_per_line)
    found->first_names.push_back(name);
}

void Findings::say(const std::string& text) {
  if (std::ranges::find(findings_, text, &Finding::text) == findings_.end())
    findings_.push_back({text, {}, {}});
}

std::vector<std::string> Findings::lines() const {
  std::vector<std::string> lines;
  for (const auto& finding : findings_) {
    if (finding.names.empty())
      lines.push_back(finding.text);
    else
      lines.push_back(fmt::format("{}: {}", finding.text,
                                  name_list(finding.first_names, finding.names.size())));
  }
  return lines;
}

std::string name_list(std::span<const std::string> names, std::size_t total) {
  std::string list;
  const auto shown = std::min(names.size(), names_per_line);
  for (std::size_t k = 0; k < shown; ++k)
    list += fmt::format("{}'{}'", k == 0 ? "" : ", ", excerpt(names[k]));
  if (total > shown)
    list += fmt::format(" and {} more", total - shown);
  return list;
}

} // namespace meninas::gltf
