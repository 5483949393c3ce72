#include "backend/math/student.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scenec::backend {
namespace {

constexpr int most_steps = 500;
constexpr double fraction_accuracy = 1e-13;
constexpr double smallest = 1e-300;  // stands for 0 where Lentz's method divides

// The continued fraction of I_x(a, b), which converges fast for x < (a + 1) / (a + b + 2).
double beta_fraction(double x, double a, double b) {
  const auto no_zero = [](double v) { return std::abs(v) < smallest ? smallest : v; };
  double c = 1;
  double d = 1 / no_zero(1 - (a + b) * x / (a + 1));
  double result = d;
  for (int step = 1; step <= most_steps; ++step) {
    const double m = step;
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1 / no_zero(1 + even * d);
    c = no_zero(1 + even / c);
    result *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1 / no_zero(1 + odd * d);
    c = no_zero(1 + odd / c);
    result *= d * c;
    if (std::abs(d * c - 1) < fraction_accuracy) break;
  }
  return result;
}

// log(x^a (1-x)^b / (a B(a, b))), y = 1 - x.
double log_front(double log_x, double log_y, double a, double b) {
  return a * log_x + b * log_y + std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) - std::log(a);
}

}  // namespace

double log_student_tail(double t, double freedom) {
  if (!(t > 0) || !(freedom > 0)) return 0;
  if (std::isinf(t)) return -std::numeric_limits<double>::infinity();
  const double a = freedom / 2;
  const double b = 0.5;
  const double ratio = t / freedom * t;
  const double log_x = -std::log1p(ratio);
  const double log_y = std::log(ratio) + log_x;
  const double x = std::exp(log_x);
  if (x < (a + 1) / (a + b + 2))
    return std::min(0.0, log_front(log_x, log_y, a, b) + std::log(beta_fraction(x, a, b)));
  const double below =
      std::exp(log_front(log_y, log_x, b, a)) * beta_fraction(std::exp(log_y), b, a);
  return std::log1p(-std::clamp(below, 0.0, 1.0));
}

}  // namespace scenec::backend
