// What the tests of picture files share:
// a folder of their own, pictures without pattern, and files as bytes.
#pragma once

#include "image/image.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace meninas::test {

/// A new empty folder for every test, gone after it.
class PictureFiles : public ::testing::Test {
protected:
  PictureFiles() {
    auto name = (std::filesystem::temp_directory_path() / "meninas-image-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw std::runtime_error("no temporary folder");
    folder = name;
  }
  ~PictureFiles() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }

  std::size_t entries() const {
    const std::filesystem::directory_iterator files(folder);
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
  }

  std::filesystem::path folder;
};

/// Values over twelve powers of two, as rooms have them, and all different.
inline Image random_picture(int width, int height, unsigned seed = 1) {
  std::mt19937 engine(seed);
  Image picture(width, height);
  for (auto& pixel : picture.pixels)
    for (int c = 0; c < 3; ++c)
      pixel[c] = std::ldexp(1.0F + static_cast<float>(engine() % 100000U) / 100000.0F,
                            static_cast<int>(engine() % 12U) - 8);
  return picture;
}

inline std::vector<std::byte> bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::byte> bytes;
  for (std::istreambuf_iterator<char> c(stream), end; c != end; ++c)
    bytes.push_back(static_cast<std::byte>(*c));
  return bytes;
}

inline void write_bytes(const std::filesystem::path& file, const std::vector<std::byte>& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

/// The line a user reads when `work` fails as `Error`; empty, and a failed test, when it does not.
template <typename Error, typename Work>
std::string error_line(Work work) {
  try {
    work();
  } catch (const Error& error) {
    const std::string line = error.what();
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    return line;
  } catch (const std::exception& error) {
    ADD_FAILURE() << "another error: " << error.what();
    return "";
  }
  ADD_FAILURE() << "no error";
  return "";
}

} // namespace meninas::test
