// The files a course scene names: where they are looked for and how their paths are written.
#pragma once

#include <string>
#include <string_view>

#include "frontend/course/context.hpp"
#include "frontend/course/writer.hpp"

namespace scenec::frontend::course {

// Tries the working directory, the scene's directory and its parent. Where there is no such file
// that is reported, and the first of these stands for it: what names the file is read on with.
[[nodiscard]] std::string find_asset(Context& context, std::string_view name, Span where);
// The path as a string literal, relative to the output directory.
[[nodiscard]] Text path_text(const Context& context, const std::string& path, Span origin);

}  // namespace scenec::frontend::course
