// The verbs and their entrances, both made from verbs.def.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "runtime/environment.hpp"
#include "runtime/exit_codes.hpp"

namespace scenec::runtime {

struct Options;

enum class Verb : std::uint8_t {
#define SCENEC_VERB(name, operands, summary) name,
#include "runtime/verbs.def"
#undef SCENEC_VERB
};

struct VerbInfo {
  Verb verb;
  std::string_view name;
  std::string_view operands;
  std::string_view summary;
};
[[nodiscard]] std::span<const VerbInfo> all_verbs();
[[nodiscard]] const VerbInfo& info_of(Verb verb);

namespace verbs {
#define SCENEC_VERB(name, operands, summary) \
  [[nodiscard]] ExitCode name(const Options& options, const Environment& environment);
#include "runtime/verbs.def"
#undef SCENEC_VERB
}  // namespace verbs

[[nodiscard]] ExitCode run_verb(const Options& options, const Environment& environment);

}  // namespace scenec::runtime
