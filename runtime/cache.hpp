// Where what was decoded is kept between runs: `--cache`, else SCENEC_CACHE, else `scenec` in
// XDG_CACHE_HOME or in ~/.cache. `off`, or no place at all, keeps nothing.
#pragma once

#include <optional>

#include "base/content_cache.hpp"
#include "runtime/environment.hpp"
#include "runtime/options.hpp"

namespace scenec::runtime {

[[nodiscard]] std::optional<ContentCacheOptions> cache_options_of(const Options& options,
                                                                  const Environment& environment);

}  // namespace scenec::runtime
