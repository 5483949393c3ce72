// The `@clock` param: a scene's only way to know the time, set for every frame of a sequence.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "frontend/lower/lowering_access.hpp"

namespace scenec::frontend {

using grammar::NodeRef;
using grammar::SyntaxKind;

namespace {

bool is_clock(NodeRef node) {
  const auto children = node.children();
  return std::any_of(children.begin(), children.end(), [](NodeRef child) {
    if (!child.is(SyntaxKind::annotation)) return false;
    const NodeRef name = child.find_child(SyntaxKind::name);
    return name && name.text() == "clock";
  });
}

// What the range of a clock allows, in seconds.
struct ClockRange {
  double low = 0;
  double high = 0;
  bool closed = true;

  [[nodiscard]] double time_of(std::int64_t frame, std::int64_t per_second) const {
    return low + static_cast<double>(frame) / static_cast<double>(per_second);
  }
  // A frame that meets the high end in exact arithmetic may come out a little beyond it: the
  // quotient, the sum and the two ends are each rounded by at most half a unit in the last place of
  // the largest magnitude among them.
  [[nodiscard]] bool holds(double time) const {
    if (!closed) return time < high;
    const double largest = std::max(std::abs(low), std::abs(high));
    const double next = std::nextafter(largest, std::numeric_limits<double>::infinity());
    return time <= high + 2 * (next - largest);
  }
};

Diagnostic frame_beyond(const ClockRange& range, const Frame& frame, std::string_view clock,
                        Span high_end) {
  const double time = range.time_of(frame.last, frame.per_second);
  Diagnostic diagnostic(DiagnosticKind::clock_frames, high_end,
                        fmt::format("frame {} sets `{}` to {}; the clock ends at {}", frame.last,
                                    clock, quantity_text(time, dimension::time),
                                    quantity_text(range.high, dimension::time)));
  // Below frame.last, so it fits into the integer; the rounded guess is off by one at most.
  const double guess = (range.high - range.low) * static_cast<double>(frame.per_second);
  std::int64_t fitting = static_cast<std::int64_t>(guess) + 1;
  while (fitting >= 0 && !range.holds(range.time_of(fitting, frame.per_second))) --fitting;
  if (fitting < 0) return diagnostic;
  return std::move(diagnostic)
      .hint(fmt::format("the last frame at {} frames a second is {}", frame.per_second, fitting));
}

}  // namespace

// The value of a clock that is set by a frame; poison (reported) when the frame does not fit.
Value Lowering::clock_in_frame(const ast::Item& parts, const Frame& frame, Scope& scope) {
  const ast::Range ends = ast::range_of(parts.range);
  if (!ends.low || !ends.high) return {};
  const auto seconds = [&](NodeRef end) {
    const Need need{.subject = parts.name.text(), .function = {}, .node = end};
    return coerce_quantity(session_, evaluator_.evaluate(end, scope), dimension::time, need);
  };
  const Value low = seconds(ends.low);
  const Value high = seconds(ends.high);
  if (low.poisoned() || high.poisoned()) return {};
  const ClockRange range{low.real(), high.real(), ends.closed};
  if (!range.holds(range.time_of(frame.last, frame.per_second)))
    return session_.error(frame_beyond(range, frame, parts.name.text(), ends.high.span()));
  const double time = range.time_of(frame.number, frame.per_second);
  return make_number(range.closed ? std::min(time, range.high) : time, dimension::time);
}

std::optional<Value> Lowering::clock_setting(NodeRef node, Scope& scope) {
  if (!is_clock(node)) return std::nullopt;
  const ast::Item parts = ast::item_of(node);
  if (clock_.valid()) {
    return session_.error(Diagnostic(DiagnosticKind::several_clocks, parts.name.span(),
                                     fmt::format("`{}` is a second clock", parts.name.text()))
                              .note("the first one is declared here", clock_));
  }
  clock_ = parts.name.span();
  if (!session_.options.frame || !parts.range) return std::nullopt;
  const auto& settings = session_.options.params;
  const auto set_too =
      std::find_if(settings.begin(), settings.end(),
                   [&](const ParamSetting& setting) { return setting.name == parts.name.text(); });
  if (set_too != settings.end()) {
    return session_.error(
        DiagnosticKind::clock_frames, set_too->span.valid() ? set_too->span : clock_,
        fmt::format("`{}` is set by `--frames`, and by `{}` too", set_too->name, set_too->source));
  }
  return clock_in_frame(parts, *session_.options.frame, scope);
}

void Lowering::report_missing_clock(Scope& scope) {
  if (!session_.options.frame || clock_.valid()) return;
  constexpr const char* message = "`--frames` needs a clock, and this scene has none";
  for (const Binding& binding : scope.bindings()) {
    const bool could_be = binding.kind == BindingKind::param && binding.value.is_number() &&
                          binding.value.dimension == dimension::time;
    if (!could_be) continue;
    const bool has_range = static_cast<bool>(ast::item_of(binding.node).range);
    session_.report(Diagnostic(DiagnosticKind::clock_missing, binding.span, message)
                        .hint(fmt::format("write `@clock` before `param {}`{}", binding.name,
                                          has_range ? "" : " and give it a range")));
    return;
  }
  session_.report(Diagnostic(DiagnosticKind::clock_missing, edition_, message)
                      .hint("declare one: `@clock param t: time = 0s in 0s .. 6s;`"));
}

}  // namespace scenec::frontend
