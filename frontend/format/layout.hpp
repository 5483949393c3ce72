// Decides which groups of a plan break and writes the text. A group stays on its line when all of
// it, and what is glued behind it, fits; blocks also have to be on one line in the source.
#pragma once

#include <string>

#include "frontend/format/plan.hpp"

namespace scenec::frontend::layout {

[[nodiscard]] std::string text_of(const Plan& plan);

}  // namespace scenec::frontend::layout
