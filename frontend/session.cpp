#include "frontend/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/hash.hpp"
#include "base/limits.hpp"
#include "base/text.hpp"

namespace scenec::frontend {

Session::Session(const CompileOptions& compile_options, FileSystem& file_system,
                 SourceMap& source_map, DiagnosticSink& diagnostic_sink)
    : options(compile_options), files(file_system), sources(source_map), sink(diagnostic_sink) {}

Value Session::error(DiagnosticKind kind, Span span, std::string message) {
  report(Diagnostic(kind, span, std::move(message)));
  return {};
}

Value Session::error(Diagnostic diagnostic) {
  report(std::move(diagnostic));
  return {};
}

bool Session::is_allowed(DiagnosticKind kind) const {
  return std::find(allowed_.begin(), allowed_.end(), kind) != allowed_.end();
}

void Session::lint(Diagnostic diagnostic) {
  if (!is_allowed(diagnostic.kind)) report(std::move(diagnostic));
}

Session::Expanding::Expanding(Session& owner, Callee kind, std::string_view name, Span span)
    : session(owner), before(owner.expansion_origin_) {
  if (!session.checking_only()) {
    session.expansion_origin_ =
        session.shared_origin({span, before, ir::OriginKind::expanded_from});
  }
  session.expansions_.push_back({kind, name, span});
}

Session::Expanding::~Expanding() {
  session.expansions_.pop_back();
  session.expansion_origin_ = before;
}

ir::OriginId Session::add_origin(Span span) {
  const auto kind =
      expansion_origin_.valid() ? ir::OriginKind::expanded_from : ir::OriginKind::written;
  const ir::OriginId origin = shared_origin({span, expansion_origin_, kind});
  if (!allowed_.empty()) allowed_at_.try_emplace(origin.value(), allowed_);
  return origin;
}

ir::OriginId Session::shared_origin(const ir::Origin& origin) {
  RecentOrigin& recent = recent_origins_[(origin.span.begin ^ origin.parent.value()) & 63u];
  const ir::Origin& other = recent.origin;
  const bool same = recent.id.valid() && other.span == origin.span &&
                    other.parent == origin.parent && other.kind == origin.kind;
  if (!same) recent = {origin, builder.add_origin(origin)};
  return recent.id;
}

namespace {
// Exact as far as anyone reads digits.
std::string count_text(std::uint64_t count) {
  constexpr std::uint64_t readable = 1'000'000'000'000;
  return count > readable ? fmt::format("{:.1e}", static_cast<double>(count))
                          : std::to_string(count);
}
}  // namespace

bool Session::exhausted(Span where) {
  if (!std::exchange(exhaustion_reported_, true)) {
    error(Diagnostic(
              DiagnosticKind::too_many_steps, where,
              fmt::format("evaluating the scene takes more than {} steps", options.limits.steps))
              .hint(sets_the_limit(limit_option::steps)));
  }
  return false;
}

bool Session::affords(std::uint64_t items, std::uint64_t steps, Span where) {
  const std::uint64_t items_left = options.limits.items - std::min(items_, options.limits.items);
  if (items > items_left) {
    items_ = options.limits.items + 2;  // as if they had been placed
    error(Diagnostic(DiagnosticKind::too_many_items, where,
                     fmt::format("this places at least {} items; the scene may place {}",
                                 count_text(items), options.limits.items))
              .hint(sets_the_limit(limit_option::items)));
    return false;
  }
  if (steps <= options.limits.steps - std::min(steps_, options.limits.steps)) return true;
  steps_ = options.limits.steps + 1;
  return exhausted(where);
}

bool Session::deep_enough(std::size_t calls, Span where) {
  if (calls < max_call_depth && !stack_.nearly_full()) return true;
  error(Diagnostic(DiagnosticKind::calls_too_deep, where,
                   calls < max_call_depth
                       ? std::string("calls and blocks are nested too deeply for the stack")
                       : fmt::format("calls are nested deeper than {}", max_call_depth)));
  return false;
}

bool Session::count_item(Span where) {
  if (++items_ <= options.limits.items) return true;
  if (items_ == options.limits.items + 1) {
    error(Diagnostic(DiagnosticKind::too_many_items, where,
                     fmt::format("the scene places more than {} items", options.limits.items))
              .hint(sets_the_limit(limit_option::items)));
  }
  return false;
}

std::string Session::resolved_path(std::string_view path, FileId file) const {
  return joined_path(directory_of(sources.path(sources.resolve({file, 0, 0}).file)), path);
}

void Session::unreadable(const std::string& path, FileError reason, Span span) {
  // The course translation may have said it already, with the places it tried.
  const std::vector<Diagnostic> said = sink.sorted();
  const auto is_same = [&](const Diagnostic& diagnostic) {
    return diagnostic.kind == DiagnosticKind::course_missing_file &&
           diagnostic.span == sources.resolve(span);
  };
  if (std::any_of(said.begin(), said.end(), is_same)) return;
  const bool outside = reason == FileError::outside_root;
  error(outside ? DiagnosticKind::file_outside_root : DiagnosticKind::file_unreadable, span,
        fmt::format("cannot read {}: {}{}", quoted_string(path), outside ? "it " : "",
                    files.reason_of(reason)));
}

ir::AssetId Session::asset(std::string_view path, FileId file, Span span) {
  const std::string resolved = resolved_path(path, file);
  const auto [place, added] = assets_.try_emplace(resolved);
  if (!added && place->second.valid()) return place->second;
  auto content = files.read(resolved, max_asset_bytes);
  if (!content) {
    unreadable(resolved, content.error(), span);
    return {};
  }
  place->second = builder.add_asset({resolved, hash_bytes(content.value().bytes), span});
  return place->second;
}

Diagnostic unknown_word(DiagnosticKind kind, Span span, std::string message, std::string_view word,
                        std::span<const std::string_view> legal, std::string_view legal_title) {
  Diagnostic diagnostic(kind, span, std::move(message));
  if (const auto nearest = nearest_name(word, legal)) {
    diagnostic.hints.push_back(fmt::format("did you mean `{}`?", *nearest));
  }
  if (!legal.empty())
    diagnostic.hints.push_back(fmt::format("{}: {}", legal_title, quoted_list(legal)));
  return diagnostic;
}

}  // namespace scenec::frontend
