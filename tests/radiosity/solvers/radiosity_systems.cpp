#include "tests/radiosity/solvers/radiosity_systems.h"

#include <cmath>

namespace meninas::test {

Transport transport_of(const std::vector<Eigen::MatrixXd>& bands) {
  Transport transport;
  transport.size = static_cast<std::size_t>(bands[0].rows());
  transport.bands = static_cast<int>(bands.size());
  transport.row_begin.push_back(0);
  for (Eigen::Index i = 0; i < bands[0].rows(); ++i) {
    for (Eigen::Index j = 0; j < bands[0].cols(); ++j) {
      if (bands[0](i, j) == 0.0)
        continue;
      transport.columns.push_back(static_cast<std::uint32_t>(j));
      for (const auto& band : bands)
        transport.weights.push_back(static_cast<float>(band(i, j)));
    }
    transport.row_begin.push_back(transport.columns.size());
  }
  return transport;
}

System random_system(Random& random, int size, int bands, double highest_reflectance,
                     double emission) {
  std::vector<Eigen::MatrixXd> matrices;
  for (int b = 0; b < bands; ++b) {
    Eigen::MatrixXd m(size, size);
    for (Eigen::Index i = 0; i < size; ++i) {
      for (Eigen::Index j = 0; j < size; ++j)
        m(i, j) = random.between(0.01, 1.0);
      m.row(i) /= m.row(i).sum() * (b == 0 ? 1.0 : 1.3);
    }
    matrices.push_back(m);
  }
  System system{transport_of(matrices), {}, {}};
  for (int i = 0; i < size; ++i) {
    system.source.push_back(emission * random.in_box(Vec3(0.0), Vec3(1.0)));
    system.reflectance.push_back(highest_reflectance * random.in_box(Vec3(0.5), Vec3(1.0)));
  }
  return system;
}

ReciprocalSystem reciprocal_system(Random& random, int size, double orders, double closure) {
  Eigen::VectorXd extent(size);
  for (Eigen::Index i = 0; i < size; ++i)
    extent(i) = std::pow(10.0, -random.between(0.0, orders));
  Eigen::MatrixXd exchange(size, size);
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = 0; j <= i; ++j)
      exchange(i, j) = exchange(j, i) = extent(i) * extent(j) * random.between(0.1, 1.0);

  ReciprocalSystem result;
  Eigen::MatrixXd factors = exchange;
  for (Eigen::Index i = 0; i < size; ++i) {
    result.area.push_back(exchange.row(i).sum() / closure);
    factors.row(i) /= result.area.back();
  }
  result.system.transport = transport_of({factors});
  for (int i = 0; i < size; ++i) {
    result.system.source.push_back(random.in_box(Vec3(0.0), Vec3(1.0)));
    result.system.reflectance.push_back(random.in_box(Vec3(0.1), Vec3(0.95)));
  }
  return result;
}

std::vector<Rgb> exact_solution(const System& system) {
  using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  const Transport& transport = system.transport;
  const auto n = static_cast<Eigen::Index>(transport.size);
  const auto bands = static_cast<std::size_t>(transport.bands);
  std::vector<Rgb> solution(transport.size);
  for (int band = 0; band < 3; ++band) {
    Matrix a = Matrix::Identity(n, n);
    Eigen::Matrix<long double, Eigen::Dynamic, 1> b(n);
    for (std::size_t i = 0; i < transport.size; ++i) {
      b(static_cast<Eigen::Index>(i)) = system.source[i][band];
      for (auto k = transport.row_begin[i]; k < transport.row_begin[i + 1]; ++k)
        a(static_cast<Eigen::Index>(i), transport.columns[k]) -=
            static_cast<long double>(system.reflectance[i][band]) *
            transport.weights[k * bands + (bands == 1 ? 0 : static_cast<std::size_t>(band))];
    }
    const Eigen::Matrix<long double, Eigen::Dynamic, 1> x = a.partialPivLu().solve(b);
    for (std::size_t i = 0; i < transport.size; ++i)
      solution[i][band] = static_cast<double>(x(static_cast<Eigen::Index>(i)));
  }
  return solution;
}

double true_error(const std::vector<Rgb>& exact, const std::vector<Rgb>& x) {
  double worst = 0.0;
  for (int band = 0; band < 3; ++band) {
    double error = 0.0, size = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      error = std::max(error, std::abs(exact[i][band] - x[i][band]));
      size = std::max(size, std::abs(x[i][band]));
    }
    if (error > 0.0)
      worst = std::max(worst, error / size);
  }
  return worst;
}

} // namespace meninas::test
