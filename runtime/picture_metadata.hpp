// What is written into the file of a picture beside its pixels.
#pragma once

#include "backend/backend.hpp"
#include "runtime/options.hpp"

namespace scenec::runtime {

// No time, host, thread count or path unless `--stamp` asks: the same picture is the same bytes.
[[nodiscard]] backend::EncodeOptions encode_options(const Options& options, const ir::Scene& scene,
                                                    const ir::RenderSettings& settings,
                                                    const ir::EffectSet& effects,
                                                    const backend::Picture& picture,
                                                    unsigned threads,
                                                    const backend::ErrorEstimate& error = {});

// Names of effects with blanks between them.
[[nodiscard]] std::string names_of(const ir::EffectSet& effects);

}  // namespace scenec::runtime
