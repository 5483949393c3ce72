// Folders that are watched as a whole: which scenes lie in them now. A folder's listing is tracked
// like a file whose bytes are the names of its scenes; its path ends with a slash.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/file_system.hpp"

namespace scenec::runtime {

// The operands with each folder replaced by the scenes in it (`.sdl`, by name). What is no folder
// stays, whether it is there or not; nothing comes twice.
[[nodiscard]] std::vector<std::string> scenes_of(const std::vector<std::string>& operands);

[[nodiscard]] bool is_folder(const std::string& path);
[[nodiscard]] bool is_listing(std::string_view path);
// To be tracked: what the folder lists now.
[[nodiscard]] FileRecord listing_of(const std::string& folder);
// Whether a file of this name belongs to a listing.
[[nodiscard]] bool is_scene_name(std::string_view name);

}  // namespace scenec::runtime
