// What the server of `view` sends of numbers, read as page/live.js reads it; the table is that of walk/packed_numbers.h.
#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include <cstdint>
#include <string>
#include <vector>

namespace meninas {

struct Message {
  nlohmann::json head;
  std::vector<int> bits; ///< by vertex and channel
};

inline Message read(const std::string& text, const Message* before = nullptr) {
  std::size_t length = 0;
  for (unsigned k = 0; k < 4; ++k)
    length |= std::size_t{static_cast<unsigned char>(text[k])} << (8 * k);
  Message message{nlohmann::json::parse(text.substr(4, length)), {}};
  const std::size_t rows = message.head.at("rows"), columns = message.head.at("columns"), bytes = message.head.at("bytes");
  std::vector<unsigned char> table(columns * rows * bytes);
  uLongf size = table.size();
  EXPECT_EQ(uncompress(table.data(), &size, reinterpret_cast<const Bytef*>(text.data()) + 4 + length, text.size() - 4 - length), Z_OK);
  std::vector<std::uint32_t> folded(columns * rows, 0);
  std::size_t place = 0;
  for (unsigned byte = 0; byte < bytes; ++byte)
    for (std::size_t column = 0; column < columns; ++column)
      for (std::size_t row = 0; row < rows; ++row)
        folded[columns * row + column] |= std::uint32_t{table[place++]} << (8 * byte);
  for (std::size_t k = 0; k < folded.size(); ++k) {
    const std::uint32_t f = folded[k];
    const int difference = static_cast<int>(f & 1U ? ~(f >> 1U) : f >> 1U);
    message.bits.push_back(difference);
  }
  for (std::size_t k = columns; k < message.bits.size(); ++k)
    message.bits[k] += message.bits[k - columns];
  if (before != nullptr && message.head.at("base") != 0)
    for (std::size_t k = 0; k < message.bits.size(); ++k)
      message.bits[k] += before->bits[k];
  return message;
}

} // namespace meninas
