// What `scenec stress` has found, as text and as JSON.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "backend/film/agreement.hpp"

namespace scenec::runtime {

// What one variant has come to.
struct StressOutcome {
  std::string_view name;  // of the variant
  std::string_view what;
  backend::Agreement agreement;
  double same = 0;  // share of the pixels
  bool agrees = true;
  struct Place {
    backend::Disagreement block;
    std::int64_t x = 0, y = 0;  // the pixel that is furthest off
    std::string name;           // of the item there
    std::string line;
  };
  std::vector<Place> places;
};

[[nodiscard]] std::string text_of(const StressOutcome& outcome);
[[nodiscard]] nlohmann::ordered_json json_of(const StressOutcome& outcome);

}  // namespace scenec::runtime
