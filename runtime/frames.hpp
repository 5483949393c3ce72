// `--frames a..b`: one picture for every frame, each compiled on its own with the scene's clock set
// to that frame's time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/option_values.hpp"

namespace scenec::runtime {

struct Options;

struct FrameRange {
  std::int64_t first = 0;
  std::int64_t last = 0;
};
inline constexpr std::int64_t default_frame_rate = 24;
inline constexpr std::int64_t largest_frame_rate = 100'000;

// `a..b`, whole numbers, a <= b, at most 100000 frames.
[[nodiscard]] Parsed<FrameRange> parse_frames(std::string_view text);
// The last run of `#` in the file's name becomes the number in at least so many digits; without one
// four digits come before the extension: `out.0001.png`.
[[nodiscard]] std::string path_in_frame(const std::string& path, std::int64_t frame);
// The options of one frame: every file that is written carries the frame's number, but for a
// dependency file that all frames share.
[[nodiscard]] Options options_in_frame(const Options& options, std::int64_t frame);
// Whether `-MF` names one file for all frames: a name without `#`, as build tools expect it.
[[nodiscard]] bool share_dependencies(const Options& options);
// What the frame options lack or contradict.
[[nodiscard]] std::optional<std::string> find_frame_problem(const Options& options);

}  // namespace scenec::runtime
