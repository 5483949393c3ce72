// The files of the preview page, part of the program (runtime/watch/page).
#pragma once

#include <span>
#include <string_view>

namespace scenec::runtime {

struct PageFile {
  std::string_view path;  // "/page.js"; the page itself is "/"
  std::string_view type;
  std::string_view bytes;
};
[[nodiscard]] std::span<const PageFile> page_files();

}  // namespace scenec::runtime
