#include "ir/describe.hpp"

#include <fmt/format.h>

#include <type_traits>

#include "ir/cameras.hpp"
#include "ir/lights.hpp"
#include "ir/materials.hpp"
#include "ir/print.hpp"
#include "ir/render_settings.hpp"
#include "ir/shapes.hpp"

namespace scenec::ir {
namespace {

// The type of a key as an author thinks of it.
template <class T>
struct TypeText;
#define SCENEC_TYPE_TEXT(type, words) \
  template <>                         \
  struct TypeText<type> {             \
    static std::string text() {       \
      return words;                   \
    }                                 \
  }
SCENEC_TYPE_TEXT(bool, "bool");
SCENEC_TYPE_TEXT(std::int64_t, "int");
SCENEC_TYPE_TEXT(double, "number");
SCENEC_TYPE_TEXT(Length, "length");
SCENEC_TYPE_TEXT(Angle, "angle");
SCENEC_TYPE_TEXT(Time, "time");
SCENEC_TYPE_TEXT(Power, "power");
SCENEC_TYPE_TEXT(Vec2, "vec2");
SCENEC_TYPE_TEXT(Direction, "direction (vec3, not zero)");
SCENEC_TYPE_TEXT(Point3, "point");
SCENEC_TYPE_TEXT(Color, "color");
SCENEC_TYPE_TEXT(ColorInput, "color or texture");
SCENEC_TYPE_TEXT(NumberInput, "number or texture");
SCENEC_TYPE_TEXT(TextureId, "texture");
SCENEC_TYPE_TEXT(MaterialId, "material");
SCENEC_TYPE_TEXT(ProtoId, "proto");
SCENEC_TYPE_TEXT(CameraId, "camera");
SCENEC_TYPE_TEXT(AssetId, "file name");
SCENEC_TYPE_TEXT(std::string, "string");
SCENEC_TYPE_TEXT(Curve, "curve");
SCENEC_TYPE_TEXT(Transform, "transform or list of transforms");
SCENEC_TYPE_TEXT(MeshNormals, "one of .auto .file .smooth .flat, or a list of directions");
SCENEC_TYPE_TEXT(FocusDistance, "length or .aim");
SCENEC_TYPE_TEXT(PixelFilter, "filter, such as tent(1.0) or .box");
SCENEC_TYPE_TEXT(ImageSize, "[width, height]");
SCENEC_TYPE_TEXT(Region, "[x0, y0, x1, y1]");
SCENEC_TYPE_TEXT(Face, "list of vertex numbers");
#undef SCENEC_TYPE_TEXT
template <class T>
struct TypeText<std::optional<T>> : TypeText<T> {};
template <class T>
struct TypeText<std::vector<T>> {
  static std::string text() { return "[" + TypeText<T>::text() + "]"; }
};
template <class T, std::size_t N>
struct TypeText<std::array<T, N>> {
  static std::string text() { return fmt::format("{} times {}", N, TypeText<T>::text()); }
};
template <NamedEnum E>
struct TypeText<E> {
  static std::string text() {
    std::string words = "one of";
    for (std::string_view name : EnumNames<E>::names) words += fmt::format(" .{}", name);
    return words;
  }
};
template <HasSchema T>
struct TypeText<T> {
  static std::string text() { return "block"; }
};

template <class T>
std::optional<std::string> default_text(const T& value) {
  if constexpr (requires { value_text(value); }) {
    return value_text(value);
  } else if constexpr (requires { value.texture; }) {
    return value_text(value.value);
  } else {
    return std::nullopt;  // optional keys, ids and blocks
  }
}

template <class T>
std::vector<std::string_view> legal_values() {
  if constexpr (NamedEnum<T>) {
    return {EnumNames<T>::names.begin(), EnumNames<T>::names.end()};
  } else if constexpr (requires { typename T::value_type; }) {
    return legal_values<typename T::value_type>();
  } else {
    return {};
  }
}

template <class T>
KindDescription describe(std::string_view family) {
  KindDescription kind{family,
                       Schema<T>::name,
                       Schema<T>::doc,
                       {},
                       {Schema<T>::rules.begin(), Schema<T>::rules.end()}};
  const T defaults{};
  visit_keys<T>([&](const auto& key) {
    using Member = typename std::remove_cvref_t<decltype(key)>::member_type;
    KeyDescription row{
        key.name, TypeText<Member>::text(), std::nullopt, key.need == Need::required, key.range,
        key.doc,  legal_values<Member>()};
    if (!row.required) row.default_text = default_text(defaults.*key.member);
    kind.keys.push_back(std::move(row));
  });
  return kind;
}

template <class... Ts>
void add_list(std::vector<KindDescription>& kinds, std::string_view family, TypeList<Ts...>) {
  (kinds.push_back(describe<Ts>(family)), ...);
}
template <class... Ts>
void add_variant(std::vector<KindDescription>& kinds, std::string_view family,
                 const std::variant<Ts...>*) {
  (kinds.push_back(describe<Ts>(family)), ...);
}

std::vector<KindDescription> describe_all() {
  std::vector<KindDescription> kinds;
  add_list(kinds, "shape", ShapeTypes{});
  add_list(kinds, "item", TypeList<Placing>{});
  add_variant(kinds, "material", static_cast<const MaterialKind*>(nullptr));
  add_list(kinds, "material_common", TypeList<MaterialCommon>{});
  add_variant(kinds, "light", static_cast<const LightKind*>(nullptr));
  add_variant(kinds, "camera", static_cast<const CameraKind*>(nullptr));
  add_list(kinds, "render", TypeList<RenderSettings, Stop, EffectSwitches>{});
  return kinds;
}

}  // namespace

const std::vector<KindDescription>& all_kinds() {
  static const std::vector<KindDescription> kinds = describe_all();
  return kinds;
}

std::vector<std::string_view> kind_names(std::string_view family) {
  std::vector<std::string_view> names;
  for (const KindDescription& kind : all_kinds()) {
    if (kind.family == family) names.push_back(kind.name);
  }
  return names;
}

}  // namespace scenec::ir
