// `--params FILE.json`: values of a scene's params from a file, for scenes that programs set.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/file_system.hpp"
#include "base/source_map.hpp"
#include "frontend/compile.hpp"

namespace scenec::runtime {

// The entries of the JSON object in `path`, in order; nullopt (reported in the JSON text) when it
// is not one object of numbers, strings, truth values and arrays of those, each name once.
[[nodiscard]] std::optional<std::vector<frontend::ParamSetting>> read_params_file(
    const std::string& path, FileSystem& files, SourceMap& sources, DiagnosticSink& sink);

}  // namespace scenec::runtime
