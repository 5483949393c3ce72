#include "backend/accel/target.hpp"

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

// What Highway's code for a target may use. The library of Highway knows it too, but measures a
// timer for several milliseconds before `main`, whoever links it; its headers are all we need.
std::vector<Target> available_targets() {
  std::vector<Target> targets{Target::baseline};
  const bool sse4 = __builtin_cpu_supports("ssse3") && __builtin_cpu_supports("sse4.1") &&
                    __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("pclmul") &&
                    __builtin_cpu_supports("aes");
  const bool avx2 = sse4 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
                    __builtin_cpu_supports("lzcnt") && __builtin_cpu_supports("f16c");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") &&
                      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd");
  if (sse4) targets.push_back(Target::sse4);
  if (avx2) targets.push_back(Target::avx2);
  if (avx512) targets.push_back(Target::avx512);
  return targets;
}

Target best_target() {
  return available_targets().back();
}

std::optional<Target> find_target(std::string_view name) {
  if (name == "auto") return best_target();
  for (const Target t : available_targets())
    if (name == name_of(t)) return t;
  return std::nullopt;
}

}  // namespace scenec::backend
