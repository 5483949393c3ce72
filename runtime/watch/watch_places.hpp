// Where to look for changes of a file: every directory entry its path leads through, symbolic links
// followed. Editors replace files by renaming others over them, links are turned round, directories
// are renamed; each of these is a change of one of these entries.
#pragma once

#include <compare>
#include <string>
#include <string_view>
#include <vector>

namespace scenec::runtime {

// One entry of a directory.
struct Place {
  std::string directory;  // absolute, without links
  std::string name;
  friend auto operator<=>(const Place&, const Place&) = default;
};

// In the order they are passed; the last one is the file itself, or the first entry that is
// missing. Empty when links lead in a circle at once. `path` may be relative to the working
// directory.
[[nodiscard]] std::vector<Place> places_of(std::string_view path);

}  // namespace scenec::runtime
