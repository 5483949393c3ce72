#include "grammar/course.hpp"
#include "grammar/course_messages.hpp"
#include "grammar/parse.hpp"
#include "grammar/tree_run.hpp"

namespace scenec::grammar {

SyntaxTree parse_course(FileId file, std::string_view text, DiagnosticSink& sink,
                        const ParseLimits& limits) {
  return run_grammar<course::file>({Dialect::course, SyntaxKind::course_file, file, text}, sink,
                                   limits);
}

}  // namespace scenec::grammar
