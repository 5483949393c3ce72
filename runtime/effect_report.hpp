// What `explain effects` and `dump --stage effects` print: every effect, whether the picture is
// simulated with it, what calls for it and where, or the proof that nothing does.
#pragma once

#include <string>

#include "base/source_map.hpp"
#include "ir/effects.hpp"

namespace scenec::runtime {

// For people: one effect a paragraph, those that are simulated first.
[[nodiscard]] std::string effects_text(const ir::Scene& scene, const ir::RenderSettings& settings,
                                       const ir::EffectReport& report, const SourceMap& sources);
// One line an effect in the order of `render.effects`, without places: the golden form.
[[nodiscard]] std::string effects_dump(const ir::EffectReport& report);
[[nodiscard]] std::string effects_json(const ir::Scene& scene, const ir::RenderSettings& settings,
                                       const ir::EffectReport& report, const SourceMap& sources);

}  // namespace scenec::runtime
