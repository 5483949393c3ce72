// The keys and sub-blocks written in one block, before they are matched with a schema.
#pragma once

#include <string_view>
#include <vector>

#include "frontend/session.hpp"
#include "grammar/syntax_tree.hpp"

namespace scenec::frontend {

struct Field {
  std::string_view name;
  grammar::NodeRef name_node;
  grammar::NodeRef expression;  // `name = expression;`
  grammar::NodeRef block;       // `name { ... }`
  bool taken = false;           // a schema knows the key
};

class Fields {
 public:
  void clear() { fields_.clear(); }
  // Reports a key that was there before, and ignores it.
  void add(Session& session, const Field& field);
  [[nodiscard]] Field* find(std::string_view name);
  [[nodiscard]] std::vector<Field>& all() { return fields_; }

 private:
  std::vector<Field> fields_;
};

}  // namespace scenec::frontend
