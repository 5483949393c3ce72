// Writing a file so that its name holds either the old bytes or the complete new ones: temporary
// file in the same directory, every write checked, fsync, rename, fsync of the directory.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace scenec {

// Checks, before any work is done, that `path` can be replaced: parent exists and is a writable
// directory, `path` itself is no directory, device or read-only file. Returns what is wrong.
[[nodiscard]] std::optional<std::string> find_output_problem(const std::string& path);
// Returns what went wrong ("no space left on device"); nothing partial is left behind.
[[nodiscard]] std::optional<std::string> write_file_atomically(const std::string& path,
                                                               std::string_view bytes);

}  // namespace scenec
