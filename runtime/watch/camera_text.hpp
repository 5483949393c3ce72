// A camera as the author would write it: what "copy camera block" gives.
#pragma once

#include <string>

#include "ir/cameras.hpp"

namespace scenec::runtime {

[[nodiscard]] std::string camera_text(const ir::Camera& camera, const std::string& name);

}  // namespace scenec::runtime
