// Our triangle kernel compiled with what a compiler does by itself when nobody forbids it: fused
// multiply-add (-mfma -ffp-contract=fast). A negative control: it must leak.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scenec::numerics {

// False on a processor without fused multiply-add.
[[nodiscard]] bool can_contract();
// Whether a ray meets any of the faces, with fused arithmetic. Coordinates as x, y, z in a row.
[[nodiscard]] bool contracted_hit(const double* positions, const std::uint32_t (*faces)[3],
                                  std::size_t face_count, const double* origin,
                                  const double* direction);

}  // namespace scenec::numerics
