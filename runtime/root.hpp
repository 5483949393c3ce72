// The directory beneath which a scene's files lie: nothing outside it is read for the scene.
#pragma once

#include <string>

#include "runtime/options.hpp"

namespace scenec::runtime {

// What `--root` names; else the working directory when the scene lies beneath it, else the scene's
// own directory, of a course scene its parent. A scene lies beneath it when its folder does, by
// name and with links followed.
[[nodiscard]] std::string root_of(const Options& options, const std::string& scene_path);

}  // namespace scenec::runtime
