// Error against time of one render, with the times to round errors read or predicted from it.
#pragma once

#include "runtime/study/variant.hpp"

namespace scenec::runtime {

// Renders as long as `goes_on` and adds the curve, the levels and the picture to the document;
// nothing when it was stopped.
void measure_curve(const Variant& base, const std::function<bool()>& goes_on, const StudyPlan& plan,
                   ThreadPool& pool, Json& document);

}  // namespace scenec::runtime
