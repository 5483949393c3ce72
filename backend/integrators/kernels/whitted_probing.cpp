#include "backend/integrators/tile-inl.hpp"

namespace scenec::backend {

template bool render_tile<ir::Method::whitted, kernel_masks::whitted_probing>(
    const TileJob&, Film&, const Tile&, const SampleRange&, KernelWorker&, const std::stop_token&);

}  // namespace scenec::backend
