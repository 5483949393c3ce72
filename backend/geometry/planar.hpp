// What flat shapes with corners share.
#pragma once

#include "backend/math/vec.hpp"

namespace scenec::backend {

// How well a second ray from a point of a triangle knows which side it is on: the edge functions
// give six times the volume spanned by the corners A, B, C seen from the point to
// gamma(24) |A||B||C|, that is a height of as much over twice the area. No corner is farther than
// the longest side, which also keeps the bound above 0 at the corners. Large only for slivers.
[[nodiscard]] inline Vector3 planar_self_error(const Vector3& normal, double longest_side) {
  const double twice_area = length(normal);
  if (!(twice_area > 0)) return {};
  // Two factors against the area first, so that nothing over- or underflows for ordinary sizes.
  const double height = gamma(24) * (longest_side * longest_side / twice_area) * longest_side;
  return (height / twice_area) * abs(normal);
}

}  // namespace scenec::backend
