// What the vertices of a mesh are kept in. Hits are decided in double either way; `mixed` lets
// vertices be floats where that is faithful (backend/accel/mesh_accel.hpp says when).
#pragma once

#include <cstdint>

namespace scenec::backend {

enum class Precision : std::uint8_t { mixed, full };

}  // namespace scenec::backend
