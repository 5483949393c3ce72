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

SyntaxTree parse_sdl_part(FileId file, std::string_view text, TextPart part, DiagnosticSink& sink,
                          const ParseLimits& limits) {
  const RunRequest request{.dialect = Dialect::sdl,
                           .root = SyntaxKind::file,
                           .file = file,
                           .text = text.substr(0, part.end),
                           .begin = part.begin};
  if (part.begin == 0) return run_grammar<sdl::file>(request, sink, limits);
  return run_grammar<sdl::file_part>(request, sink, limits);
}

}  // namespace scenec::grammar
