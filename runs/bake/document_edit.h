// A glTF document that is being edited: its JSON, and arrays that come after those of the file.
#pragma once

#include "scenes/gltf/accessors.h"

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace meninas {

class DocumentEdit {
public:
  /// `rewritten`: the primitives, by mesh and number, whose arrays will be replaced.
  DocumentEdit(const gltf::Document& file, const std::set<std::pair<std::size_t, std::size_t>>& rewritten);

  const gltf::Document& file() const { return file_; }
  gltf::Json& root() { return root_; }

  /// The accessor of the file with these of its elements: itself anew, or one more where others use it.
  std::size_t gathered(std::size_t accessor, std::span<const std::uint32_t> elements);
  std::size_t add_texcoords(const std::vector<glm::vec2>& values);
  /// In place of the accessor `instead`, if nothing else uses it.
  std::size_t add_indices(const std::vector<std::uint32_t>& indices, std::size_t vertices,
                          std::optional<std::size_t> instead);
  std::size_t add_image(const std::vector<std::byte>& png, const std::string& name, gltf::Json extras);
  void use_extension(const std::string& name);

  /// Images into the binary chunk, all buffers into one, views that nothing names left out, extensions that
  /// are no longer there taken from the lists. Warnings name images that cannot be had.
  std::vector<std::byte> finish(std::vector<std::string>& warnings);

private:
  std::size_t put(std::optional<std::size_t> instead, gltf::Json accessor);
  std::size_t add_view(std::vector<unsigned char> bytes, std::size_t stride, int target);
  std::span<const unsigned char> bytes_of_view(std::size_t view) const;
  void take_in_images(std::vector<std::string>& warnings);
  void forget_extensions();

  const gltf::Document& file_;
  gltf::Json root_;
  std::vector<std::vector<unsigned char>> added_; ///< by buffer, after those of the file
  std::set<std::size_t> kept_;                    ///< accessors that something else uses
  std::set<std::size_t> claimed_;
  std::map<std::size_t, gltf::StoredElements> stored_;
};

} // namespace meninas
