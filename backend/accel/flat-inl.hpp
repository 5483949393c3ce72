// One ray against the four shapes of a block, compiled once for each instruction set: include only
// from files that Highway re-includes. The contract is that of flat_items.hpp.
#if defined(SCENEC_FLAT_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SCENEC_FLAT_INL
#undef SCENEC_FLAT_INL
#else
#define SCENEC_FLAT_INL
#endif

#include <hwy/highway.h>
#include "backend/accel/flat_items.hpp"
#include "backend/accel/traverse-inl.hpp"
#include "backend/geometry/triangle.hpp"

HWY_BEFORE_NAMESPACE();
namespace scenec::backend {
namespace HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace hn = hwy::HWY_NAMESPACE;

struct Doubles3 {
  Doubles x, y, z;
};

class FlatTest {
 public:
  HWY_INLINE explicit FlatTest(const Ray& ray)
      : origin_{set(ray.origin.x), set(ray.origin.y), set(ray.origin.z)},
        direction_{set(ray.direction.x), set(ray.direction.y), set(ray.direction.z)},
        t_min_(set(ray.t_min)) {}

  // Bits of the shapes that are hit up to `limit`, and where.
  HWY_INLINE std::uint32_t operator()(const FlatPlanes& b, std::size_t at, double limit,
                                      double* ts) const {
    const Doubles3 n = load(b.normal, at);
    const Doubles slope = dot(n, direction_);
    const Doubles t = hn::Div(hn::Sub(load(b.offset, at), dot(n, origin_)), slope);
    return within(t, limit, hn::Ne(slope, zero()), ts);
  }

  HWY_INLINE std::uint32_t operator()(const FlatDisks& b, std::size_t at, double limit,
                                      double* ts) const {
    const Doubles3 n = load(b.normal, at);
    const Doubles3 from = sub(origin_, load(b.center, at));
    const Doubles slope = dot(n, direction_);
    const Doubles t = hn::Div(hn::Neg(dot(n, from)), slope);
    const Doubles3 p = add(from, scale(direction_, t));
    const Doubles r = load(b.radius, at);
    const auto inside = hn::And(hn::Ne(slope, zero()), hn::Le(dot(p, p), hn::Mul(r, r)));
    return within(t, limit, inside, ts);
  }

  HWY_INLINE std::uint32_t operator()(const FlatSpheres& b, std::size_t at, double limit,
                                      double* ts) const {
    const Doubles3 from = sub(origin_, load(b.center, at));
    const Doubles radius = load(b.radius, at);
    const Doubles a_ = dot(direction_, direction_);
    const Doubles b_ = hn::Neg(dot(from, direction_));
    const Doubles r2 = hn::Mul(radius, radius);
    const Doubles c_ = hn::Sub(dot(from, from), r2);
    const Doubles b2 = hn::Mul(b_, b_);
    const auto near = hn::Le(hn::Add(b2, hn::Mul(a_, hn::Abs(c_))), hn::Mul(a_, r2));
    const Doubles3 nearest = add(from, scale(direction_, hn::Div(b_, a_)));
    const Doubles h = hn::Sqrt(dot(nearest, nearest));
    const Doubles far_discriminant = hn::Mul(a_, hn::Mul(hn::Sub(radius, h), hn::Add(radius, h)));
    const Doubles near_discriminant = hn::Sub(b2, hn::Mul(a_, c_));
    const Doubles discriminant = hn::IfThenElse(near, near_discriminant, far_discriminant);
    const auto real = hn::Ge(discriminant, zero());
    if (hn::AllFalse(DoubleTag(), real)) return 0;
    const Doubles root = hn::Sqrt(discriminant);
    const Doubles q = hn::IfThenElse(hn::Lt(b_, zero()), hn::Sub(b_, root), hn::Add(b_, root));
    const Doubles first = hn::IfThenElse(hn::Ne(q, zero()), hn::Div(c_, q), zero());
    const Doubles second = hn::Div(q, a_);
    const auto ordered = hn::Le(first, second);
    const Doubles low = hn::IfThenElse(ordered, first, second);
    const Doubles high = hn::IfThenElse(ordered, second, first);
    const Doubles most = set(limit);
    const auto low_in = hn::And(hn::Ge(low, t_min_), hn::Le(low, most));
    return within(hn::IfThenElse(low_in, low, high), limit, real, ts);
  }

  HWY_INLINE std::uint32_t operator()(const FlatQuads& b, std::size_t at, double limit,
                                      double* ts) const {
    const Doubles3 n = load(b.normal, at);
    const Doubles3 corner = load(b.corner[0], at);
    const Doubles slope = dot(n, direction_);
    const Doubles t = hn::Div(dot(n, sub(corner, origin_)), slope);
    const Sheared p0 = sheared(b.corner[0], at);
    const Sheared p1 = sheared(b.corner[1], at);
    const Sheared p2 = sheared(b.corner[2], at);
    const Sheared p3 = sheared(b.corner[3], at);
    const Doubles ab = edge(p0, p1);
    const Doubles bc = edge(p1, p2);
    const Doubles cd = edge(p2, p3);
    const Doubles da = edge(p3, p0);
    const Doubles low = hn::Min(hn::Min(ab, bc), hn::Min(cd, da));
    const Doubles high = hn::Max(hn::Max(ab, bc), hn::Max(cd, da));
    const auto one_side = hn::Or(hn::Ge(low, zero()), hn::Le(high, zero()));
    const auto whole = hn::And(hn::Ne(hn::Add(da, bc), zero()), hn::Ne(hn::Add(ab, cd), zero()));
    return within(t, limit, hn::And(hn::And(one_side, whole), hn::Ne(slope, zero())), ts);
  }

  // Before quads are asked: the shear of triangle.hpp.
  HWY_INLINE void prepare_quads(const Ray& ray) {
    const RayShear shear(ray);
    kx_ = static_cast<std::size_t>(shear.kx);
    ky_ = static_cast<std::size_t>(shear.ky);
    kz_ = static_cast<std::size_t>(shear.kz);
    const double o[3] = {ray.origin.x, ray.origin.y, ray.origin.z};
    ox_ = set(o[kx_]);
    oy_ = set(o[ky_]);
    oz_ = set(o[kz_]);
    sx_ = set(shear.sx);
    sy_ = set(shear.sy);
  }

 private:
  struct Sheared {
    Doubles x, y;
  };

  static HWY_INLINE Doubles set(double v) { return hn::Set(DoubleTag(), v); }
  static HWY_INLINE Doubles zero() { return hn::Zero(DoubleTag()); }
  static HWY_INLINE Doubles load(const FlatLane& lane, std::size_t at) {
    return hn::LoadU(DoubleTag(), lane.data() + at);
  }
  static HWY_INLINE Doubles3 load(const FlatPoint& p, std::size_t at) {
    return {load(p[0], at), load(p[1], at), load(p[2], at)};
  }
  static HWY_INLINE Doubles3 sub(const Doubles3& a, const Doubles3& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
  }
  static HWY_INLINE Doubles3 add(const Doubles3& a, const Doubles3& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
  }
  static HWY_INLINE Doubles3 scale(const Doubles3& a, const Doubles& s) {
    return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
  }
  static HWY_INLINE Doubles dot(const Doubles3& a, const Doubles3& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
  }
  HWY_INLINE Sheared sheared(const FlatPoint& p, std::size_t at) const {
    const Doubles z = hn::Sub(load(p[kz_], at), oz_);
    return {hn::Sub(hn::Sub(load(p[kx_], at), ox_), hn::Mul(sx_, z)),
            hn::Sub(hn::Sub(load(p[ky_], at), oy_), hn::Mul(sy_, z))};
  }
  static HWY_INLINE Doubles edge(const Sheared& a, const Sheared& b) {
    return hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x));
  }
  template <class M>
  HWY_INLINE std::uint32_t within(const Doubles& t, double limit, const M& hit, double* ts) const {
    const DoubleTag d;
    const double most =
        limit < std::numeric_limits<double>::max() ? limit : std::numeric_limits<double>::max();
    const auto in = hn::And(hn::And(hn::Ge(t, t_min_), hn::Le(t, set(most))), hit);
    const std::uint32_t bits = bits_of(d, in);
    if (bits != 0) hn::StoreU(t, d, ts);
    return bits;
  }

  Doubles3 origin_;
  Doubles3 direction_;
  Doubles t_min_;
  Doubles ox_ = zero(), oy_ = zero(), oz_ = zero(), sx_ = zero(), sy_ = zero();
  std::size_t kx_ = 0, ky_ = 1, kz_ = 2;
};

}  // namespace HWY_NAMESPACE
}  // namespace scenec::backend
HWY_AFTER_NAMESPACE();

#endif
