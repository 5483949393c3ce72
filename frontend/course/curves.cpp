// Curves and surfaces of revolution (PA2).
#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "frontend/course/native_text.hpp"
#include "frontend/course/objects.hpp"

namespace scenec::frontend::course {

namespace {

constexpr std::size_t least_points = 4;

// `controls 4 x y z ...`, or the same without its count: triples.
bool split_flat(std::vector<Number> numbers, std::vector<std::vector<Number>>& points) {
  const std::size_t triples = numbers.size() / 3;
  if (numbers.size() % 3 == 1 && numbers[0].value == static_cast<double>(triples)) {
    numbers.erase(numbers.begin());
  }
  if (numbers.size() % 3 != 0) return false;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    points.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  return true;
}

// The radius without its sign: a profile left of the axis turns into the same surface.
Number without_sign(Number number) {
  if (!(number.value < 0)) return number;
  number.value = -number.value;
  number.text.remove_prefix(1);
  ++number.span.begin;
  return number;
}

}  // namespace

std::optional<std::vector<std::vector<Number>>> read_controls(Context& context,
                                                              const Entry& curve) {
  const Fields fields(context, curve, Place::curve, {Role::points});
  if (!fields.complete()) return std::nullopt;
  const Entry& controls = fields[Role::points];
  std::vector<std::vector<Number>> points = controls.points;
  bool good = true;
  if (points.empty()) {
    good = split_flat(controls.numbers, points);
  } else if (points.size() == 1 && points[0].size() > 3) {
    const std::vector<Number> flat = points[0];
    points.clear();
    good = split_flat(flat, points);
  } else {
    for (const std::vector<Number>& point : points)
      good = good && (point.size() == 3 || point.size() == 2);
  }
  if (!good) {
    context.error(DiagnosticKind::course_wrong_values, controls.word_span,
                  "every point of `controls` needs 3 numbers");
    return std::nullopt;
  }
  if (points.size() < least_points) {
    context.error(DiagnosticKind::course_few_points, controls.word_span,
                  fmt::format("the curve has {} control point{}; it needs at least {}",
                              points.size(), points.size() == 1 ? "" : "s", least_points));
    return std::nullopt;
  }
  return points;
}

std::optional<Text> read_profile(Context& context, const Entry& profile) {
  const bool bezier = profile.name == "BezierCurve";
  if (!bezier && profile.name != "BsplineCurve") {
    static constexpr std::array<std::string_view, 2> curves{"BezierCurve", "BsplineCurve"};
    Diagnostic diagnostic(DiagnosticKind::course_unknown_word, profile.name_span,
                          fmt::format("`{}` has no reading as a profile", printable(profile.name)));
    if (const auto nearest = nearest_name(profile.name, curves)) {
      diagnostic.hints.push_back(fmt::format("did you mean `{}`?", *nearest));
    }
    diagnostic.notes.push_back({"known here: " + quoted_list(curves), {}});
    context.sink.report(std::move(diagnostic));
    return std::nullopt;
  }
  auto points = read_controls(context, profile);
  if (!points) return std::nullopt;
  bool left = true;
  for (const std::vector<Number>& point : *points) {
    left = left && point[0].value <= 0;
    if (point.size() > 2 && point[2].value != 0) {
      context.error(DiagnosticKind::course_profile_depth, point[2].span,
                    fmt::format("the profile has z = {} here; it must lie in the plane z = 0",
                                short_number_text(point[2].value)));
      return std::nullopt;
    }
  }
  Text text(bezier ? "bezier([" : "bspline([");
  bool first = true;
  for (std::vector<Number>& point : *points) {
    if (!first) text.put(", ");
    first = false;
    point.resize(2);
    const Span span = join(point[0].span, point[1].span);
    if (left) point[0] = without_sign(point[0]);
    const std::size_t begin = text.size();
    text.put("[").put(text_of(point[0])).put(", ").put(text_of(point[1])).put("]");
    text.cover(begin, span);
  }
  text.put(bezier ? "])" : "], clamped = false)");
  text.cover(0, join(profile.word_span, profile.block.span()));
  return text;
}

void Objects::skip_curve(const Entry& entry) {
  (void)read_controls(context_, entry);
  context_.warn_once(DiagnosticKind::course_bare_curve, "curve", entry.word_span,
                     fmt::format("`{}` outside a `RevSurface` draws nothing", entry.word->text));
}

void Objects::write_revolve(const Entry& entry, const Target& target) {
  const Fields fields(context_, entry, Place::revolve, {Role::profile});
  if (!fields.complete()) return;
  auto profile = read_profile(context_, fields[Role::profile]);
  if (!profile) return;
  Item item;
  item.head.put("revolve", entry.word_span);
  item.add("profile", *profile, fields[Role::profile].span);
  Operations own;
  if (const Entry* const position = fields.find(Role::position);
      position != nullptr && vector_of(*position) != std::array<double, 3>{}) {
    own.push_back(Text("move(").put(list_of(position->numbers)).put(")"));
  }
  finish(item, entry, own, target, NeedsMaterial::no);
}

}  // namespace scenec::frontend::course
