// Values into members of the IR, one overload a member type: type, dimension and range are checked,
// and what does not fit is reported. A value of which only the type is known is checked and not
// stored. False when nothing was stored because of a mistake.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <vector>

#include "frontend/eval/builtins.hpp"
#include "frontend/eval/coerce.hpp"
#include "frontend/eval/value.hpp"
#include "frontend/session.hpp"
#include "ir/cameras.hpp"
#include "ir/render_settings.hpp"
#include "ir/schema.hpp"
#include "ir/shapes.hpp"

namespace scenec::frontend {

struct KeyContext {
  Session& session;
  Need need;
  ir::Range range;
};

// Reports a number outside the range; `dimension` for printing.
bool check_range(const KeyContext& key, double value, Dimension dimension);

bool convert_quantity(const KeyContext& key, const Value& value, Dimension dimension, double& out);
template <class Tag>
bool convert(const KeyContext& key, const Value& value, Quantity<Tag>& out) {
  return convert_quantity(key, value, Tag::dimension, out.value);
}
bool convert(const KeyContext& key, const Value& value, double& out);
bool convert(const KeyContext& key, const Value& value, std::int64_t& out);
bool convert(const KeyContext& key, const Value& value, std::uint32_t& out);
bool convert(const KeyContext& key, const Value& value, bool& out);
bool convert(const KeyContext& key, const Value& value, std::string& out);
bool convert(const KeyContext& key, const Value& value, ir::Vec2& out);
bool convert(const KeyContext& key, const Value& value, ir::Direction& out);
bool convert(const KeyContext& key, const Value& value, ir::Point3& out);
bool convert(const KeyContext& key, const Value& value, ir::Color& out);
bool convert(const KeyContext& key, const Value& value, ir::ColorInput& out);
bool convert(const KeyContext& key, const Value& value, ir::NumberInput& out);
bool convert(const KeyContext& key, const Value& value, ir::TextureId& out);
bool convert(const KeyContext& key, const Value& value, ir::MaterialId& out);
bool convert(const KeyContext& key, const Value& value, ir::ProtoId& out);
bool convert(const KeyContext& key, const Value& value, ir::AssetId& out);
bool convert(const KeyContext& key, const Value& value, ir::Curve& out);
bool convert(const KeyContext& key, const Value& value, ir::Transform& out);
bool convert(const KeyContext& key, const Value& value, ir::MeshNormals& out);
bool convert(const KeyContext& key, const Value& value, ir::FocusDistance& out);
bool convert(const KeyContext& key, const Value& value, ir::PixelFilter& out);
bool convert(const KeyContext& key, const Value& value, ir::ImageSize& out);
bool convert(const KeyContext& key, const Value& value, ir::Region& out);

template <ir::NamedEnum E>
bool convert(const KeyContext& key, const Value& value, E& out) {
  const auto index = choice_of(key.session, value, ir::EnumNames<E>::names, key.need);
  if (index) out = static_cast<E>(*index);
  return index.has_value();
}

template <class T, std::size_t N>
bool convert(const KeyContext& key, const Value& value, std::array<T, N>& out);
template <class T>
bool convert(const KeyContext& key, const Value& value, std::vector<T>& out);

template <class T>
bool convert(const KeyContext& key, const Value& value, std::optional<T>& out) {
  T inner{};
  if (!convert(key, value, inner)) return false;
  out = std::move(inner);
  return true;
}

// Checks that the value is a list and calls each(element, its key context); false when it is none.
template <class F>
bool convert_elements(const KeyContext& key, const Value& value, F&& each) {
  const Value list = accepted(key.session, value, Accept::list, key.need);
  if (list.poisoned()) return false;
  const std::size_t count = element_count(list);
  bool sound = true;
  // A list written out shows each mistake at its element.
  std::vector<grammar::NodeRef> nodes;
  if (key.need.node.is(grammar::SyntaxKind::list)) {
    for (grammar::NodeRef child : key.need.node.children()) {
      if (!grammar::is_token(child.kind())) nodes.push_back(child);
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    KeyContext inner = key;
    if (nodes.size() == count) inner.need.node = nodes[i];
    sound = each(element_of(list, i), inner) && sound;
  }
  return sound;
}

template <class T, std::size_t N>
bool convert(const KeyContext& key, const Value& value, std::array<T, N>& out) {
  if (is_listlike(value) && value.known && element_count(value) != N) {
    type_error(key.session, key.need, "a list of " + std::to_string(N), value);
    return false;
  }
  std::size_t i = 0;
  return convert_elements(key, value, [&](const Value& element, const KeyContext& inner) {
    return i < N && convert(inner, element, out[i++]);
  });
}

template <class T>
bool convert(const KeyContext& key, const Value& value, std::vector<T>& out) {
  return convert_elements(key, value, [&](const Value& element, const KeyContext& inner) {
    return convert(inner, element, out.emplace_back());
  });
}

}  // namespace scenec::frontend
