// What a fuzz target says before it aborts.
#pragma once

#include <string_view>

namespace scenec::fuzz {

// Prints `broken` and `detail` and aborts unless `holds`.
void require(bool holds, std::string_view broken, std::string_view detail = {});

}  // namespace scenec::fuzz
