// The libraries an author includes as `std:NAME`: files of declarations that are part of the
// program and read from nowhere.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scenec::frontend {

inline constexpr std::string_view library_prefix = "std:";
inline constexpr std::string_view library_extension = ".sdl";

struct LibraryFile {
  std::string_view name;  // "materials"
  std::string_view text;
};

// All of them, sorted by name. Generated from the folder stdlib-scenes.
[[nodiscard]] std::span<const LibraryFile> library_files();

// The text behind `std:materials.sdl`.
[[nodiscard]] std::optional<std::string_view> find_library(std::string_view path);
// `std:NAME` of every library.
[[nodiscard]] std::vector<std::string> library_names();

}  // namespace scenec::frontend
