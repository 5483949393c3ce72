// Text to lossless tree. Parsing never fails: broken text becomes error nodes and diagnostics, and
// every byte stays in the tree.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "base/diagnostic.hpp"
#include "grammar/syntax_tree.hpp"

namespace scenec::grammar {

enum class Dialect : std::uint8_t { sdl, course };

struct ParseLimits {
  std::uint32_t nesting = 256;        // blocks and brackets
  std::uint32_t token = 64u << 10;    // bytes of one token other than a string or comment
  std::uint32_t string = 1u << 20;    // bytes of one string
  std::uint64_t line = 16u << 20;     // bytes of one line: bounds time and memory of dense text
  std::uint64_t file = 512ull << 20;  // bytes of one file
};

// Both run in time linear in the text and in stack space bounded by the nesting limit. A limit hit
// is one error; what follows it is one error node.
[[nodiscard]] SyntaxTree parse_sdl(FileId file, std::string_view text, DiagnosticSink& sink,
                                   const ParseLimits& limits = {});
[[nodiscard]] SyntaxTree parse_course(FileId file, std::string_view text, DiagnosticSink& sink,
                                      const ParseLimits& limits = {});

// [begin, end) of a text that was cut between top-level items (split.hpp).
struct TextPart {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};
// One part as a tree of its own, with the places of the whole text. When no part of a text reports
// anything, their items are, one after the other, those of the whole; else only the whole text can
// tell what is wrong with it.
[[nodiscard]] SyntaxTree parse_sdl_part(FileId file, std::string_view text, TextPart part,
                                        DiagnosticSink& sink, const ParseLimits& limits = {});

// A `.sdl` extension or a first statement `sdl N;` says native; all else is course.
[[nodiscard]] Dialect dialect_of(std::string_view path, std::string_view text);

}  // namespace scenec::grammar
