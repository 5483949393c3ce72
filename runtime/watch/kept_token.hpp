// The key to the page, kept while the author is logged in: a page that is still open when the
// daemon is started again on its port finds it again by itself.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/environment.hpp"

namespace scenec::runtime {

// Kept in XDG_RUNTIME_DIR, which is the author's alone, in a file that only he can read; a new one
// where there is no such place or what lies there is not of that kind.
[[nodiscard]] std::string kept_token(const Environment& environment, std::uint16_t port);

}  // namespace scenec::runtime
