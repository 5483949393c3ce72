// Functions of lists and strings.
#include <fmt/format.h>

#include <array>

#include "base/text.hpp"
#include "frontend/eval/builtins.hpp"
#include "frontend/eval/lists.hpp"
#include "frontend/eval/operators.hpp"

namespace scenec::frontend {

namespace {

Value run_len(Call& call) {
  const Value& x = call[0];
  if (!is_listlike(x) && !x.is(Type::string))
    return type_error(call.session, call.need(0), "a list or a string", x);
  if (x.is_vector()) return make_int(static_cast<std::int64_t>(x.vector_size()));
  if (!x.known) return make_unknown(Type::integer);
  const std::size_t size = x.is(Type::string) ? count_code_points(x.text()) : x.elements().size();
  return make_int(static_cast<std::int64_t>(size));
}

Value run_sum(Call& call) {
  const Value& list = call[0];
  const std::size_t count = element_count(list);
  if (count == 0) return call.known ? make_int(0) : Value{};
  if (!call.session.spend(count, call.span())) return {};
  const Operation adding{.op = "+", .span = call.span(), .left = {}, .right = {}};
  Value total = element_of(list, 0);
  for (std::size_t i = 1; i < count; ++i) {
    total = arithmetic(call.session, total, element_of(list, i), adding);
    if (total.poisoned()) return {};
  }
  return list.known ? total : type_of(total);
}

Value too_long_string(Call& call) {
  return call.session.error(DiagnosticKind::string_too_long, call.span(),
                            fmt::format("the string is longer than {} bytes", max_string_bytes));
}

Value string_result(Call& call, std::string text) {
  if (!call.session.spend(text.size() / 8 + 1, call.span())) return {};
  if (!call.known) return make_unknown(Type::string);
  return make_string(std::move(text), call.span().file);
}

Value joined_strings(Call& call) {
  std::string text;
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    if (!call[i].is(Type::string))
      return type_error(call.session, call.need(i), "a string", call[i]);
    if (call.known) text += call[i].text();
    if (text.size() > max_string_bytes) return too_long_string(call);
  }
  return string_result(call, std::move(text));
}

// Lists to one list, or strings to one string.
Value run_concat(Call& call) {
  if (call[0].is(Type::string)) return joined_strings(call);
  ValueList elements;
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    if (!is_listlike(call[i]))
      return type_error(call.session, call.need(i), i == 0 ? "a list or a string" : "a list",
                        call[i]);
    const std::size_t count = element_count(call[i]);
    if (!call.session.spend(count * steps_per_list_element, call.span())) return {};
    if (elements.size() + count > max_list_elements) {
      return call.session.error(
          DiagnosticKind::list_too_long, call.span(),
          fmt::format("the list has more than {} elements", max_list_elements));
    }
    for (std::size_t k = 0; k < count; ++k) elements.push_back(element_of(call[i], k));
  }
  if (elements.empty()) return call.known ? make_list({}) : make_unknown_list({});
  const Value pattern = type_of(elements.front());
  const Value list = checked_list(call.session, std::move(elements), call.node, {});
  return call.known || list.poisoned() ? list : make_unknown_list(pattern);
}

std::string text_of_value(const Value& value) {
  switch (value.type) {
    case Type::boolean:
      return value.boolean() ? "true" : "false";
    case Type::integer:
      return std::to_string(value.integer);
    case Type::number: {
      const std::string unit = si_unit_of(value.dimension);
      return short_number_text(value.real()) + unit;
    }
    case Type::string:
      return value.text();
    case Type::enumeration:
      return '.' + value.text();
    default:
      break;
  }
  std::string text = "[";
  for (std::size_t i = 0; i < element_count(value); ++i) {
    if (i > 0) text += ", ";
    text += text_of_value(element_of(value, i));
  }
  return text + ']';
}

Value run_str(Call& call) {
  std::string text;
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    const Value& value = call[i];
    const bool printable_type = value.is_number() || value.is_vector() || value.is(Type::boolean) ||
                                value.is(Type::string) || value.is(Type::enumeration);
    if (!printable_type)
      return type_error(call.session, call.need(i), "a number, a truth value, a string or a vector",
                        value);
    if (call.known) text += text_of_value(value);
    if (text.size() > max_string_bytes) return too_long_string(call);
  }
  return string_result(call, std::move(text));
}

constexpr std::array<Parameter, 1> any_x{{{"x"}}};
constexpr std::array<Parameter, 1> one_list{{{"list", Accept::list}}};

constexpr std::array<Builtin, 4> rows{{
    {"len", any_x, run_len},
    {"sum", one_list, run_sum},
    {"concat", any_x, run_concat, true},
    {"str", any_x, run_str, true},
}};

}  // namespace

std::span<const Builtin> list_functions() {
  return rows;
}

}  // namespace scenec::frontend
