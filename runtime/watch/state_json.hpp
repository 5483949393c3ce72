// The state of a scene as pages and editors read it: one JSON object.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/watch/watched_scene.hpp"

namespace scenec::runtime {

struct WatchContext {
  std::vector<std::string> scenes;      // names of all
  std::vector<std::string> notices;     // about the daemon itself
  std::optional<double> broken_off_ms;  // what the last render took to end when it was asked to
};
[[nodiscard]] std::string state_json(const WatchedScene& scene, const Wishes& wishes,
                                     const WatchContext& context);

}  // namespace scenec::runtime
