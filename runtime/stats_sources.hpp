// Where the figures of RunStats come from.
#pragma once

#include <cstdint>

#include "backend/memory_use.hpp"
#include "runtime/session.hpp"
#include "runtime/stats.hpp"

namespace scenec::runtime {

// Ends the phase `compile`. `before`: bytes that were allocated when it began; 0: memory is not
// asked for.
void finish_compiling(Session& session, std::uint64_t before, PhaseClock& clock, RunStats& stats);
// Bytes of the scene while it is rendered, of the film, and of the largest checkpoint.
void add_memory(const backend::MemoryUse& use, std::uint64_t film, std::uint64_t checkpoint,
                RunStats& stats);
void add_picture(const backend::Picture& picture, RunStats& stats);

}  // namespace scenec::runtime
