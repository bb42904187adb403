// The cut through the tree of nodes: what receivers gather from one another.
#include "radiosity/hierarchical/node_cut.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace meninas {
namespace {

/// Receivers of two elements each, with rows of so many entries at random.
NodeCut cut_of(std::size_t receivers, std::size_t entries) {
  std::mt19937 random(7);
  NodeCut cut;
  cut.receivers.resize(receivers);
  for (std::size_t e = 0; e < 2 * receivers; ++e)
    cut.receiver_of_element.push_back(static_cast<std::uint32_t>(e / 2));
  cut.rows.size = receivers;
  cut.rows.bands = 3;
  cut.rows.row_begin.push_back(0);
  for (std::size_t r = 0; r < receivers; ++r) {
    for (std::size_t k = 0; k < entries; ++k) {
      cut.rows.columns.push_back(static_cast<std::uint32_t>(random() % (2 * receivers)));
      for (int band = 0; band < 3; ++band)
        cut.rows.weights.push_back(static_cast<float>(random() % 256) / 256.0F);
    }
    cut.rows.row_begin.push_back(cut.rows.columns.size());
  }
  return cut;
}

// F_cd is the sum of F_cj over the elements j below d: of more rows than one thread takes together, and a last part.
TEST(NodeCut, LinksAreSumsOverTheElementsBelow) {
  const NodeCut cut = cut_of(2500, 5);
  const Transport links = between_receivers(cut);
  ASSERT_EQ(links.row_begin.size(), 2501U);
  ASSERT_EQ(links.row_begin.back(), links.columns.size());
  ASSERT_EQ(links.weights.size(), 3 * links.columns.size());
  for (std::size_t r = 0; r < 2500; ++r) {
    std::map<std::uint32_t, float> wanted, found; // multiples of 1/256: sums are exact
    for (auto k = cut.rows.row_begin[r]; k < cut.rows.row_begin[r + 1]; ++k)
      wanted[cut.receiver_of_element[cut.rows.columns[k]]] += cut.rows.weights[3 * k + 1];
    for (auto k = links.row_begin[r]; k < links.row_begin[r + 1]; ++k)
      found[links.columns[k]] += links.weights[3 * k + 1];
    ASSERT_EQ(found, wanted) << r;
  }
}

} // namespace
} // namespace meninas
