// Compiles small scenes from memory and evaluates single expressions, for the tests of the front
// end.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "base/render_diagnostic.hpp"
#include "frontend/compile.hpp"
#include "frontend/eval/evaluate.hpp"
#include "frontend/session.hpp"
#include "grammar/parse.hpp"
#include "ir/scene.hpp"

namespace scenec::frontend::test {

// The codes of all diagnostics in order, "E0201 E0230", and their text.
inline std::string codes_of(const DiagnosticSink& sink) {
  std::string codes;
  for (const Diagnostic& diagnostic : sink.sorted()) {
    if (!codes.empty()) codes += ' ';
    codes += info_of(diagnostic.kind).code;
  }
  return codes;
}
inline std::string messages_of(const DiagnosticSink& sink) {
  std::string text;
  for (const Diagnostic& diagnostic : sink.sorted()) text += diagnostic.message + '\n';
  return text;
}

struct Compiled {
  std::optional<ir::Scene> scene;
  std::string codes;
  std::string messages;
  std::string rendered;
};

struct Compiler {
  MemoryFileSystem files;
  CompileOptions options;

  Compiled operator()(const std::string& text) {
    files.put("scene.sdl", text);
    SourceMap sources;
    DiagnosticSink sink;
    Compiled result;
    result.scene = compile("scene.sdl", options, files, sources, sink);
    result.codes = codes_of(sink);
    result.messages = messages_of(sink);
    for (const Diagnostic& diagnostic : sink.sorted())
      result.rendered += render_terminal(diagnostic, sources, {});
    return result;
  }
};

inline Compiled compiled(const std::string& text) {
  return Compiler{}(text);
}

inline const std::string camera =
    "camera main: pinhole { eye = [0, 1, 5]; aim = [0, 1, 0]; fov = 40deg; }\n";
inline const std::string lit = "light: point { position = [0, 5, 0]; power = 100W; }\n";
// A scene around some items that has everything else.
inline std::string scene_with(const std::string& items) {
  return "sdl 1;\nmaterial grey: diffuse { color = gray(0.5); }\nsphere { center = [0, 0, -90]; material = grey; }\n" +
         items + "\n" + camera + lit;
}

struct Evaluated {
  Value value;
  std::string codes;
  std::string messages;
};
// The value of an expression behind optional declarations.
inline Evaluated evaluated(const std::string& expression) {
  MemoryFileSystem files;
  files.put("wood.png", "bytes");
  SourceMap sources;
  DiagnosticSink sink;
  const CompileOptions options;
  Session session(options, files, sources, sink);
  Evaluator evaluator(session);
  const FileId file = sources.add("test.sdl", "sdl 1;\nlet v = " + expression + ";\n");
  const grammar::SyntaxTree tree = grammar::parse_sdl(file, sources.text(file), sink);
  Scope scope;
  Evaluated result;
  const grammar::NodeRef let = tree.root().find_child(grammar::SyntaxKind::let);
  if (let) result.value = evaluator.evaluate(ast::expression_of(let), scope);
  result.codes = codes_of(sink);
  result.messages = messages_of(sink);
  return result;
}
inline double number_of(const std::string& expression) {
  const Evaluated result = evaluated(expression);
  return result.value.is_number() ? result.value.real() : std::nan("");
}

}  // namespace scenec::frontend::test
