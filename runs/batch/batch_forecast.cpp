#include "runs/batch/batch_forecast.h"

#include "raytrace/pixels/sample_choice.h"

#include <algorithm>
#include <numeric>

namespace meninas {

BatchForecast::BatchForecast(std::span<const BatchPicture> pictures) : waits_(pictures.size()) {
  for (const BatchPicture& picture : pictures) {
    const RunSettings& settings = picture.request.settings;
    kind_of_.emplace_back(settings.mode, diffuse_term(settings), settings.quality);
    rays_.push_back(double(picture.size.width) * picture.size.height *
                    first_samples(two_pass_settings(settings).render).count);
  }
}

void BatchForecast::waits(std::size_t picture) {
  if (!waits_[picture]) {
    kinds_[kind_of_[picture]].waiting += rays_[picture];
    waits_[picture] = true;
  }
}

void BatchForecast::waits_no_more(std::size_t picture) {
  if (waits_[picture]) {
    kinds_[kind_of_[picture]].waiting -= rays_[picture];
    waits_[picture] = false;
  }
}

void BatchForecast::made(std::size_t picture, double seconds) {
  Pace& kind = kinds_[kind_of_[picture]];
  kind.rays += rays_[picture];
  kind.seconds += seconds;
}

void BatchForecast::solved(double seconds) {
  solve_seconds_ += seconds;
  ++solves_;
}

std::optional<double> BatchForecast::seconds_left(const TasksUnderWay& now, double elapsed) const {
  // What is known of each kind, from pictures under way too once they say something.
  constexpr double says_something = 0.05;
  std::map<Kind, Pace> kinds = kinds_;
  double seconds_so_far =
      solve_seconds_ + std::accumulate(now.solves.begin(), now.solves.end(), 0.0);
  for (const auto& [picture, seconds, share] : now.pictures) {
    Pace& kind = kinds[kind_of_[picture]];
    if (share > says_something) {
      kind.rays += share * rays_[picture];
      kind.seconds += seconds;
    } else {
      seconds_so_far += seconds;
    }
    kind.waiting += (1.0 - share) * rays_[picture];
  }
  Pace all;
  for (const auto& [kind, pace] : kinds) {
    all.rays += pace.rays;
    all.seconds += pace.seconds;
  }
  seconds_so_far += all.seconds;
  const bool solves_to_come = now.waiting_solves + now.solves.size() > 0;
  if (!(all.rays > 0.0) || !(all.seconds > 0.0) || (solves_to_come && solves_ == 0)) {
    return std::nullopt;
  }

  double left = 0.0;
  for (const auto& [kind, pace] : kinds) {
    const Pace& like = pace.rays > 0.0 ? pace : all;
    left += pace.waiting * like.seconds / like.rays;
  }
  if (solves_to_come) {
    const double each = solve_seconds_ / static_cast<double>(solves_);
    left += static_cast<double>(now.waiting_solves) * each;
    for (const double seconds : now.solves) {
      left += std::max(each - seconds, 0.0);
    }
  }
  return left * elapsed / seconds_so_far;
}

} // namespace meninas
