// A block against Schema<T>: every key is looked up, converted and stored; unknown, duplicate,
// missing and excluding keys are reported. Nothing here knows the name of a key.
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/check/convert.hpp"
#include "frontend/check/fields.hpp"
#include "frontend/eval/evaluate.hpp"
#include "frontend/eval/scope.hpp"
#include "ir/schema.hpp"

namespace scenec::frontend {

// Fills a Fields from a block; whoever lowers items does it, since a block may also hold `let`.
class FieldCollector {
 public:
  virtual void collect(grammar::NodeRef block, Scope& scope, Fields& fields) = 0;

 protected:
  ~FieldCollector() = default;
};

class BlockChecker {
 public:
  // `subject` is how messages call the block; `place` is where missing keys are reported.
  BlockChecker(Session& session, Evaluator& evaluator, FieldCollector& collector, Scope& scope,
               Fields& fields, std::string_view subject, Span place)
      : session_(session),
        evaluator_(evaluator),
        collector_(collector),
        scope_(scope),
        fields_(fields),
        subject_(subject),
        place_(place) {}

  // Reads all keys of T. Keys left out keep the value they have in `out`.
  template <ir::HasSchema T>
  void read(T& out) {
    ir::visit_keys<T>([&](const auto& key) { read_key(key, out); });
    for (const ir::KeyRule& rule : ir::Schema<T>::rules) check_rule(rule);
  }
  // Reports what no schema has taken; Ts are all schemas read.
  template <ir::HasSchema... Ts>
  void finish() {
    if (has_unknown()) {
      std::vector<std::string_view> legal;
      (ir::visit_keys<Ts>([&](const auto& key) { legal.push_back(key.name); }), ...);
      report_unknown(legal);
    }
    report_missing();
  }
  // The field of a key; nullptr when it is not written. `stop.samples` reaches into a sub-block.
  [[nodiscard]] const Field* written(std::string_view name) const;
  // True when every key written could be read.
  [[nodiscard]] bool sound() const { return sound_; }

 private:
  template <class Key, class T>
  void read_key(const Key& key, T& out) {
    using Member = typename std::remove_cvref_t<Key>::member_type;
    Field* const field = fields_.find(key.name);
    if (field == nullptr) {
      if (key.need == ir::Need::required) missing_.push_back({key.name});
      return;
    }
    field->taken = true;
    if constexpr (ir::HasSchema<Member>) {
      read_block(*field, out.*key.member);
    } else if (field->block) {
      report_block_for_value(*field);
    } else if constexpr (!std::same_as<Member,
                                       ir::CameraId>) {  // cameras have their own table of names
      const Value value = evaluator_.evaluate(field->expression, scope_);
      const Need need{.subject = field->name, .function = {}, .node = field->expression};
      if (!field->expression ||
          !convert(KeyContext{session_, need, key.range}, value, out.*key.member))
        sound_ = false;
    }
  }
  template <ir::HasSchema T>
  void read_block(const Field& field, T& out) {
    if (!field.block) return report_value_for_block(field);
    Fields inner;
    Scope scope(&scope_);
    collector_.collect(field.block, scope, inner);
    for (const Field& key : inner.all())
      nested_.push_back({std::string(field.name) + '.' + std::string(key.name), key});
    BlockChecker checker(session_, evaluator_, collector_, scope, inner, field.name,
                         field.name_node.span());
    checker.read(out);
    checker.template finish<T>();
    sound_ = sound_ && checker.sound();
  }
  void check_rule(const ir::KeyRule& rule);
  void report_missing();
  [[nodiscard]] bool has_unknown() const;
  void report_unknown(const std::vector<std::string_view>& legal);
  void report_block_for_value(const Field& field);
  void report_value_for_block(const Field& field);

  struct Nested {
    std::string path;
    Field field;
  };
  Session& session_;
  Evaluator& evaluator_;
  FieldCollector& collector_;
  Scope& scope_;
  Fields& fields_;
  std::string_view subject_;
  Span place_;
  std::vector<std::vector<std::string_view>> missing_;  // of each entry one key is needed
  std::vector<Nested> nested_;
  bool sound_ = true;
};

}  // namespace scenec::frontend
