// Course dialect to native: reads the generic course tree by the vocabulary of the course and its
// extensions and writes edition-1 source together with the range of course text each piece came
// from. All checking that is not about words, arities and counts is left to the native phases.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/file_system.hpp"
#include "base/limits.hpp"
#include "base/source_map.hpp"
#include "grammar/syntax_tree.hpp"
#include "ir/render_settings.hpp"

namespace scenec::frontend::course {

struct Translation {
  std::string text;                  // edition-1 source, canonical layout
  std::vector<DerivedRange> ranges;  // text -> course file; every item and value has one
};

struct TranslateOptions {
  std::string scene_path;            // of the course file, for resolving assets
  std::string output_directory;      // paths in the text are written relative to it
  std::optional<ir::Method> method;  // none: by vocabulary
  Limits limits = {};
};

// Words without a reading, wrong arities and counts are reported; the translation goes on with what
// it understood, so several mistakes show in one run.
[[nodiscard]] Translation translate(const grammar::SyntaxTree& course,
                                    const TranslateOptions& options, FileSystem& files,
                                    DiagnosticSink& sink);

// The table of words and readings as Markdown, generated into docs/course-dialect.md.
[[nodiscard]] std::string words_markdown();

}  // namespace scenec::frontend::course
