// The render settings of a scene with the command line's changes.
#pragma once

#include <optional>

#include "ir/scene.hpp"
#include "runtime/environment.hpp"
#include "runtime/options.hpp"

namespace scenec::runtime {

// Nothing, after a line on the error stream, when the changes do not fit the scene.
[[nodiscard]] std::optional<ir::RenderSettings> settings_of(const Options& options,
                                                            const ir::Scene& scene,
                                                            const Environment& environment);

// At most 20,000 pixels of the same shape: for what renders a picture many times over. A smaller
// picture has the same error at the same samples; so many pixels tell it well.
[[nodiscard]] ir::ImageSize small_size(ir::ImageSize size);

}  // namespace scenec::runtime
