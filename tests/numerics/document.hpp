// docs/numerics.md out of the findings of a run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace scenec::numerics {

// Whether the generated part of the page and its plots say what the tests of this run found; with
// SCENEC_UPDATE_DOCS set they are written anew. Complaints are appended.
[[nodiscard]] bool document_agrees(const std::filesystem::path& docs,
                                   std::vector<std::string>& complaints);

}  // namespace scenec::numerics
