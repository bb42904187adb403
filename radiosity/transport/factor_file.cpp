#include "radiosity/transport/factor_file.h"

#include "image/whole_file.h"
#include "scenes/content_hash.h"
#include "scenes/errors.h"
#include "scenes/materials/lobes.h"
#include "scenes/version.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <span>
#include <type_traits>

namespace meninas {
namespace {

static_assert(std::endian::native == std::endian::little, "factor files are little-endian");

constexpr std::uint64_t magic = 0x3130'4146'4e45'4dULL; // "MENFA01"

std::uint64_t hash_of_geometry(const Scene& scene) {
  ContentHash hash;
  for (const Vertex& vertex : scene.vertices) {
    hash.add(vertex.position);
  }
  for (const Triangle& triangle : scene.triangles) {
    for (const VertexId vertex : triangle.vertices) {
      hash.add(std::uint64_t{index(vertex)});
    }
    hash.add(std::uint64_t{scene.materials[index(triangle.material)].double_sided});
    if (triangle.curved)
      for (const VertexId vertex : triangle.vertices)
        hash.add(Vec3(scene.vertices[index(vertex)].normal));
  }
  return hash.value();
}

/// What light meets in glass and on coats is part of the transport.
void add_film(ContentHash& hash, const ThinFilm& film) {
  if (film.share > 0.0)
    hash.add(Rgb(film.share, film.ior, film.thickness));
}
void add_coat(ContentHash& hash, const Bsdf& coat) {
  add_film(hash, coat.film);
  hash.add(coat.coat_f0);
  hash.add(Rgb(coat.coat, coat.coat_f90, 0.0));
}
void add_glass(ContentHash& hash, const Bsdf& glass) {
  add_film(hash, glass.pane.film);
  hash.add(glass.metal);
  hash.add(Rgb(glass.glass, glass.pane.ior, glass.pane.f90));
  hash.add(glass.pane.f0);
  hash.add(glass.pane.tint);
  hash.add(static_cast<std::uint64_t>(glass.pane.faces));
}

/// Of glass: which image, and how it lies.
void add_texture(ContentHash& hash, const Scene& scene, const std::optional<TextureUse>& use) {
  if (!use)
    return;
  const Texture& texture = scene.textures[index(use->texture)];
  hash.add(std::as_bytes(std::span(texture.encoded)));
  hash.add(static_cast<std::uint64_t>(texture.wrap_u));
  hash.add(static_cast<std::uint64_t>(texture.wrap_v));
  hash.add(static_cast<std::uint64_t>(texture.magnified));
  hash.add(static_cast<std::uint64_t>(use->texcoord_set));
  hash.add(Rgb(use->offset, use->rotation));
  hash.add(Rgb(use->scale, 0.0));
}

std::uint64_t hash_of_mirrors(const Scene& scene, const WorldTree& worlds) {
  ContentHash hash;
  for (const Triangle& triangle : scene.triangles) {
    const Material& material = scene.materials[index(triangle.material)];
    hash.add(mirror_reflectance(material));
    if (is_glass(material))
      add_glass(hash, clear_glass(material, untextured(material)));
    if (has_mirror_coat(material))
      add_coat(hash, mirror_coat(material));
    if (is_blended(material))
      for (const VertexId vertex : triangle.vertices)
        hash.add(Rgb(double{scene.vertices[index(vertex)].color.a}));
    if (is_glass(material) && is_textured(material))
      for (const VertexId vertex : triangle.vertices)
        for (const glm::vec2& texcoord : scene.vertices[index(vertex)].texcoord)
          hash.add(Vec3(texcoord, 0.0));
  }
  for (const Material& material : scene.materials)
    if (is_glass(material))
      for (const auto* use : {&material.base_color_texture, &material.metallic_roughness_texture,
                              &material.transmission_texture, &material.thickness_texture,
                              &material.iridescence_texture, &material.film_thickness_texture}) {
        if (use == &material.film_thickness_texture && *use)
          hash.add(Rgb(material.film_min_thickness, material.film_thickness, 0.0));
        add_texture(hash, scene, *use);
      }
  for (const MirrorWorld& world : worlds.worlds) {
    hash.add(std::uint64_t{index(world.parent)});
    hash.add(std::uint64_t{index(world.mirror)});
  }
  return hash.value();
}

std::uint64_t hash_of_mesh(const ElementMesh& mesh) {
  ContentHash hash;
  for (const MeshSide& side : mesh.sides) {
    hash.add(std::uint64_t{index(side.patch)});
    hash.add(std::uint64_t{static_cast<std::uint8_t>(side.facing)});
    hash.add(static_cast<std::uint64_t>(side.nu));
    hash.add(static_cast<std::uint64_t>(side.nv));
  }
  for (const MeshCell& cell : mesh.cells) {
    hash.add(std::uint64_t{cell.level});
  }
  for (const Point3& vertex : mesh.vertices) {
    hash.add(vertex);
  }
  return hash.value();
}

std::uint64_t hash_of_sampling(const FormFactorSettings& settings) {
  // All of them, by name: a new setting does not compile before it has a place here.
  const auto& [method, rays, hemicube_resolution, min_throughput, max_bounces, accuracy, seed,
               relightable] = settings;
  ContentHash hash;
  hash.add(static_cast<std::uint64_t>(method));
  hash.add(static_cast<std::uint64_t>(rays));
  hash.add(static_cast<std::uint64_t>(hemicube_resolution));
  hash.add(accuracy);
  hash.add(min_throughput);
  hash.add(static_cast<std::uint64_t>(max_bounces));
  hash.add(std::uint64_t{seed});
  hash.add(std::uint64_t{relightable});
  return hash.value();
}

template <typename Item>
void append(std::vector<std::byte>& bytes,
            const Item& item) requires std::is_trivially_copyable_v<Item> {
  const auto raw = std::as_bytes(std::span(&item, 1));
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

template <typename Item>
void append(std::vector<std::byte>& bytes, const std::vector<Item>& items) {
  append(bytes, std::uint64_t{items.size()});
  const auto raw = std::as_bytes(std::span(items));
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

void append(std::vector<std::byte>& bytes, const Transport& transport) {
  append(bytes, std::uint64_t{transport.size});
  append(bytes, static_cast<std::uint64_t>(transport.bands));
  append(bytes, transport.row_begin);
  append(bytes, transport.columns);
  append(bytes, transport.weights);
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw InputError(file.string(), "", what);
}

/// Takes items off the front of a file; what is not there is damage.
struct Reader {
  const std::filesystem::path& file;
  std::span<const std::byte> rest;

  template <typename Item>
  void take(Item& item) {
    if (rest.size() < sizeof(Item)) {
      refuse(file, "damaged: it ends too early");
    }
    std::memcpy(&item, rest.data(), sizeof(Item));
    rest = rest.subspan(sizeof(Item));
  }
  template <typename Item>
  void take(std::vector<Item>& items) {
    std::uint64_t count = 0;
    take(count);
    if (count > rest.size() / sizeof(Item)) {
      refuse(file, "damaged: it does not hold the data it announces");
    }
    items.resize(count);
    if (count > 0) {
      std::memcpy(items.data(), rest.data(), count * sizeof(Item));
    }
    rest = rest.subspan(count * sizeof(Item));
  }
  void take(Transport& transport) {
    std::uint64_t size = 0, bands = 0;
    take(size);
    take(bands);
    transport.size = size;
    transport.bands = static_cast<int>(std::min<std::uint64_t>(bands, 4));
    take(transport.row_begin);
    take(transport.columns);
    take(transport.weights);
  }
};

std::vector<std::byte> bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const auto size = stream ? static_cast<std::streamoff>(stream.tellg()) : -1;
  if (size < 0 || std::filesystem::is_directory(file)) {
    refuse(file, "cannot be read");
  }
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  stream.seekg(0);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), size)) {
    refuse(file, "cannot be read");
  }
  return bytes;
}

/// Rows in order, columns that exist, weights that can be form factors.
bool makes_sense(const Transport& transport) {
  const auto& begin = transport.row_begin;
  const auto fits = [&](std::uint32_t column) { return column < transport.size; };
  const auto possible = [](float weight) { return std::isfinite(weight) && weight >= 0.0F; };
  return (transport.bands == 1 || transport.bands == 3) && begin.size() == transport.size + 1 &&
         begin.front() == 0 && std::ranges::is_sorted(begin) &&
         begin.back() == transport.columns.size() &&
         transport.weights.size() ==
             transport.columns.size() * static_cast<std::size_t>(transport.bands) &&
         std::ranges::all_of(transport.columns, fits) &&
         std::ranges::all_of(transport.weights, possible);
}

void check_sense(const std::filesystem::path& file, const FormFactors& factors) {
  const std::size_t size = factors.transport.size;
  const bool sound = makes_sense(factors.transport) && makes_sense(factors.beyond) &&
                     factors.beyond.size == size && factors.closure.size() == size &&
                     factors.covered.size() == size && factors.exposed.size() == size;
  if (!sound) {
    refuse(file, "damaged: its form factors make no sense");
  }
}

void check_key(const std::filesystem::path& file, const FactorKey& found, const FactorKey& key) {
  const auto check = [&](std::uint64_t a, std::uint64_t b, const char* what) {
    if (a != b) {
      refuse(file, fmt::format("cannot be reused: {} since it was written", what));
    }
  };
  check(found.geometry, key.geometry, "the geometry has changed");
  check(found.mirrors, key.mirrors, "the mirrors or how far they are followed have changed");
  check(found.mesh, key.mesh,
        "the elements (size, number, or which surfaces have any) have changed");
  check(found.sampling, key.sampling, "the settings of the form factors have changed");
}

} // namespace

FactorKey factor_key(const LightScene& light, const FormFactorSettings& settings) {
  return {hash_of_geometry(light.scene), hash_of_mirrors(light.scene, light.worlds),
          hash_of_mesh(light.mesh), hash_of_sampling(settings)};
}

void write_factors(const std::filesystem::path& file, const FormFactors& factors,
                   const FactorKey& key) {
  std::vector<std::byte> bytes;
  append(bytes, magic);
  const std::string version(program_version());
  append(bytes, std::vector<char>(version.begin(), version.end()));
  append(bytes, key);
  append(bytes, factors.transport);
  append(bytes, factors.beyond);
  append(bytes, factors.closure);
  append(bytes, factors.covered);
  append(bytes, factors.exposed);
  append(bytes, hash_of_bytes(bytes));
  write_whole_file(file, bytes);
}

FormFactors read_factors(const std::filesystem::path& file, const FactorKey& key) {
  const std::vector<std::byte> bytes = bytes_of(file);
  Reader reader{file, bytes};
  std::uint64_t word = 0;
  if (bytes.size() >= 2 * sizeof(word)) {
    reader.take(word);
  }
  if (word != magic) {
    refuse(file, "not a factor file written by 'meninas solve --factors'");
  }
  std::vector<char> version;
  reader.take(version);
  if (std::string(version.begin(), version.end()) != program_version()) {
    refuse(file,
           fmt::format("was written by another version than {}: solve again", program_version()));
  }

  // The hash comes first: nothing damaged is looked at any closer.
  std::uint64_t announced = 0;
  const auto hashed = std::span(bytes).first(bytes.size() - sizeof(announced));
  std::memcpy(&announced, hashed.data() + hashed.size(), sizeof(announced));
  if (hash_of_bytes(hashed) != announced) {
    refuse(file, "damaged: its data do not have the hash it announces");
  }
  FactorKey found;
  reader.take(found);
  check_key(file, found, key);
  FormFactors factors;
  reader.take(factors.transport);
  reader.take(factors.beyond);
  reader.take(factors.closure);
  reader.take(factors.covered);
  reader.take(factors.exposed);
  check_sense(file, factors);
  return factors;
}

} // namespace meninas
