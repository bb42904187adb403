// The error of a sum of many parts,
// each with an estimate of its own error and the sign it is likely to have.
//
// Taken one by one the errors e_r cannot exceed sum |e_r|.
// Where many parts are as likely too large as too small they nearly cancel:
//   |sum e_r| <= |sum of what is known to lean one way| + 4 sqrt(sum e_r^2),
// four standard deviations, each e_r taken for one.
// The smaller of the two is the estimate: few parts add up, many average out.
#pragma once

#include <algorithm>
#include <cmath>

namespace meninas {

class ErrorSum {
public:
  /// `error` >= |signed_error|; parts that cannot cancel with themselves come as one.
  void add(double error, double signed_error) { change(1.0, error, signed_error); }
  void remove(double error, double signed_error) { change(-1.0, error, signed_error); }

  double estimate() const {
    constexpr double deviations = 4.0;
    return std::max(0.0, std::min(absolute_, std::abs(signed_) +
                                                 deviations * std::sqrt(std::max(0.0, squares_))));
  }

private:
  void change(double sense, double error, double signed_error) {
    absolute_ += sense * error;
    squares_ += sense * error * error;
    signed_ += sense * signed_error;
  }

  double absolute_ = 0.0, squares_ = 0.0, signed_ = 0.0;
};

} // namespace meninas
