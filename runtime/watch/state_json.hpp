// The state of a scene as pages read it: one JSON object. And the list of all scenes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/watch/watched_scene.hpp"

namespace scenec::runtime {

struct WatchContext {
  std::vector<std::string> notices;     // about the daemon itself
  std::optional<double> broken_off_ms;  // what the last render took to end when it was asked to
};
// What an edit has changed, part by part.
[[nodiscard]] nlohmann::json changes_json(const std::vector<ir::PartChange>& changes);

struct ListedScene {
  std::size_t number = 0;
  std::string name;
};
[[nodiscard]] std::string list_json(const std::vector<ListedScene>& scenes,
                                    const std::vector<std::string>& notices);
[[nodiscard]] std::string state_json(const WatchedScene& scene, const Wishes& wishes,
                                     const WatchContext& context);

}  // namespace scenec::runtime
