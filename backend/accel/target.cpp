#include "backend/accel/target.hpp"

#include <hwy/targets.h>
#include <algorithm>

namespace scenec::backend {

std::string_view name_of(Target target) {
  switch (target) {
    case Target::sse4:
      return "sse4";
    case Target::avx2:
      return "avx2";
    case Target::avx512:
      return "avx512";
    case Target::baseline:
      break;
  }
  return "baseline";
}

std::vector<Target> available_targets() {
  const auto supported = hwy::SupportedTargets();
  std::vector<Target> targets{Target::baseline};
  if ((supported & HWY_SSE4) != 0) targets.push_back(Target::sse4);
  if ((supported & HWY_AVX2) != 0) targets.push_back(Target::avx2);
  if ((supported & HWY_AVX3) != 0) targets.push_back(Target::avx512);
  return targets;
}

Target best_target() {
  return available_targets().back();
}

std::optional<Target> find_target(std::string_view name) {
  if (name == "best") return best_target();
  for (const Target t : {Target::baseline, Target::sse4, Target::avx2, Target::avx512})
    if (name == name_of(t)) return t;
  return std::nullopt;
}

}  // namespace scenec::backend
