// Prints what is reachable from placed items, lights, cameras and the render block. Blocks stand on
// one line each; keys in the order of their Schema, defaults left out.
#include "ir/dump.hpp"

#include <fmt/format.h>

#include <set>
#include <vector>

#include "base/file_system.hpp"
#include "base/text.hpp"
#include "ir/names.hpp"
#include "ir/print.hpp"

namespace scenec::ir {
namespace {

class Dumper {
 public:
  Dumper(const Scene& scene, const DumpOptions& options)
      : scene_(scene), options_(options), names_(scene) {}

  std::string run() {
    text_ = "sdl 1;\n";
    for (MaterialId id : names_.used_materials()) print_material(id);
    for (ProtoId id : names_.used_protos()) print_proto(id);
    for (const Item& item : scene_.items) print_item(item, "");
    for (std::uint32_t i = 0; i < scene_.lights.size(); ++i) print_light(Id<Light>(i));
    for (std::uint32_t i = 0; i < scene_.cameras.size(); ++i) print_camera(CameraId(i));
    if (!scene_.cameras.empty()) print_render();
    return std::move(text_);
  }

 private:
  void print_material(MaterialId id) {
    const Material& material = scene_.materials[id];
    std::visit(
        [&]<class T>(const T& kind) {
          text_ += fmt::format("material {}: {} {{{}{} }}\n", names_.of(id), Schema<T>::name,
                               fields(kind), fields(material.common));
        },
        material.kind);
  }
  void print_proto(ProtoId id) {
    text_ += fmt::format("proto {} {{\n", names_.of(id));
    for (const Item& item : scene_.protos[id].items) print_item(item, "  ");
    text_ += "}\n";
  }
  void print_item(const Item& item, std::string_view indent) {
    std::visit(
        [&]<class T>(Id<T> id) {
          const std::string label = item.name.valid() ? " " + scene_.names[item.name] : "";
          text_ +=
              fmt::format("{}{}{} {{{}", indent, Schema<T>::name, label, fields(scene_.shape(id)));
          if (item.material.valid())
            text_ += fmt::format(" material = {};", names_.of(item.material));
          const Transform transform = scene_.transforms[item.transform];
          if (!transform.is_identity())
            text_ += fmt::format(" transform = {};", value_text(transform));
          text_ += " }\n";
        },
        item.shape);
  }
  void print_light(Id<Light> id) {
    const NameId name = scene_.light_names[id].name;
    const std::string label = name.valid() ? " " + scene_.names[name] : "";
    std::visit(
        [&]<class T>(const T& kind) {
          text_ += fmt::format("light{}: {} {{{} }}\n", label, Schema<T>::name, fields(kind));
        },
        scene_.lights[id].kind);
  }
  void print_camera(CameraId id) {
    std::visit(
        [&]<class T>(const T& kind) {
          text_ +=
              fmt::format("camera {}: {} {{{} }}\n", names_.of(id), Schema<T>::name, fields(kind));
        },
        scene_.cameras[id].kind);
  }
  void print_render() { text_ += fmt::format("render {{{} }}\n", fields(scene_.render)); }

  // " key = value;" for each key that is required or differs from its default.
  template <class T>
  std::string fields(const T& values) {
    std::string text;
    const T defaults{};
    visit_keys<T>([&](const auto& key) {
      using Member = typename std::remove_cvref_t<decltype(key)>::member_type;
      const Member& member = values.*key.member;
      if constexpr (HasSchema<Member>) {
        const std::string inner = fields(member);
        if (!inner.empty()) text += fmt::format(" {} {{{} }}", key.name, inner);
      } else {
        bool written = key.need == Need::required || member != defaults.*key.member;
        if constexpr (std::same_as<T, RenderSettings>) {
          written = written || (key.name == "background" && values.background_written);
        }
        if (written) text += fmt::format(" {} = {};", key.name, text_of(member));
      }
    });
    return text;
  }

  template <class T>
  std::string text_of(const T& value) {
    return value_text(value);
  }
  template <class T>
  std::string text_of(const std::optional<T>& value) {
    return text_of(*value);
  }
  std::string text_of(MaterialId id) { return names_.of(id); }
  std::string text_of(ProtoId id) { return names_.of(id); }
  std::string text_of(CameraId id) { return names_.of(id); }
  std::string text_of(AssetId id) {
    return quoted_string(relative_path(scene_.assets[id].path, options_.directory));
  }
  std::string text_of(TextureId id) { return texture_text(id); }
  std::string text_of(const ColorInput& input) {
    return input.texture.valid() ? texture_text(input.texture) : value_text(input.value);
  }
  std::string text_of(const NumberInput& input) {
    return input.texture.valid() ? texture_text(input.texture) : value_text(input.value);
  }

  std::string texture_text(TextureId id) {
    const TextureNode& node = scene_.textures[id];
    return std::visit([&](const auto& texture) { return texture_text(texture, node.scalar); },
                      node.kind);
  }
  // A constant inside a texture: a number where the texture was written with numbers.
  static std::string constant_text(const Color& color, bool scalar) {
    return scalar ? value_text(color.r) : value_text(color);
  }
  std::string source_text(const ColorInput& input, bool scalar) {
    return input.texture.valid() ? texture_text(input.texture) : constant_text(input.value, scalar);
  }
  std::string texture_text(const ImageTexture& t, bool) {
    const ImageTexture usual;
    std::string text = "image(" + text_of(t.file);
    if (t.wrap != usual.wrap) text += ", wrap = " + value_text(t.wrap);
    if (t.filter != usual.filter) text += ", filter = " + value_text(t.filter);
    if (t.encoding != usual.encoding) text += ", encoding = " + value_text(t.encoding);
    if (t.scale != usual.scale) text += ", scale = " + value_text(t.scale);
    return text + ")";
  }
  std::string texture_text(const CheckerTexture& t, bool scalar) {
    return fmt::format("checker({}, {}, {})", source_text(t.a, scalar), source_text(t.b, scalar),
                       value_text(t.scale));
  }
  std::string texture_text(const FractalTexture& t, bool scalar) {
    return fmt::format("fractal({}, {}, {}, {})", value_text(t.scale), t.octaves,
                       source_text(t.a, scalar), source_text(t.b, scalar));
  }
  std::string texture_text(const RampTexture& t, bool scalar) {
    std::string stops;
    for (const auto& [at, color] : t.stops) {
      if (!stops.empty()) stops += ", ";
      stops += fmt::format("[{}, {}]", value_text(at), constant_text(color, scalar));
    }
    return fmt::format("ramp({}, [{}])", text_of(t.t), stops);
  }
  std::string texture_text(const GridTexture& t, bool scalar) {
    return fmt::format("grid({}, {}, {}, {})", source_text(t.line, scalar),
                       source_text(t.fill, scalar), value_text(t.scale), value_text(t.width));
  }
  std::string texture_text(const ConstantTexture& t, bool scalar) {
    return constant_text(t.color, scalar);
  }
  std::string texture_text(const ProductTexture& t, bool scalar) {
    return fmt::format("({} * {})", source_text(t.a, scalar), source_text(t.b, scalar));
  }
  std::string texture_text(const MixTexture& t, bool scalar) {
    return fmt::format("mix({}, {}, {})", source_text(t.a, scalar), source_text(t.b, scalar),
                       text_of(t.t));
  }
  std::string texture_text(const ChannelTexture& t, bool) {
    return texture_text(t.source) + "." +
           std::string(EnumNames<Channel>::names[static_cast<std::size_t>(t.channel)]);
  }

  const Scene& scene_;
  const DumpOptions& options_;
  DumpNames names_;
  std::string text_;
};

}  // namespace

std::string dump_text(const Scene& scene, const DumpOptions& options) {
  return Dumper(scene, options).run();
}

}  // namespace scenec::ir
