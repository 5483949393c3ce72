#include "runtime/watch/camera_text.hpp"

#include <fmt/format.h>

#include <variant>

#include "base/text.hpp"
#include "ir/print.hpp"

namespace scenec::runtime {

namespace {

// Places to a tenth of a millimetre in a scene of metres: nobody wants sixteen digits.
std::string text_of(const ir::Point3& p) {
  return fmt::format("[{}, {}, {}]", short_number_text(p.x), short_number_text(p.y),
                     short_number_text(p.z));
}
template <class T>
std::string text_of(const T& value) {
  return ir::value_text(value);
}

template <class Member>
std::string key_text(std::string_view name, const Member& member) {
  if constexpr (requires { member.has_value(); }) {
    return member ? fmt::format("    {} = {};\n", name, text_of(*member)) : std::string();
  } else {
    return fmt::format("    {} = {};\n", name, text_of(member));
  }
}

}  // namespace

std::string camera_text(const ir::Camera& camera, const std::string& name) {
  return std::visit(
      [&]<class T>(const T& kind) {
        std::string text =
            fmt::format("camera{}{}: {} {{\n", name.empty() ? "" : " ", name, ir::Schema<T>::name);
        ir::visit_keys<T>([&](const auto& key) { text += key_text(key.name, kind.*key.member); });
        return text + "}\n";
      },
      camera.kind);
}

}  // namespace scenec::runtime
