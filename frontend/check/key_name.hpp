// The name of a key by its member, so that code which needs one key does not spell its name again.
#pragma once

#include <concepts>
#include <string_view>

#include "ir/schema.hpp"

namespace scenec::frontend {

template <class T, class Owner, class Member>
[[nodiscard]] constexpr std::string_view key_name(Member Owner::* member) {
  std::string_view name;
  ir::visit_keys<T>([&](const auto& key) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(key.member)>, Member Owner::*>) {
      if (key.member == member) name = key.name;
    }
  });
  return name;
}

}  // namespace scenec::frontend
