// Where a key of a block is written, for messages about values that are each legal.
#pragma once

#include "base/span.hpp"
#include "frontend/check/check_block.hpp"
#include "frontend/check/key_name.hpp"

namespace scenec::frontend {

// The value of the key; `head` when a default stands.
template <class T, class Owner, class Member>
[[nodiscard]] Span place_of(const BlockChecker& checker, Member Owner::* member, Span head) {
  const Field* field = checker.written(key_name<T>(member));
  if (field == nullptr) return head;
  return field->expression ? field->expression.span() : field->name_node.span();
}

}  // namespace scenec::frontend
