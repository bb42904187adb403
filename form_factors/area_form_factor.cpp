#include "form_factors/area_form_factor.h"

#include "form_factors/point_form_factor.h"

#include <algorithm>
#include <numbers>

namespace meninas {

namespace {

double tau_ln_r(double tau, double h2) {
  // The antiderivative of ln sqrt(tau^2 + h^2): tau ln r - tau + h atan(tau / h), odd in tau.
  const double r2 = tau * tau + h2;
  if (r2 == 0.0)
    return 0.0;
  const double h = std::sqrt(h2);
  return 0.5 * tau * std::log(r2) - tau + (h > 0.0 ? h * std::atan2(tau, h) : 0.0);
}

/// int ln |x - y| over the points y of the edge from q to q + length v.
double log_potential(const Point3& x, const Point3& q, const Direction& v, double length) {
  const Vec3 to = x - q;
  const double along = glm::dot(to, v);
  const Vec3 across = to - along * v;
  const double h2 = glm::dot(across, across);
  return tau_ln_r(length - along, h2) + tau_ln_r(along, h2);
}

/// Where along the edge from p the distance to the other edge has its kinks:
/// nearest points to the other's ends and to its line.
std::vector<double> breaks(const Point3& p, const Direction& u, double length, const Point3& q0,
                           const Point3& q1) {
  std::vector<double> at{0.0, length};
  const Vec3 v = q1 - q0, w = p - q0;
  for (const Point3& end : {q0, q1})
    at.push_back(glm::dot(end - p, u));
  const double uv = glm::dot(u, v), vv = glm::dot(v, v), denominator = vv - uv * uv;
  if (denominator > 1e-24 * vv)
    at.push_back((uv * glm::dot(v, w) - vv * glm::dot(u, w)) / denominator);
  std::erase_if(at, [length](double s) { return !(s >= 0.0 && s <= length); });
  std::sort(at.begin(), at.end());
  return at;
}

/// The terms of the logarithmic potential are of the size of the polygons, one, and so is what
/// they round off: an edge much shorter than that (slivers of clipping) has no digits beyond.
constexpr double rounding_of_potential = 1e-15;

Estimate edge_pair(const Point3& p0, const Point3& p1, const Point3& q0, const Point3& q1) {
  const double length = glm::distance(p0, p1), other = glm::distance(q0, q1);
  if (length == 0.0 || other == 0.0)
    return {};
  const Direction u = (p1 - p0) / length, v = (q1 - q0) / other;
  const double cosine = glm::dot(u, v);
  if (cosine == 0.0)
    return {};
  const auto f = [&](double s) { return log_potential(p0 + s * u, q0, v, other); };
  const auto at = breaks(p0, u, length, q0, q1);
  Estimate sum;
  for (std::size_t k = 1; k < at.size(); ++k)
    if (at[k] > at[k - 1])
      sum = sum +
            integrate(f, at[k - 1], at[k], rounding_of_potential * length * std::max(other, 1.0));
  return cosine * sum;
}

/// 2 pi A_A F_AB by Stokes.
/// Lengths are in units that make the polygons of size one, so that the logarithms are small.
Estimate contour_integral(const ConvexPolygon& a, const ConvexPolygon& b) {
  Estimate sum;
  double magnitude = 0.0;
  for (std::size_t i = 0; i < a.size; ++i)
    for (std::size_t j = 0; j < b.size; ++j) {
      const Estimate term = edge_pair(a.vertices[i], a.vertices[(i + 1) % a.size], b.vertices[j],
                                      b.vertices[(j + 1) % b.size]);
      sum = sum + term;
      magnitude += std::abs(term.value);
    }
  sum.error = std::max(sum.error, 4e-16 * magnitude);
  return sum;
}

/// int_A F(x,
/// B) dA by n x n Gauss points in each triangle of A's fan (Duffy's square onto the triangle).
double gauss_integral(const ConvexPolygon& a, const Direction& normal, const ConvexPolygon& b,
                      std::span<const double> nodes, std::span<const double> weights) {
  double sum = 0.0;
  for (std::size_t k = 2; k < a.size; ++k) {
    const Vec3 e1 = a.vertices[k - 1] - a.vertices[0], e2 = a.vertices[k] - a.vertices[0];
    const double jacobian = glm::length(glm::cross(e1, e2));
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < nodes.size(); ++j) {
        const double s = nodes[i], t = nodes[j];
        const Point3 x = a.vertices[0] + s * (1.0 - t) * e1 + s * t * e2;
        sum += weights[i] * weights[j] * s * jacobian * point_form_factor(x, normal, b.span());
      }
  }
  return sum;
}

struct UnitRule {
  std::vector<double> nodes, weights;
};

/// Gauss and Legendre's rules on [0, 1], from those on [-1, 1] given by half.
template <std::size_t Half>
UnitRule unit_rule(const std::array<double, Half>& nodes, const std::array<double, Half>& weights) {
  UnitRule rule;
  for (std::size_t k = 0; k < Half; ++k)
    for (const double sign : {-1.0, 1.0}) {
      if (nodes[k] == 0.0 && sign > 0.0)
        continue;
      rule.nodes.push_back(0.5 + 0.5 * sign * nodes[k]);
      rule.weights.push_back(0.5 * weights[k]);
    }
  return rule;
}

const UnitRule gauss3 =
    unit_rule<2>({0.774596669241483377035853079956480, 0.0},
                 {0.555555555555555555555555555555556, 0.888888888888888888888888888888889});
const UnitRule gauss5 =
    unit_rule<3>({0.906179845938663992797626878299393, 0.538469310105683091036314420700209, 0.0},
                 {0.236926885056189087514264040719917, 0.478628670499366468041291514835638,
                  0.568888888888888888888888888888889});
const UnitRule gauss7 = unit_rule<4>({quadrature::kronrod_nodes[1], quadrature::kronrod_nodes[3],
                                      quadrature::kronrod_nodes[5], quadrature::kronrod_nodes[7]},
                                     quadrature::gauss_weights);
const UnitRule kronrod15 = unit_rule<8>(quadrature::kronrod_nodes, quadrature::kronrod_weights);

/// int_A F(x, B) dA / area by Gauss points, with an error from a coarser rule. Far apart a few
/// points have converged: going from three to five in each direction multiplies the digits by 5/3.
Estimate by_gauss_points(const ConvexPolygon& a, const Direction& normal, const ConvexPolygon& b,
                         double area) {
  const auto mean = [&](const UnitRule& rule) {
    return gauss_integral(a, normal, b, rule.nodes, rule.weights) / area;
  };
  constexpr double rounding = 1e-14, margin = 10.0, far_apart = 1e-7;
  const double three = mean(gauss3), five = mean(gauss5);
  const double change = std::abs(five - three);
  if (five <= 0.0)
    return {};
  if (change <= far_apart * five)
    return {five, five * std::max(margin * std::pow(change / five, 5.0 / 3.0), rounding)};
  const double fine = mean(kronrod15), rough = mean(gauss7);
  return {fine, std::max(0.1 * std::abs(fine - rough), rounding * fine)};
}

struct Sphere {
  Point3 centre{0.0};
  double radius = 0.0;
};

Sphere sphere_around(const ConvexPolygon& polygon) {
  Sphere sphere;
  for (const auto& vertex : polygon.span())
    sphere.centre += vertex / double(polygon.size);
  for (const auto& vertex : polygon.span())
    sphere.radius = std::max(sphere.radius, glm::distance(vertex, sphere.centre));
  return sphere;
}

/// Least distance of the polygon's vertices from a plane:
/// no point of it is nearer to anything in that plane.
double min_height(const ConvexPolygon& polygon, const Point3& origin, const Vec3& front) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& vertex : polygon.span())
    least = std::min(least, glm::dot(vertex - origin, front) / glm::length(front));
  return least;
}

ConvexPolygon scaled(const ConvexPolygon& polygon, const Point3& origin, double scale) {
  ConvexPolygon result;
  for (const auto& vertex : polygon.span())
    result.push_back((vertex - origin) * scale);
  return result;
}

} // namespace

Estimate area_form_factor(const ConvexPolygon& a, const ConvexPolygon& b) {
  const Vec3 front_a = area_vector(a.span()), front_b = area_vector(b.span());
  const double whole_area = glm::length(front_a);
  if (whole_area <= 0.0 || glm::length(front_b) <= 0.0)
    return {};

  // Only what lies in front of the other's plane takes part.
  const ConvexPolygon lit = clip(a, b.vertices[0], front_b), seen = clip(b, a.vertices[0], front_a);
  if (lit.empty() || seen.empty())
    return {};
  const Sphere around_a = sphere_around(lit), around_b = sphere_around(seen);
  const double gap =
      glm::distance(around_a.centre, around_b.centre) - around_a.radius - around_b.radius;
  const double size = std::max(around_a.radius, around_b.radius);
  if (!(size > 0.0)) // of faces that share a corner that alone may be in front of the other
    return {};

  // Gauss points see a smooth integrand where the polygons are well apart;
  // thin ones are theirs as well.
  const Estimate by_points = by_gauss_points(lit, front_a / whole_area, seen, whole_area);
  if (gap > size)
    return by_points;

  const double scale = 1.0 / size;
  const Estimate integral =
      contour_integral(scaled(lit, around_a.centre, scale), scaled(seen, around_a.centre, scale));
  const Estimate factor = 1.0 / (2.0 * std::numbers::pi * whole_area * scale * scale) * integral;
  const double apart = std::max(min_height(lit, seen.vertices[0], front_b),
                                min_height(seen, lit.vertices[0], front_a));
  if (apart > 0.25 * size && by_points.error < factor.error)
    return by_points;
  return {std::max(0.0, factor.value), factor.error};
}

} // namespace meninas
