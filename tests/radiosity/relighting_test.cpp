// Form factors kept for other light: the same solution as without them, or a refusal that says why.
#include "radiosity/transport/factor_file.h"
#include "scenes/errors.h"
#include "tests/radiosity/lit_scene.h"
#include "tests/support/glass_rooms.h"
#include "tests/support/rooms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace meninas::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Relighting : public testing::Test {
protected:
  Relighting() {
    settings_.mesh.element_size = 0.5;
    settings_.form_factors.rays = 64;
    settings_.form_factors.relightable = true;
    settings_.interpolation.method = Interpolation::average;
  }
  ~Relighting() override {
    std::error_code error;
    fs::remove(file_, error);
  }

  void keep_factors(const Scene& scene) {
    const auto l = lit(scene, settings_.mesh, settings_.plan);
    write_factors(file_, assemble_transport(*l->light, settings_.form_factors),
                  factor_key(*l->light, settings_.form_factors));
  }
  FormFactors kept(const LitScene& l) {
    return read_factors(file_, factor_key(*l.light, settings_.form_factors), element_count(l.light->mesh));
  }
  std::string refusal(const Scene& scene) {
    try {
      kept(*lit(scene, settings_.mesh, settings_.plan));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  void expect_the_same_light(const Scene& scene) {
    const auto l = lit(scene, settings_.mesh, settings_.plan);
    PassOneSettings plain = settings_;
    plain.form_factors.relightable = false;
    const RadiositySolution whole = solve_pass_one(l->light, plain);
    const RadiositySolution relit = solve_pass_one(l->light, kept(*l), settings_);
    EXPECT_EQ(whole.radiosity, relit.radiosity);
    EXPECT_EQ(whole.field.irradiance, relit.field.irradiance);
    EXPECT_EQ(whole.energy.absorbed, relit.energy.absorbed);
    EXPECT_EQ(relit.form_factor_rays, 0U);
  }

  PassOneSettings settings_;
  fs::path file_ =
      fs::temp_directory_path() / ("meninas-factors-" + std::to_string(getpid()) + ".bin");
};

Material& emitter_of(Scene& scene) {
  return *std::ranges::find_if(scene.materials, [](const Material& m) { return is_emitter(m); });
}
Material& wall_of(Scene& scene) {
  return *std::ranges::find_if(scene.materials,
                               [](const Material& m) { return !is_emitter(m) && !is_mirror(m); });
}

TEST_F(Relighting, EmissionAndDiffuseReflectancesMayChange) {
  for (Scene scene : {half_room(), facing_mirrors(Rgb(0.95, 0.9, 0.85))}) {
    keep_factors(scene);
    expect_the_same_light(scene);
    emitter_of(scene).emission *= Rgb(3.0, 0.1, 7.0);
    wall_of(scene).base_color = Rgb(0.9, 0.1, 0.4);
    expect_the_same_light(scene);

    // Another lamp: a wall begins to glow, and the first one is switched off.
    wall_of(scene).emission = Rgb(0.0, 2.0, 0.5);
    expect_the_same_light(scene);
  }
}

TEST_F(Relighting, WhatMustNotChangeIsNamed) {
  const Scene scene = half_room();
  keep_factors(scene);
  EXPECT_EQ(refusal(scene), "");
  Scene moved = scene;
  moved.vertices[0].position.x -= 1e-3;
  EXPECT_THAT(refusal(moved), HasSubstr("geometry"));
  Scene tinted = scene;
  for (auto& material : tinted.materials)
    if (is_mirror(material))
      material.base_color *= 0.5;
  EXPECT_THAT(refusal(tinted), HasSubstr("mirrors"));
  settings_.mesh.element_size = 0.25;
  EXPECT_THAT(refusal(scene), HasSubstr("elements"));
  settings_.mesh.element_size = 0.5;
  settings_.form_factors.rays = 128;
  EXPECT_THAT(refusal(scene), HasSubstr("settings of the form factors"));
  settings_.form_factors.rays = 64;
  settings_.plan.worlds.max_depth = 0;
  EXPECT_THAT(refusal(scene), HasSubstr("how far they are followed"));
}

TEST_F(Relighting, GlassIsPartOfTheTransport) {
  Scene room = glazed_room();
  keep_factors(room);
  emitter_of(room).emission *= Rgb(3.0, 0.1, 7.0);
  expect_the_same_light(room);
  Scene tinted = room, denser = room;
  tinted.materials.back().base_color.r = 0.5;
  denser.materials.back().ior = 1.7;
  EXPECT_THAT(refusal(tinted), HasSubstr("mirrors"));
  EXPECT_THAT(refusal(denser), HasSubstr("mirrors"));
}

TEST_F(Relighting, DamagedFilesAreRefused) {
  const Scene scene = half_room();
  keep_factors(scene);
  std::ifstream stream(file_, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(stream)), {});
  const auto write = [&](const std::string& bytes) {
    std::ofstream(file_, std::ios::binary) << bytes;
  };
  for (std::size_t k = 0; k < 40; ++k) {
    const std::size_t place = k < 20 ? k * 3 : whole.size() - 1 - (whole.size() / 21) * (k - 20);
    write(whole.substr(0, place));
    EXPECT_NE(refusal(scene), "") << "cut at " << place;
    std::string flipped = whole;
    flipped[place] = static_cast<char>(flipped[place] ^ 0x41);
    write(flipped);
    EXPECT_NE(refusal(scene), "") << "flipped at " << place;
  }
  write(whole + "more");
  EXPECT_NE(refusal(scene), "");
  write(whole);
  EXPECT_EQ(refusal(scene), "");
}

TEST_F(Relighting, WholeFilesOfFactorsThatAreNoneAreRefused) {
  const Scene scene = half_room();
  const auto l = lit(scene, settings_.mesh, settings_.plan);
  const FormFactors good = assemble_transport(*l->light, settings_.form_factors);
  const std::pair<const char*, void (*)(FormFactors&)> faults[] = {
      {"rows beyond counting", [](FormFactors& f) { f.transport.size = SIZE_MAX, f.transport.row_begin.clear(); }},
      {"no rows", [](FormFactors& f) { f = FormFactors{}, f.transport.row_begin = f.beyond.row_begin = {0}; }},
      {"a column beyond the elements", [](FormFactors& f) { f.transport.columns.back() = 1'000'000; }},
      {"no weight for a column", [](FormFactors& f) { f.beyond.weights.push_back(1.0F); }},
      {"a weight that is no number", [](FormFactors& f) { f.transport.weights.front() = NAN; }},
      {"light that is no number", [](FormFactors& f) { f.closure.back().sky.g = INFINITY; }},
      {"less than nothing of an area", [](FormFactors& f) { f.exposed.front() = -0.5F; }}};
  const FactorKey key = factor_key(*l->light, settings_.form_factors);
  for (const auto& [fault, make] : faults) {
    FormFactors factors = good;
    make(factors);
    write_factors(file_, factors, key);
    EXPECT_THAT(refusal(scene), HasSubstr("damaged")) << fault;
  }
  write_factors(file_, good, key);
  EXPECT_EQ(refusal(scene), "");
}

TEST_F(Relighting, PartsOfUnlikeBandsAreRefused) {
  const auto l = lit(half_room(), settings_.mesh, settings_.plan);
  const FactorKey key = factor_key(*l->light, settings_.form_factors);
  const std::size_t elements = element_count(l->light->mesh);
  const fs::path folder = file_.string() + ".parts";
  fs::create_directories(folder);
  for (const std::uint64_t k : {0, 1}) {
    FormFactors rows = assemble_some_rows(*l->light, rows_of_part(elements, k, 2), settings_.form_factors);
    if (k == 1 && rows.transport.bands == 1) {
      rows.transport.bands = 3;
      rows.transport.weights.assign(3 * rows.transport.columns.size(), 0.0F);
    }
    write_factor_part(folder, rows, {k, 2, elements}, key);
  }
  try {
    join_factor_parts(folder, key, elements);
    ADD_FAILURE() << "weights of one band were taken for three";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("bands"));
  }
  fs::remove_all(folder);
}

} // namespace
} // namespace meninas::test
