#include "runs/trade/trade_point.h"

#include <algorithm>
#include <numeric>

namespace meninas {

double mean_of(const std::vector<double>& values) {
  return values.empty()
             ? 0.0
             : std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

double spread_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  if (!(mean > 0.0))
    return 0.0;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return (*most - *least) / mean;
}

std::vector<std::size_t> pareto_front(const std::vector<TradePoint>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto seconds = [&](std::size_t k) { return mean_of(points[k].seconds); };
  const auto error = [&](std::size_t k) { return mean_of(points[k].errors); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return seconds(a) != seconds(b) ? seconds(a) < seconds(b) : error(a) < error(b);
  });
  std::vector<std::size_t> front;
  for (const std::size_t k : order)
    if (front.empty() || error(k) < error(front.back()))
      front.push_back(k);
  return front;
}

} // namespace meninas
