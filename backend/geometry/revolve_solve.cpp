// Where a ray meets a surface of revolution: see the Numerics block of revolve.hpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "backend/geometry/profile_point.hpp"
#include "backend/geometry/revolve.hpp"

namespace scenec::backend {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Pieces of s of this depth are as narrow as s itself is known (2^-48 of a segment).
constexpr int max_piece_depth = 48;
constexpr int max_pieces = 4096;
// Newton within a bracket converges quadratically and falls back to halving.
constexpr int max_root_steps = 80;
// What a hit's `b` says of its root: see revolve.hpp.
constexpr double certified = 0;
constexpr double uncertified = 1;

struct Range {
  double low = -infinity;
  double high = infinity;

  [[nodiscard]] bool empty() const { return !(low <= high); }
  [[nodiscard]] bool has_zero() const { return !(low > 0 || high < 0); }
};

Range meet(const Range& a, const Range& b) {
  return {std::max(a.low, b.low), std::min(a.high, b.high)};
}
Range operator-(const Range& a, const Range& b) {
  return {a.low - b.high, a.high - b.low};
}
Range operator-(const Range& a) {
  return {-a.high, -a.low};
}
Range operator*(const Range& a, const Range& b) {
  const double p = a.low * b.low;
  const double q = a.low * b.high;
  const double r = a.high * b.low;
  const double s = a.high * b.high;
  return {std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s))};
}
Range operator*(const Range& a, double s) {
  return s >= 0 ? Range{a.low * s, a.high * s} : Range{a.high * s, a.low * s};
}
// `b` positive.
Range operator/(const Range& a, const Range& b) {
  return {a.low < 0 ? a.low / b.low : a.low / b.high,
          a.high > 0 ? a.high / b.low : a.high / b.high};
}

// Before (near) and after (far) the ray's closest approach to the axis.
using Branches = unsigned;
constexpr Branches near_branch = 1;
constexpr Branches far_branch = 2;
constexpr Branches both_branches = 3;

// A part of a segment by its own control points, in rows of plain numbers so that making one does
// not zero them first.
struct Piece {
  std::array<double, max_profile_degree + 1> radius;
  std::array<double, max_profile_degree + 1> height;
  std::size_t degree = 0;
  double start = 0;  // in s of the segment
  double width = 1;

  [[nodiscard]] ProfileJet at(double s) const {
    std::array<double, max_profile_degree + 1> x;
    std::array<double, max_profile_degree + 1> y;
    for (std::size_t i = 0; i <= degree; ++i) {
      x[i] = radius[i];
      y[i] = height[i];
    }
    return evaluate_in_place(x.data(), y.data(), degree, s);
  }
};

void halve_row(std::size_t n, const double* row, double* left, double* right) {
  for (std::size_t i = 0; i <= n; ++i) right[i] = row[i];
  for (std::size_t level = 0; level < n; ++level) {
    left[level] = right[0];
    for (std::size_t i = 0; i < n - level; ++i) right[i] = 0.5 * (right[i] + right[i + 1]);
  }
  left[n] = right[0];
  // What is left of the triangle runs along its right edge: right[i] is the i-th of the second
  // half.
}

void halve(const Piece& piece, Piece& left, Piece& right) {
  const std::size_t n = piece.degree;
  left.degree = right.degree = n;
  left.width = right.width = 0.5 * piece.width;
  left.start = piece.start;
  right.start = piece.start + left.width;
  halve_row(n, piece.radius.data(), left.radius.data(), right.radius.data());
  halve_row(n, piece.height.data(), left.height.data(), right.height.data());
}

struct Hull {
  Range radius;  // signed
  Range height;
  Range radius_slope;
  Range height_slope;
};

void widen(Range& r, double v) {
  r.low = std::min(r.low, v);
  r.high = std::max(r.high, v);
}

Hull hull_of(const Piece& piece) {
  const double* r = piece.radius.data();
  const double* y = piece.height.data();
  Hull h{{r[0], r[0]}, {y[0], y[0]}, {infinity, -infinity}, {infinity, -infinity}};
  for (std::size_t i = 1; i <= piece.degree; ++i) {
    widen(h.radius, r[i]);
    widen(h.height, y[i]);
    widen(h.radius_slope, r[i] - r[i - 1]);
    widen(h.height_slope, y[i] - y[i - 1]);
  }
  const auto n = static_cast<double>(piece.degree);
  h.radius_slope = h.radius_slope * n;
  h.height_slope = h.height_slope * n;
  return h;
}

class Solver {
 public:
  Solver(const Revolve& revolve, const Ray& ray, std::vector<ShapeHit>* all)
      : revolve_(revolve), all_(all), t_min_(ray.t_min), t_max_(ray.t_max) {
    prepare(ray);
  }

  bool run(ShapeHit& out) {
    for (std::size_t i = 0; i < revolve_.pieces().size(); ++i) {
      const Revolve::Piece& shell = revolve_.pieces()[i];
      if (shell.radius_max + slack_ < closest_) continue;
      segment_ = i;
      pieces_ = 0;
      Piece whole;
      const auto control = revolve_.profile().segment(i);
      for (std::size_t k = 0; k < control.size(); ++k) {
        whole.radius[k] = control[k].radius;
        whole.height[k] = control[k].height;
      }
      whole.degree = control.size() - 1;
      search(whole, 0, both_branches);
    }
    if (!found_) return false;
    if (cut_short_) doubt_all();
    out = best_;
    return true;
  }

 private:
  // Scales the direction by a power of two and moves a far origin to the closest approach, so that
  // all that follows happens at the profile's own size.
  void prepare(const Ray& ray) {
    Vector3 o = axis_from_object(as_vector(ray.origin), revolve_.axis());
    Vector3 d = axis_from_object(ray.direction, revolve_.axis());
    int exponent = 0;
    std::frexp(max_abs(d), &exponent);
    d = {std::ldexp(d.x, -exponent), std::ldexp(d.y, -exponent), std::ldexp(d.z, -exponent)};
    exponent_ = -exponent;
    double size = 0;
    for (const Revolve::Piece& p : revolve_.pieces())
      size = std::max({size, p.radius_max, std::fabs(p.height_min), std::fabs(p.height_max)});
    const double far = max_abs(o);
    if (far > 4 * size) {
      shift_ = -dot(o, d) / dot(d, d);
      o = o + shift_ * d;
    }
    slack_ = gamma(16) * (size + std::min(max_abs(o), 4 * size)) + gamma(2) * far;
    o_ = o;
    d_ = d;
    a_ = d.x * d.x + d.z * d.z;
    b_ = o.x * d.x + o.z * d.z;
    middle_ = a_ > 0 ? -b_ / a_ : 0;
    const double x = o.x + middle_ * d.x;
    const double z = o.z + middle_ * d.z;
    closest_ = std::sqrt(x * x + z * z);
    narrow_window();
  }

  [[nodiscard]] double local_t(double t) const { return std::ldexp(t, -exponent_) - shift_; }
  [[nodiscard]] double ray_t(double local) const { return std::ldexp(local + shift_, exponent_); }
  void narrow_window() {
    // Only for pruning: the interval itself is judged on final values.
    window_ = {local_t(t_min_) - 4 * slack_, local_t(t_max_) + 4 * slack_};
  }

  [[nodiscard]] double rho_squared(double t) const {
    const double x = o_.x + t * d_.x;
    const double z = o_.z + t * d_.z;
    return x * x + z * z;
  }
  // Half the length of ray within radius r, in t.
  [[nodiscard]] double half_chord(double r) const {
    const double square = (r - closest_) * (r + closest_) / a_;
    return square > 0 ? std::sqrt(square) : 0;
  }

  // The t for which the ray is between two heights.
  [[nodiscard]] Range slab(double low, double high) const {
    if (d_.y == 0) return o_.y >= low && o_.y <= high ? Range{} : Range{1, -1};
    const double t0 = (low - o_.y) / d_.y;
    const double t1 = (high - o_.y) / d_.y;
    return t0 <= t1 ? Range{t0, t1} : Range{t1, t0};
  }

  void search(const Piece& piece, int depth, Branches branches) {
    if (++pieces_ > max_pieces) {
      cut_short_ = true;
      return;
    }
    const Hull hull = hull_of(piece);
    const double outer = std::max(std::fabs(hull.radius.low), std::fabs(hull.radius.high)) + slack_;
    const double inner =
        hull.radius.has_zero()
            ? 0
            : std::min(std::fabs(hull.radius.low), std::fabs(hull.radius.high)) - slack_;
    if (outer < closest_) return;
    const Range level = slab(hull.height.low - slack_, hull.height.high + slack_);
    const Range reach = meet(level, window_);
    if (reach.empty()) return;
    double s_in = 0;
    double s_out = infinity;
    if (a_ > 0) {
      s_out = half_chord(outer);
      if (inner > closest_) s_in = half_chord(inner);
      if (meet({middle_ - s_out, middle_ - s_in}, reach).empty()) branches &= ~near_branch;
      if (meet({middle_ + s_in, middle_ + s_out}, reach).empty()) branches &= ~far_branch;
    } else if (closest_ < inner) {
      return;
    }
    if (branches == 0) return;
    const Range radial = hull.radius * hull.radius_slope * d_.y;
    // Elimination of t by the radius: F(s) = height(t(r(s))) - h(s).
    if (s_in > 0 && a_ > 0) {
      const Range push = radial / Range{a_ * s_in, a_ * s_out};
      if ((branches & near_branch) != 0 && !(-push - hull.height_slope).has_zero()) {
        root_by_radius(piece, -1);
        branches &= ~near_branch;
      }
      if ((branches & far_branch) != 0 && !(push - hull.height_slope).has_zero()) {
        root_by_radius(piece, 1);
        branches &= ~far_branch;
      }
    }
    if (branches == 0) return;
    // Elimination by the height: E(s) = rho^2(t(h(s))) - r(s)^2.
    if (d_.y != 0) {
      const Range approach{a_ * level.low + b_, a_ * level.high + b_};
      if (!(approach * hull.height_slope - radial).has_zero()) {
        root_by_height(piece, branches);
        return;
      }
    }
    if (depth == max_piece_depth) {
      accept_degenerate(piece, branches, reach);
      return;
    }
    descend(piece, depth, branches);
  }

  void descend(const Piece& piece, int depth, Branches branches) {
    Piece left;
    Piece right;
    halve(piece, left, right);
    // The half the ray reaches first is likely to prune the other.
    const bool rising = piece.height[piece.degree] >= piece.height[0];
    const bool left_first = rising == (d_.y >= 0);
    search(left_first ? left : right, depth + 1, branches);
    search(left_first ? right : left, depth + 1, branches);
  }

  struct Sample {
    double value;
    double slope;
    double error;
    double t;
  };

  [[nodiscard]] Sample by_radius(const ProfileJet& jet, double side) const {
    const double s = half_chord(std::fabs(jet.point.radius));
    const double t = middle_ + side * s;
    const double stretch = d_.y * jet.point.radius / (side * a_ * s);
    return {o_.y + t * d_.y - jet.point.height, stretch * jet.slope.radius - jet.slope.height,
            slack_ * (1 + std::fabs(stretch)), t};
  }

  [[nodiscard]] Sample by_height(const ProfileJet& jet) const {
    const double t = (jet.point.height - o_.y) / d_.y;
    const double r = jet.point.radius;
    const double square = rho_squared(t);
    const double stretch = (a_ * t + b_) / d_.y;
    return {square - r * r, 2 * (stretch * jet.slope.height - r * jet.slope.radius),
            2 * slack_ * (std::fabs(r) + std::sqrt(square) + std::fabs(stretch)), t};
  }

  void root_by_radius(const Piece& piece, double side) {
    find_root(piece, both_branches, [&](const ProfileJet& jet) { return by_radius(jet, side); });
  }
  void root_by_height(const Piece& piece, Branches branches) {
    find_root(piece, branches, [&](const ProfileJet& jet) { return by_height(jet); });
  }

  // The root of a function known to be monotone on the piece, if its ends say that there is one. An
  // end that is zero within its error counts, so that no root is lost between two pieces.
  template <class Function>
  void find_root(const Piece& piece, Branches branches, Function&& function) {
    const Sample first = function(piece.at(0));
    const Sample last = function(piece.at(1));
    const bool change = (first.value < 0) != (last.value < 0);
    if (!change) {
      if (std::fabs(first.value) <= first.error)
        accept(piece.start, first.t, branches);
      else if (std::fabs(last.value) <= last.error)
        accept(piece.start + piece.width, last.t, branches);
      return;
    }
    double low = 0;
    double high = 1;
    double u = first.value / (first.value - last.value);
    Sample at = first;
    for (int step = 0; step < max_root_steps; ++step) {
      if (!(u > low && u < high)) u = 0.5 * (low + high);
      at = function(piece.at(u));
      if (at.value == 0) break;
      ((at.value < 0) == (first.value < 0) ? low : high) = u;
      const double next = u - at.value / at.slope;
      const bool settled =
          std::fabs(next - u) <= 2 * unit_roundoff || high - low <= 2 * unit_roundoff;
      u = next;
      if (settled) break;
    }
    u = std::clamp(u, low, high);
    accept(piece.start + piece.width * u, at.t, branches);
  }

  // A piece too narrow to divide on which nothing is monotone: the ray touches the surface there.
  void accept_degenerate(const Piece& piece, Branches branches, const Range& reach) {
    double t = std::clamp(middle_, reach.low, reach.high);
    if (a_ == 0 || branches != both_branches)
      t = std::clamp(local_t(t_min_), reach.low, reach.high);
    if (d_.y != 0) t = (piece.at(0.5).point.height - o_.y) / d_.y;
    accept(piece.start + 0.5 * piece.width, t, both_branches, uncertified);
  }

  struct Residual {
    ProfileJet jet;
    double radial;  // rho^2 - r^2
    double level;
    double rho;
  };
  [[nodiscard]] Residual residual(double s, double t) const {
    const ProfileJet jet = evaluate_profile(revolve_.profile().segment(segment_), s);
    const double square = rho_squared(t);
    return {jet, square - jet.point.radius * jet.point.radius, o_.y + t * d_.y - jet.point.height,
            std::sqrt(square)};
  }
  [[nodiscard]] double size_of(const Residual& r) const {
    const double reach = r.rho + std::fabs(r.jet.point.radius);
    return std::max(std::fabs(r.level), reach > 0 ? std::fabs(r.radial) / reach : 0);
  }

  // Newton in (t, s) on the undivided segment; a step that does not help is not taken.
  void polish(double& s, double& t, Residual& r) const {
    for (int i = 0; i < 2; ++i) {
      const double tt = 2 * (a_ * t + b_);
      const double ts = -2 * r.jet.point.radius * r.jet.slope.radius;
      const double lt = d_.y;
      const double ls = -r.jet.slope.height;
      const double determinant = tt * ls - ts * lt;
      if (!(determinant != 0)) return;
      const double next_t = t - (r.radial * ls - ts * r.level) / determinant;
      const double next_s = std::clamp(s - (tt * r.level - r.radial * lt) / determinant, 0.0, 1.0);
      if (!std::isfinite(next_t) || !std::isfinite(next_s)) return;
      const Residual next = residual(next_s, next_t);
      if (!(size_of(next) < size_of(r))) return;
      s = next_s;
      t = next_t;
      r = next;
    }
  }

  void accept(double s, double local, Branches branches, double proof = certified) {
    const bool far = local > middle_;
    if (branches != both_branches && (branches & (far ? far_branch : near_branch)) == 0) return;
    Residual r = residual(s, local);
    polish(s, local, r);
    if (!(size_of(r) <= 4 * slack_)) return;
    const double t = ray_t(local);
    if (!(t >= t_min_ && t <= t_max_) || std::isinf(t)) return;
    const ShapeHit hit{t, static_cast<std::uint32_t>(segment_), s, proof};
    if (all_ != nullptr) {
      add_to_all(hit);
      found_ = true;
      return;
    }
    if (found_ && t == best_.t && hit.part >= best_.part) return;
    best_ = hit;
    found_ = true;
    t_max_ = t;
    narrow_window();
  }

  // A nearer root may be in a piece that was not looked at.
  void doubt_all() {
    best_.b = uncertified;
    if (all_ == nullptr) return;
    for (ShapeHit& h : *all_) h.b = uncertified;
  }

  // The same point may be found from both pieces at a joint.
  void add_to_all(const ShapeHit& hit) {
    const double same = std::ldexp(64 * slack_, exponent_);
    for (const ShapeHit& h : *all_) {
      const double apart =
          std::fabs((static_cast<double>(h.part) - static_cast<double>(hit.part)) + (h.a - hit.a));
      if (std::fabs(h.t - hit.t) <= same && apart <= gamma(4096)) return;
    }
    all_->push_back(hit);
  }

  const Revolve& revolve_;
  std::vector<ShapeHit>* all_;
  double t_min_;
  double t_max_;
  Range window_;
  Vector3 o_;
  Vector3 d_;
  int exponent_ = 0;
  double shift_ = 0;
  double slack_ = 0;  // how far off the surface a ray may pass and still be said to meet it
  double a_ = 0;      // |d|^2 and o.d across the axis
  double b_ = 0;
  double middle_ = 0;   // t of the closest approach to the axis
  double closest_ = 0;  // and its distance
  std::size_t segment_ = 0;
  int pieces_ = 0;
  bool cut_short_ = false;  // the pieces ran out
  ShapeHit best_;
  bool found_ = false;
};

}  // namespace

bool intersect(const Revolve& revolve, const Ray& ray, ShapeHit& out) {
  if (revolve.finder() == RootFinder::newton) return intersect_by_newton(revolve, ray, out);
  return Solver(revolve, ray, nullptr).run(out);
}

void intersect_all(const Revolve& revolve, const Ray& ray, std::vector<ShapeHit>& out) {
  out.clear();
  ShapeHit unused;
  Solver(revolve, ray, &out).run(unused);
  std::sort(out.begin(), out.end(), [](const ShapeHit& a, const ShapeHit& b) { return a.t < b.t; });
}

}  // namespace scenec::backend
