#include "runtime/verbs.hpp"

#include <array>

#include "base/assert.hpp"
#include "runtime/options.hpp"

namespace scenec::runtime {

namespace {

constexpr std::array verb_table{
#define SCENEC_VERB(name, operands, summary) VerbInfo{Verb::name, #name, operands, summary},
#include "runtime/verbs.def"
#undef SCENEC_VERB
};

}  // namespace

std::span<const VerbInfo> all_verbs() {
  return verb_table;
}

const VerbInfo& info_of(Verb verb) {
  return verb_table[static_cast<std::size_t>(verb)];
}

ExitCode run_verb(const Options& options, const Environment& environment) {
  switch (options.verb) {
#define SCENEC_VERB(name, operands, summary) \
  case Verb::name:                           \
    return verbs::name(options, environment);
#include "runtime/verbs.def"
#undef SCENEC_VERB
  }
  SCENEC_ASSERT(false);
}

}  // namespace scenec::runtime
