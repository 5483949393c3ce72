#include "tests/numerics/profile_roots.hpp"

#include <algorithm>
#include <cstddef>

namespace scenec::numerics {
namespace {

using backend::ProfilePoint;
using Real = long double;
using Coefficients = std::vector<Real>;

constexpr int max_depth = 60;

Real binomial(std::size_t n, std::size_t k) {
  Real out = 1;
  for (std::size_t i = 1; i <= k; ++i) out = out * Real(n - k + i) / Real(i);
  return out;
}

Coefficients product(const Coefficients& a, const Coefficients& b) {
  const std::size_t n = a.size() - 1;
  const std::size_t m = b.size() - 1;
  Coefficients out(n + m + 1, Real(0));
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t j = 0; j <= m; ++j)
      out[i + j] += binomial(n, i) * binomial(m, j) / binomial(n + m, i + j) * a[i] * b[j];
  return out;
}

Real value(Coefficients c, Real s) {
  for (std::size_t level = c.size() - 1; level > 0; --level)
    for (std::size_t i = 0; i < level; ++i) c[i] = (1 - s) * c[i] + s * c[i + 1];
  return c[0];
}

Real slope(const Coefficients& c, Real s) {
  Coefficients d;
  for (std::size_t i = 0; i + 1 < c.size(); ++i)
    d.push_back(Real(c.size() - 1) * (c[i + 1] - c[i]));
  return value(d, s);
}

// How large the squares get on the curve itself, whose control points may swing much wider.
Real size_of(const Coefficients& x, const Coefficients& z, const Coefficients& r) {
  Real size = 0;
  for (int i = 0; i <= 16; ++i) {
    const Real s = Real(i) / 16;
    const Real a = value(x, s);
    const Real b = value(z, s);
    const Real c = value(r, s);
    size = std::max({size, a * a + b * b, c * c});
  }
  return size;
}

int sign_changes(const Coefficients& c) {
  int changes = 0;
  int last = 0;
  for (const Real v : c) {
    const int sign = v > 0 ? 1 : v < 0 ? -1 : 0;
    if (sign != 0 && last != 0 && sign != last) ++changes;
    if (sign != 0) last = sign;
  }
  return changes;
}

// False when the roots cannot be told apart.
bool isolate(Coefficients c, Real low, Real high, int depth, std::vector<Real>& out) {
  const int changes = sign_changes(c);
  if (changes == 0) return true;
  if (depth > max_depth) return false;
  if (changes == 1 && depth > 4) {
    // The one root, by Newton within the interval whose ends have the signs.
    const bool rises = c.front() < 0;
    Real a = 0;
    Real b = 1;
    Real at = Real(0.5);
    for (int i = 0; i < 80 && a < b; ++i) {
      const Real v = value(c, at);
      ((v < 0) == rises ? a : b) = at;
      Real next = at - v / slope(c, at);
      if (!(next > a && next < b)) next = (a + b) / 2;
      if (magnitude(next - at) < Real(1e-18)) break;
      at = next;
    }
    out.push_back(low + (high - low) * at);
    return true;
  }
  Coefficients left;
  Coefficients right = std::move(c);
  for (std::size_t level = right.size() - 1;; --level) {
    left.push_back(right[0]);
    if (level == 0) break;
    for (std::size_t i = 0; i < level; ++i) right[i] = (right[i] + right[i + 1]) / 2;
  }
  const Real middle = (low + high) / 2;
  return isolate(std::move(left), low, middle, depth + 1, out) &&
         isolate(std::move(right), middle, high, depth + 1, out);
}

// Where the ray has risen by `rise`; of a nearly level ray, where it is `radius` off the axis.
Real t_at(const V3<Real>& o, const V3<Real>& d, Real rise, Real radius) {
  Real t = rise / d.y;
  if (magnitude(d.y) > Real(0.1) * length(d)) return t;
  for (int i = 0; i < 3; ++i) {
    const Real x = o.x + t * d.x;
    const Real z = o.z + t * d.z;
    const Real slope = 2 * (x * d.x + z * d.z);
    if (magnitude(slope) > Real(0.1) * length(d) * radius)
      t -= (x * x + z * z - radius * radius) / slope;
  }
  return t;
}

}  // namespace

std::optional<std::vector<ProfileRoot>> roots_of(const backend::Profile& profile,
                                                 const backend::Ray& ray) {
  const V3<Real> o = as<Real>(ray.origin);
  const V3<Real> d = as<Real>(ray.direction);
  std::vector<ProfileRoot> out;
  for (std::size_t k = 0; k < profile.size(); ++k) {
    Coefficients x, z, r, h;
    for (const ProfilePoint& p : profile.segment(k)) {
      const Real rise = Real(p.height) - o.y;
      x.push_back(o.x * d.y + rise * d.x);
      z.push_back(o.z * d.y + rise * d.z);
      r.push_back(Real(p.radius) * d.y);
      h.push_back(rise);
    }
    Coefficients f = product(x, x);
    const Coefficients zz = product(z, z);
    const Coefficients rr = product(r, r);
    const Real size = size_of(x, z, r);
    for (std::size_t i = 0; i < f.size(); ++i) f[i] += zz[i] - rr[i];
    std::vector<Real> s;
    if (!isolate(f, 0, 1, 0, s)) return std::nullopt;
    // A root just outside an end may be given to it by rounding, one just inside may not.
    const Real near_end = Real(1e-10) * size;
    if (magnitude(f.front()) < near_end || magnitude(f.back()) < near_end) return std::nullopt;
    for (const Real root_s : s) {
      const Real t = t_at(o, d, value(h, root_s), value(r, root_s) / d.y);
      const Real steep = magnitude(slope(f, root_s)) / size;
      if (steep < Real(1e-5) || magnitude(t) < Real(1e-9)) return std::nullopt;
      if (t > 0) out.push_back({k, root_s, t, static_cast<double>(steep)});
    }
  }
  std::sort(out.begin(), out.end(),
            [](const ProfileRoot& a, const ProfileRoot& b) { return a.t < b.t; });
  return out;
}

}  // namespace scenec::numerics
