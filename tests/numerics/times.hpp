// What the three solvers of a surface of revolution cost: processor time a ray, as a Markdown
// table. Not part of the generated page: times are no bits.
#pragma once

#include <string>

namespace scenec::numerics {

[[nodiscard]] std::string solver_times();

}  // namespace scenec::numerics
