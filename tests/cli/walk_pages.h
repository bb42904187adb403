// Pages of `walk` beside the pictures of `render`.
#pragma once

#include "tests/cli/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace meninas::test {

/// What a page and a picture are made of.
struct PageCase {
  std::string scene, camera;
  std::string exposure; ///< about that of its PNG, stops
  std::vector<std::string> lamps = {}; ///< as --lamp takes them; none: lamps are not told apart
  std::vector<std::string> options = {}; ///< what is around the scene
};

class WalkPages : public testing::Test {
protected:
  static std::string gallery(const std::string& name);
  Outcome run(std::vector<std::string> arguments);
  /// room.html, of the tiny room.
  void write_tiny_page();
  nlohmann::json drawn(const std::string& page, const std::string& fragment,
                       const std::string& use);
  /// FLIP and figures of the page's picture, under its lamps as a link has them, beside that of `render
  /// --diffuse interpolated --lamp`, of the same solution. Null where the browser draws none.
  nlohmann::json page_beside_picture(const PageCase& page);
  TemporaryFolder folder_;
};

} // namespace meninas::test
