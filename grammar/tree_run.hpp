// Runs a grammar over a text and hands out the tree, whatever happens on the way.
#pragma once

#include <tao/pegtl.hpp>

#include "base/assert.hpp"
#include "grammar/parse.hpp"
#include "grammar/tree_actions.hpp"

namespace scenec::grammar {

struct RunRequest {
  Dialect dialect;
  SyntaxKind root;
  FileId file;
  std::string_view text;
  std::uint32_t begin = 0;  // where reading begins; the text before it belongs to another tree
};

template <class Grammar, template <class...> class Control = peg::normal, class... States>
[[nodiscard]] SyntaxTree run_grammar(const RunRequest& request, DiagnosticSink& sink,
                                     const ParseLimits& limits, States&... states) {
  const std::string_view text =
      request.text.data() == nullptr ? std::string_view("") : request.text;
  TreeBuilder builder(request.dialect, request.file, text, request.begin, sink, limits);
  peg::memory_input<peg::tracking_mode::lazy, peg::eol::lf_crlf, const char*> in(
      text.data() + request.begin, text.size() - request.begin, "");
  try {
    builder.admit();
    const bool whole = peg::parse<Grammar, build, Control>(in, builder, states...);
    SCENEC_ASSERT(whole);
  } catch (const Abandon&) {
    builder.abandon();
    builder.node(request.root, 0);
  }
  return builder.finish(request.root);
}

}  // namespace scenec::grammar
