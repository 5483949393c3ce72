#include "backend/lights/sphere_paths.hpp"

#include <cmath>

#include "backend/math/vec.hpp"

namespace scenec::backend {
namespace {

// An angle by its cosine and sine, times any positive factor.
struct Phase {
  double c = 1;
  double s = 0;
};
Phase operator*(const Phase& a, const Phase& b) {
  return {a.c * b.c - a.s * b.s, a.s * b.c + a.c * b.s};
}
Phase conj(const Phase& a) {
  return {a.c, -a.s};
}
Phase scaled_to_unit(const Phase& a) {
  const double scale = 1 / std::sqrt(a.c * a.c + a.s * a.s);
  return {a.c * scale, a.s * scale};
}
// asin(b / d), times d.
Phase arc(double b2, double b, double d2) {
  return {std::sqrt(d2 - b2), b};
}
double square(double x) {
  return x * x;
}

// What is solved for: where `angle` is 0 along t from 0 to a right angle.
struct Value {
  Phase angle;
  double slope = 0;  // by t
};
// Positive, negative or 0 as the angle is, which lies within (-pi, pi).
double size_of(const Phase& a) {
  const double norm = std::sqrt(a.c * a.c + a.s * a.s);
  if (a.c > 0) return a.s / norm;
  return a.s < 0 ? -1 : 1;
}

// The root between `low` and `high`, unit phases of t, where the angle changes its sign.
template <class Evaluate>
Phase root_between(Phase low, Phase high, bool rising, Phase at, const Evaluate& evaluate) {
  // Newton's error is squared at every step: what follows a step this small is below rounding.
  constexpr double last_step = 0x1p-27;
  for (int round = 0; round < 64; ++round) {
    const Value value = evaluate(at);
    const double size = size_of(value.angle);
    if (size == 0) return at;
    ((size < 0) == rising ? low : high) = at;
    const double step = -size / value.slope;
    Phase next = scaled_to_unit({at.c - at.s * step, at.s + at.c * step});
    // Also false where the slope is 0.
    if (!(next.c > 0 && next.s > low.s && next.s < high.s)) {
      next = scaled_to_unit({low.c + high.c, low.s + high.s});
      if (!(next.s > low.s && next.s < high.s)) return at;
    } else if (std::fabs(step) < last_step) {
      return next;
    }
    at = next;
  }
  return at;
}

class Through {
 public:
  Through(const SphereEnds& ends, double ior)
      : gamma_{-ends.cosine, ends.sine},
        from2_(ends.from * ends.from),
        to2_(ends.to * ends.to),
        ior2_(ior * ior) {}

  [[nodiscard]] Impacts all() const {
    std::array<Phase, 4> ends{};
    std::size_t count = 0;
    ends[count++] = {1, 0};
    const Phase peak = steepest();
    if (slope(peak) > 0) {
      if (slope({1, 0}) < 0) ends[count++] = level_between({1, 0}, peak);
      ends[count++] = level_between(peak, {0, 1});
    }
    ends[count++] = {0, 1};
    Impacts out;
    for (std::size_t i = 0; i + 1 < count; ++i)
      add_roots(ends[i], ends[i + 1], i + 2 == count, out);
    return out;
  }

 private:
  struct Bent {
    Phase angle;
    double slope;
  };
  // The angle between the axis and the way from the centre to where the path leads.
  [[nodiscard]] Bent bent(const Phase& t) const {
    const double b2 = t.s * t.s;
    const Phase from = arc(b2, t.s, from2_);
    const Phase to = arc(b2, t.s, to2_);
    const Phase in = arc(b2, t.s, ior2_);
    const Phase turn = in * conj(t);
    return {from * to * (turn * turn), t.c * (1 / from.c + 1 / to.c + 2 / in.c) - 2};
  }
  [[nodiscard]] double slope(const Phase& t) const {
    const double b2 = t.s * t.s;
    return t.c *
               (1 / std::sqrt(from2_ - b2) + 1 / std::sqrt(to2_ - b2) + 2 / std::sqrt(ior2_ - b2)) -
           2;
  }
  // Of the second derivative, divided by b > 0 and scaled: falls as b grows.
  [[nodiscard]] double curvature(double b2) const {
    const auto share = [&](double d2) {
      const double x = (1 - b2) / (d2 - b2);
      return x * std::sqrt(x);
    };
    return share(from2_) + share(to2_) + 2 * share(ior2_) - 2;
  }
  // Where the angle grows fastest over b.
  [[nodiscard]] Phase steepest() const {
    if (!(curvature(0) > 0)) return {1, 0};
    double low = 0;
    double high = 1;
    for (int i = 0; i < 52; ++i) {
      const double middle = (low + high) / 2;
      (curvature(middle) > 0 ? low : high) = middle;
    }
    return {std::sqrt(1 - low), std::sqrt(low)};
  }
  // Where the slope, of different signs at both ends, is 0: the Illinois form of false position on
  // the squared impact.
  [[nodiscard]] Phase level_between(const Phase& low, const Phase& high) const {
    double x0 = square(low.s);
    double x1 = square(high.s);
    double y0 = slope(low);
    double y1 = slope(high);
    double x = x0;
    for (int round = 0; round < 60 && std::fabs(x1 - x0) > 0x1p-40; ++round) {
      const double next = x0 - y0 * (x1 - x0) / (y1 - y0);
      const bool settled = std::fabs(next - x) < 0x1p-40;
      x = next;
      const double y = slope({std::sqrt(larger(0, 1 - x)), std::sqrt(larger(0, x))});
      if (y == 0 || settled) break;
      if ((y > 0) == (y1 > 0)) {
        y0 /= 2;
      } else {
        x0 = x1;
        y0 = y1;
      }
      x1 = x;
      y1 = y;
    }
    return {std::sqrt(larger(0, 1 - x)), std::sqrt(larger(0, x))};
  }

  // The sign of the bent angle less the wanted one, on the wanted side of the axis.
  [[nodiscard]] bool is_beyond(const Phase& angle, bool same_side) const {
    if (same_side) return angle.s >= 0 && (angle * conj(gamma_)).s > 0;
    return angle.s >= 0 || (angle * gamma_).s > 0;
  }

  void add_roots(const Phase& low, const Phase& high, bool last, Impacts& out) const {
    const Phase at_low = bent(low).angle;
    const Phase at_high = bent(high).angle;
    for (const bool same_side : {true, false}) {
      const bool rising = is_beyond(at_high, same_side);
      if (rising == is_beyond(at_low, same_side)) continue;
      const Phase wanted = same_side ? conj(gamma_) : gamma_;
      const Phase start = last ? scaled_to_unit({low.c + 0.5 * high.c, low.s + 0.5 * high.s})
                               : scaled_to_unit({low.c + high.c, low.s + high.s});
      const Phase t = root_between(low, high, rising, start, [&](const Phase& at) {
        const Bent b = bent(at);
        return Value{b.angle * wanted, b.slope};
      });
      out.values[static_cast<std::size_t>(out.count++)] = same_side ? t.s : -t.s;
    }
  }

  Phase gamma_;
  double from2_, to2_, ior2_;
};

// Way from a point at `distance` to the sphere.
double leg(double distance, double b2, double cosine) {
  return (distance * distance - 1) / (std::sqrt(distance * distance - b2) + cosine);
}

}  // namespace

std::optional<double> mirrored_impact(const SphereEnds& ends) {
  const double from2 = ends.from * ends.from;
  const double to2 = ends.to * ends.to;
  const Phase wanted{ends.cosine, -ends.sine};
  // At a right angle of incidence the angle between the ends is the largest.
  const Phase most = Phase{-1, 0} * conj(arc(1, 1, from2)) * conj(arc(1, 1, to2)) * wanted;
  if (!(most.s > 0)) return std::nullopt;
  // As a flat mirror would do it.
  const Phase normal =
      scaled_to_unit({(ends.to - 1) + (ends.from - 1) * ends.cosine, (ends.from - 1) * ends.sine});
  const Phase start = scaled_to_unit({ends.from * normal.c - 1, ends.from * normal.s});
  const Phase first = start.c > 0 ? start : Phase{0.6, 0.8};
  return root_between({1, 0}, {0, 1}, true, first,
                      [&](const Phase& t) {
                        const double b2 = t.s * t.s;
                        const Phase from = arc(b2, t.s, from2);
                        const Phase to = arc(b2, t.s, to2);
                        return Value{t * t * conj(from) * conj(to) * wanted,
                                     2 - t.c * (1 / from.c + 1 / to.c)};
                      })
      .s;
}

Impacts impacts_through(const SphereEnds& ends, double ior) {
  return Through(ends, ior).all();
}

double mirrored_spread(double from, double to, double impact) {
  const double b2 = impact * impact;
  const double cosine = std::sqrt(1 - b2);
  const double t1 = leg(from, b2, cosine);
  const double t2 = leg(to, b2, cosine);
  const double bend = 2 * t1 * t2;
  return (t1 + t2 + bend / cosine) * (t1 + t2 + bend * cosine);
}

double spread_through(double from, double to, double impact, double ior) {
  const double b2 = impact * impact;
  const double cosine = std::sqrt(1 - b2);
  const double inner = std::sqrt(1 - b2 / (ior * ior));
  const double t1 = leg(from, b2, cosine);
  const double t3 = leg(to, b2, cosine);
  const double chord = 2 * inner;
  const double power = ior * inner - cosine;
  // In the plane of the path, then across it: width and growth of the beam.
  double width = t1 * inner / cosine;
  double growth = (cosine - power * t1 / cosine) / (ior * inner);
  width += chord * growth;
  growth = (ior * inner * growth - power * width / inner) / cosine;
  const double in_plane = width * cosine / inner + t3 * growth;
  width = t1;
  growth = (1 - power * t1) / ior;
  width += chord * growth;
  growth = ior * growth - power * width;
  return std::fabs(in_plane * (width + t3 * growth));
}

}  // namespace scenec::backend
