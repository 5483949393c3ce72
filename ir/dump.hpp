// The IR as edition-1 source in canonical order and form: SI numbers in their shortest exact form,
// one item a line start, no params, lets, macros, loops or includes. Compiling it gives the same
// content hash. This is the golden form.
#pragma once

#include <string>
#include <string_view>

#include "ir/scene.hpp"

namespace scenec::ir {

struct DumpOptions {
  std::string directory;  // paths are written relative to it; "" is the working directory
};
[[nodiscard]] std::string dump_text(const Scene& scene, const DumpOptions& options);

}  // namespace scenec::ir
