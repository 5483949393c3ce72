// The instruction sets the traversal is compiled for. All of them give the same bits: the choice is
// a matter of speed and of tests.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace scenec::backend {

enum class Target : std::uint8_t { baseline, sse4, avx2, avx512 };

// As written on the command line.
[[nodiscard]] std::string_view name_of(Target target);
// What this machine can run, slowest first; never empty.
[[nodiscard]] std::vector<Target> available_targets();
[[nodiscard]] Target best_target();
// By name; `auto` is the best one. Empty: no such name, or not on this machine.
[[nodiscard]] std::optional<Target> find_target(std::string_view name);

}  // namespace scenec::backend
