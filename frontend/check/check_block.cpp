#include "frontend/check/check_block.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"

namespace scenec::frontend {

namespace {
// No block has that many keys; what is beyond is wrong already and need not be remembered.
constexpr std::size_t max_remembered = 256;

std::string quoted_words(const std::vector<std::string_view>& names, std::string_view last_joint) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? last_joint : std::string_view(", ");
    text += fmt::format("`{}`", names[i]);
  }
  return text;
}
}  // namespace

Field* Fields::find(std::string_view name) {
  for (Field& field : fields_) {
    if (field.name == name) return &field;
  }
  return nullptr;
}

void Fields::add(Session& session, const Field& field) {
  if (const Field* first = find(field.name)) {
    session.error(Diagnostic(DiagnosticKind::duplicate_key, field.name_node.span(),
                             fmt::format("`{}` is given twice", printable(field.name)))
                      .note("first given here", first->name_node.span()));
    return;
  }
  if (fields_.size() < max_remembered) fields_.push_back(field);
}

const Field* BlockChecker::written(std::string_view name) const {
  if (const Field* field = fields_.find(name)) return field;
  for (const Nested& nested : nested_) {
    if (nested.path == name) return &nested.field;
  }
  return nullptr;
}

void BlockChecker::check_rule(const ir::KeyRule& rule) {
  std::vector<std::string_view> names;
  std::vector<std::string_view> given;
  for (std::string_view name : rule.keys) {
    if (name.empty()) continue;
    names.push_back(name);
    if (written(name) != nullptr) given.push_back(name);
  }
  using Kind = ir::KeyRule::Kind;
  if (rule.kind == Kind::together) {
    if (given.empty() || given.size() == names.size()) return;
    sound_ = false;
    session_.error(DiagnosticKind::keys_belong_together, written(given[0])->name_node.span(),
                   fmt::format("{} belong together; found only {}", quoted_words(names, " and "),
                               quoted_words(given, " and ")));
    return;
  }
  if (given.size() > 1) {
    sound_ = false;
    Diagnostic diagnostic(DiagnosticKind::conflicting_keys, written(given[1])->name_node.span(),
                          fmt::format("{} exclude each other", quoted_words(given, " and ")));
    diagnostic.notes.push_back(
        {fmt::format("`{}` is given here", given[0]), written(given[0])->name_node.span()});
    session_.error(std::move(diagnostic));
  } else if (given.empty() && rule.kind == Kind::exactly_one) {
    missing_.push_back(names);
  }
}

void BlockChecker::report_missing() {
  if (missing_.empty()) return;
  sound_ = false;
  std::string text;
  for (std::size_t i = 0; i < missing_.size(); ++i) {
    if (i > 0) text += i + 1 == missing_.size() ? " and " : ", ";
    text += quoted_words(missing_[i], " or ");
  }
  session_.error(DiagnosticKind::missing_key, place_,
                 fmt::format("`{}` needs {}", printable(subject_), text));
}

bool BlockChecker::has_unknown() const {
  for (const Field& field : fields_.all()) {
    if (!field.taken) return true;
  }
  return false;
}

void BlockChecker::report_unknown(const std::vector<std::string_view>& legal) {
  for (const Field& field : fields_.all()) {
    if (field.taken) continue;
    sound_ = false;
    session_.report(unknown_word(
        DiagnosticKind::unknown_key, field.name_node.span(),
        fmt::format("`{}` has no key `{}`", printable(subject_), printable(field.name)), field.name,
        legal, "keys"));
    static_cast<void>(
        evaluator_.evaluate(field.expression, scope_));  // its own mistakes, and names it uses
    // A misspelt key is not missing as well.
    const auto meant = nearest_name(field.name, legal);
    std::erase_if(missing_, [&](const auto& names) {
      return meant && std::find(names.begin(), names.end(), *meant) != names.end();
    });
  }
}

void BlockChecker::report_block_for_value(const Field& field) {
  sound_ = false;
  session_.error(
      DiagnosticKind::type_mismatch, field.name_node.span(),
      fmt::format("`{0}` takes a value, not a block: `{0} = ...;`", printable(field.name)));
}

void BlockChecker::report_value_for_block(const Field& field) {
  sound_ = false;
  session_.error(DiagnosticKind::type_mismatch, field.name_node.span(),
                 fmt::format("`{0}` is a block: `{0} {{ ... }}`", printable(field.name)));
}

}  // namespace scenec::frontend
