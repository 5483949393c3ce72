// How a mistake is reported: with the way that leads to it, the author's steps first. Calls are
// listed from the mistake outwards, then the includes that brought its file in. What happens inside
// a library is shown at the author's call, its own steps folded into one note.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "frontend/lower/std_library.hpp"
#include "frontend/session.hpp"

namespace scenec::frontend {

namespace {
constexpr std::size_t max_call_notes = 8;
constexpr std::size_t max_include_notes = 8;
// Far more than are printed, far fewer than would take time.
constexpr std::size_t max_item_lints = 1000;

// What stands before the block: of `@allow(x) sphere ball { ... }` the words `sphere ball`.
Span head_in(std::string_view text, Span item) {
  std::size_t at = item.begin;
  const auto skip = [&](std::string_view characters) {
    const std::size_t next = text.find_first_not_of(characters, at);
    at = std::min<std::size_t>(next == text.npos ? item.end : next, item.end);
  };
  constexpr std::string_view blanks = " \t\r\n";
  while (at < item.end && text[at] == '@') {
    ++at;
    skip("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_");
    skip(blanks);
    if (at < item.end && text[at] == '(') {
      const std::size_t close = text.find(')', at);
      at = std::min<std::size_t>(close == text.npos ? item.end : close + 1, item.end);
    }
    skip(blanks);
  }
  std::size_t end = std::min<std::size_t>(text.find_first_of("{(", at), item.end);
  while (end > at && blanks.find(text[end - 1]) != blanks.npos) --end;
  if (end <= at) return item;
  return {item.file, static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(end)};
}

}  // namespace

bool Session::in_library(Span span) const {
  return span.valid() && sources.path(span.file).starts_with(library_prefix);
}

void Session::report(Diagnostic diagnostic) {
  if (muted_ > 0) return;
  add_trail(diagnostic);
  sink.report(std::move(diagnostic));
}

void Session::add_trail(Diagnostic& diagnostic) const {
  std::size_t inside_library = 0, shown = 0, further = 0;
  for (auto call = expansions_.rbegin(); call != expansions_.rend(); ++call) {
    if (in_library(call->span)) {
      ++inside_library;
    } else if (in_library(diagnostic.span)) {
      // The author cannot change the library; the call that leads there is theirs.
      const Span place = std::exchange(diagnostic.span, call->span);
      diagnostic.fixits.clear();
      diagnostic.notes.push_back({fmt::format("inside `{}` here", printable(call->name)), place});
    } else if (++shown > max_call_notes) {
      ++further;
    } else {
      const std::string_view step =
          call->kind == Callee::macro ? "expanded from macro" : "in the call of";
      diagnostic.notes.push_back(
          {fmt::format("{} `{}` here", step, printable(call->name)), call->span});
    }
  }
  if (further > 0)
    diagnostic.notes.push_back({fmt::format("and {} more calls further out", further), {}});
  if (inside_library > 0) {
    diagnostic.notes.push_back({fmt::format("{} call{} inside the library left out", inside_library,
                                            inside_library == 1 ? "" : "s"),
                                {}});
  }
  auto use =
      diagnostic.span.valid() ? includes_.find(diagnostic.span.file.value()) : includes_.end();
  for (std::size_t i = 0; use != includes_.end() && i < max_include_notes; ++i) {
    diagnostic.notes.push_back({"included from here", use->second});
    use = includes_.find(use->second.file.value());
  }
}

Span Session::head_of(ir::OriginId id) const {
  const ir::Scene& scene = builder.scene();
  while (in_library(scene.origins[id].span) && scene.origins[id].parent.valid())
    id = scene.origins[id].parent;
  const Span span = scene.origins[id].span;
  return head_in(sources.text(span.file), span);
}

void Session::lint_item(Diagnostic diagnostic, ir::OriginId id) {
  const auto allowed = allowed_at_.find(id.value());
  if (allowed != allowed_at_.end() && std::find(allowed->second.begin(), allowed->second.end(),
                                                diagnostic.kind) != allowed->second.end())
    return;
  if (++item_lints_ > max_item_lints) return;
  diagnostic.span = head_of(id);
  const ir::Scene& scene = builder.scene();
  std::size_t calls = 0;
  for (ir::OriginId up = scene.origins[id].parent; up.valid(); up = scene.origins[up].parent) {
    const Span call = head_in(sources.text(scene.origins[up].span.file), scene.origins[up].span);
    if (in_library(call) || call == diagnostic.span) continue;
    if (++calls > max_call_notes) break;
    diagnostic.notes.push_back({"expanded from here", call});
  }
  report(std::move(diagnostic));
}

}  // namespace scenec::frontend
