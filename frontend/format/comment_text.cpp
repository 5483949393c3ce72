#include "frontend/format/comment_text.hpp"

#include <algorithm>

namespace scenec::frontend::layout {

namespace {

void trim_line(std::string& text) {
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.pop_back();
}

}  // namespace

std::string comment_text(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n') continue;
    if (text[i] == '\n' || text[i] == '\r') {
      trim_line(out);
      out += '\n';
    } else {
      out += text[i];
    }
  }
  trim_line(out);
  return out;
}

std::string shifted_lines(std::string_view text, std::size_t from, std::size_t to) {
  std::string out;
  out.reserve(text.size());
  while (true) {
    const std::size_t line_end = text.find('\n');
    out += text.substr(0, line_end);
    if (line_end == std::string_view::npos) return out;
    out += '\n';
    text.remove_prefix(line_end + 1);
    if (text.empty() || text.front() == '\n') continue;
    const std::size_t blanks = std::min(text.find_first_not_of(" \t"), text.size());
    if (to < from) text.remove_prefix(std::min(blanks, from - to));
    if (to > from) out.append(to - from, ' ');
  }
}

}  // namespace scenec::frontend::layout
