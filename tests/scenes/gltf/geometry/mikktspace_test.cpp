// Tangents of meshes by the rules of MikkTSpace.
#include "scenes/gltf/geometry/mikktspace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace meninas::test {
namespace {

struct Mesh {
  std::vector<Vec3> positions, normals;
  std::vector<Vec2> texcoords;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  auto tangents() const {
    return gltf::mikktspace_tangents({positions, normals, texcoords, triangles});
  }
};

/// In the plane z = 0, front towards +z; the image lies as it is upright.
Mesh flat(const std::vector<Vec2>& places, const std::vector<Vec2>& texcoords,
          const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  Mesh mesh{{}, std::vector(places.size(), Vec3(0, 0, 1)), texcoords, triangles};
  for (const Vec2& p : places)
    mesh.positions.emplace_back(p, 0.0);
  return mesh;
}

void expect_tangent(const glm::vec4& found, const Vec3& direction, float sign) {
  EXPECT_LT(glm::distance(Vec3(found), glm::normalize(direction)), 1e-6);
  EXPECT_EQ(found.w, sign);
}

/// A right angle at vertex 0, over which u grows along x, and half of one, over which it grows
/// along (1, 1); v runs up.
Mesh two_triangles() {
  return flat({{0, 0}, {1, 0}, {0, 1}, {-1, 1}}, {{0, 0}, {1, 0}, {0, 1}, {-1, 2}},
              {{0, 1, 2}, {0, 2, 3}});
}

// With v up the image's handedness is the other way round than glTF's, in which it runs down.
TEST(MikkTSpace, WeighsTrianglesByTheirAngles) {
  const auto tangents = two_triangles().tangents();
  const Vec3 first(1, 0, 0), second = glm::normalize(Vec3(1, 1, 0));
  expect_tangent(tangents[0][1], first, -1.0F);
  expect_tangent(tangents[1][2], second, -1.0F);
  for (const auto& tangent : {tangents[0][0], tangents[1][0]})
    expect_tangent(tangent, 2.0 * first + second, -1.0F);
  for (const auto& tangent : {tangents[0][2], tangents[1][1]})
    expect_tangent(tangent, first + 2.0 * second, -1.0F);
}

TEST(MikkTSpace, DoesNotDependOnIndices) {
  Mesh shared = two_triangles(), apart = shared;
  apart.triangles = {{0, 1, 2}, {3, 4, 5}};
  apart.positions.clear();
  apart.texcoords.clear();
  apart.normals.assign(6, Vec3(0, 0, 3));
  for (const auto& triangle : shared.triangles)
    for (const std::uint32_t v : triangle) {
      apart.positions.push_back(shared.positions[v]);
      apart.texcoords.push_back(shared.texcoords[v]);
    }
  EXPECT_EQ(shared.tangents(), apart.tangents());
  apart.normals[4] = Vec3(0.1, 0.0, 1.0);
  EXPECT_NE(shared.tangents()[0][2], apart.tangents()[0][2]);
}

// T is across the normal, whose triangle leans.
TEST(MikkTSpace, ProjectsOntoThePlaneOfTheNormal) {
  Mesh mesh = two_triangles();
  mesh.normals.assign(4, glm::normalize(Vec3(1, 0, 2)));
  expect_tangent(mesh.tangents()[0][1], Vec3(2, 0, -1), -1.0F);
}

// Image and mirror image share an edge: its corners have tangents of both.
TEST(MikkTSpace, KeepsMirroredImagesApart) {
  const auto tangents = flat({{0, 0}, {1, 0}, {0, 1}, {-1, 0}}, {{0, 1}, {1, 1}, {0, 0}, {1, 1}},
                             {{0, 1, 2}, {0, 2, 3}})
                            .tangents();
  for (std::size_t k = 0; k < 3; ++k) {
    expect_tangent(tangents[0][k], Vec3(1, 0, 0), 1.0F);
    expect_tangent(tangents[1][k], Vec3(-1, 0, 0), -1.0F);
  }
}

// Two that touch at a vertex alone are not around it.
TEST(MikkTSpace, JoinsTrianglesByEdges) {
  const auto tangents = flat({{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}},
                             {{0, 0}, {1, 0}, {0, 1}, {0, -1}, {1, 0}}, {{0, 1, 2}, {0, 3, 4}})
                            .tangents();
  expect_tangent(tangents[0][0], Vec3(1, 0, 0), -1.0F);
  expect_tangent(tangents[1][0], Vec3(0, -1, 0), -1.0F);
}

// Over the second triangle nothing changes: it has the first one's at their edge, and at its own
// corner none.
TEST(MikkTSpace, TrianglesThatTellNothingGoWithTheirNeighbours) {
  const auto tangents = flat({{0, 0}, {1, 0}, {0, 1}, {-1, 0}}, {{0, 0}, {1, 0}, {0, 1}, {0, 0.5}},
                             {{0, 1, 2}, {0, 2, 3}})
                            .tangents();
  expect_tangent(tangents[1][0], Vec3(1, 0, 0), -1.0F);
  expect_tangent(tangents[1][1], Vec3(1, 0, 0), -1.0F);
  EXPECT_EQ(tangents[1][2], glm::vec4(0.0F));
}

TEST(MikkTSpace, WithoutNormalsTakesThoseOfTheFaces) {
  Mesh mesh = two_triangles(), without = mesh, zero = mesh;
  without.normals.clear();
  zero.normals.assign(4, Vec3(0.0));
  EXPECT_EQ(without.tangents(), mesh.tangents());
  EXPECT_EQ(zero.tangents(), mesh.tangents());
}

// Whatever comes, a tangent is a unit vector across its normal, or none.
TEST(MikkTSpace, HoldsForMeshesWithoutSense) {
  std::mt19937 random(1);
  const auto number = [&] { return static_cast<int>(random() % 5) - 2; };
  for (int trial = 0; trial < 200; ++trial) {
    const double scale = std::pow(10.0, 3 * number());
    Mesh mesh;
    for (int v = 0; v < 24; ++v) {
      mesh.positions.emplace_back(scale * Vec3(number(), number(), number()));
      mesh.normals.emplace_back(number(), number(), number());
      mesh.texcoords.emplace_back(number(), number());
    }
    for (int t = 0; t < 60; ++t) {
      const auto corner = [&] { return static_cast<std::uint32_t>(random() % 24); };
      mesh.triangles.push_back({corner(), corner(), corner()});
    }
    const auto tangents = mesh.tangents();
    for (std::size_t t = 0; t < tangents.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 direction(tangents[t][k]);
        const double length = glm::length(direction);
        ASSERT_TRUE(length == 0.0 || std::abs(length - 1.0) < 1e-6) << length;
        ASSERT_EQ(std::abs(tangents[t][k].w), length == 0.0 ? 0.0F : 1.0F);
        if (const Vec3 n = mesh.normals[mesh.triangles[t][k]]; n != Vec3(0.0)) {
          ASSERT_LT(std::abs(glm::dot(glm::normalize(n), direction)), 1e-6);
        }
      }
  }
}

} // namespace
} // namespace meninas::test
