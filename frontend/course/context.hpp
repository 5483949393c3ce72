// What every part of one translation shares: where mistakes go, which words were warned about and
// what the words said about the method.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "frontend/course/translate.hpp"
#include "frontend/course/words.hpp"

namespace scenec::frontend::course {

struct Context {
  const TranslateOptions& options;
  FileSystem& files;
  DiagnosticSink& sink;
  Vocabulary vocabulary = Vocabulary::base;  // the highest found
  std::set<std::pair<DiagnosticKind, std::string>> warned;

  void error(DiagnosticKind kind, Span where, std::string message) {
    sink.report(Diagnostic(kind, where, std::move(message)));
  }
  // One warning a file and word.
  void warn_once(DiagnosticKind kind, std::string_view word, Span where, std::string message) {
    if (warned.emplace(kind, word).second) error(kind, where, std::move(message));
  }
};

}  // namespace scenec::frontend::course
