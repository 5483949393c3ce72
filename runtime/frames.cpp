#include "runtime/frames.hpp"

#include <fmt/format.h>

#include "runtime/options.hpp"

namespace scenec::runtime {

namespace {

constexpr std::int64_t largest_frame = 999'999'999;
constexpr std::int64_t largest_frame_count = 100'000;

}  // namespace

Parsed<FrameRange> parse_frames(std::string_view text) {
  const std::string expected =
      fmt::format("`a..b`, whole numbers from 0 to {}, a <= b, at most {} frames", largest_frame,
                  largest_frame_count);
  const std::size_t dots = text.find("..");
  if (dots == std::string_view::npos) return Failure{expected};
  const auto first = parse_whole_number(text.substr(0, dots), 0, largest_frame);
  const auto last = parse_whole_number(text.substr(dots + 2), 0, largest_frame);
  if (!first || !last || first.value() > last.value() ||
      last.value() - first.value() >= largest_frame_count)
    return Failure{expected};
  return FrameRange{first.value(), last.value()};
}

std::string path_in_frame(const std::string& path, std::int64_t frame) {
  const std::size_t slash = path.rfind('/');
  const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
  const std::size_t mark = path.rfind('#');
  if (mark != std::string::npos && mark >= name) {
    std::size_t begin = mark;
    while (begin > name && path[begin - 1] == '#') --begin;
    const std::size_t digits = mark + 1 - begin;
    return path.substr(0, begin) + fmt::format("{:0{}}", frame, digits) + path.substr(mark + 1);
  }
  const std::size_t dot = path.rfind('.');
  const bool has_extension = dot != std::string::npos && dot > name;
  const std::size_t end = has_extension ? dot : path.size();
  return path.substr(0, end) + fmt::format(".{:04}", frame) + path.substr(end);
}

Options options_in_frame(const Options& options, std::int64_t frame) {
  Options result = options;
  result.frame = frame;
  result.output = path_in_frame(output_of(options), frame);
  if (!result.stats_file.empty()) result.stats_file = path_in_frame(result.stats_file, frame);
  if (!result.checkpoint.empty() && result.checkpoint != "off") {
    result.checkpoint = path_in_frame(result.checkpoint, frame);
  }
  if (!result.dependency_file.empty() && !share_dependencies(options)) {
    result.dependency_file = path_in_frame(result.dependency_file, frame);
  }
  return result;
}

bool share_dependencies(const Options& options) {
  const std::string& path = options.dependency_file;
  return options.frames && !path.empty() && path.find('#', path.rfind('/') + 1) == path.npos;
}

std::optional<std::string> find_frame_problem(const Options& options) {
  if (options.frame_rate && !options.frames) return "`--fps` goes with `--frames`";
  if (options.frames && options.diagnostics == DiagnosticsForm::sarif) {
    return "a SARIF log is of one picture; with `--frames` use `--diagnostics json`";
  }
  return std::nullopt;
}

}  // namespace scenec::runtime
