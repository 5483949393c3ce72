#include "grammar/parse.hpp"
#include "grammar/sdl.hpp"
#include "grammar/sdl_actions.hpp"
#include "grammar/sdl_messages.hpp"
#include "grammar/tree_run.hpp"

namespace scenec::grammar {

SyntaxTree parse_sdl(FileId file, std::string_view text, DiagnosticSink& sink,
                     const ParseLimits& limits) {
  return run_grammar<sdl::file>({Dialect::sdl, SyntaxKind::file, file, text}, sink, limits);
}

}  // namespace scenec::grammar
