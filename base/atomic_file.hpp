// Writing a file so that its name holds either the old bytes or the complete new ones: temporary
// file in the same directory, every write checked, fsync, rename, fsync of the directory.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace scenec {

// Checks, before any work is done, that `path` can be replaced: parent exists and is a writable
// directory, `path` itself is no directory, device or read-only file. Returns what is wrong.
[[nodiscard]] std::optional<std::string> find_output_problem(const std::string& path);
enum class Durability : std::uint8_t {
  immediate,  // the bytes survive a power cut
  eventual,   // without the two fsyncs: for what can be made again
};
// Returns what went wrong ("no space left on device"); nothing partial is left behind.
[[nodiscard]] std::optional<std::string> write_file_atomically(const std::string& path,
                                                               std::string_view bytes);
// The same with the bytes in pieces, one after the other.
[[nodiscard]] std::optional<std::string> write_file_atomically(
    const std::string& path, std::span<const std::string_view> pieces, Durability durability);

}  // namespace scenec
