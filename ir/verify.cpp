// Walks every table. Most checks follow from Schema and member types; what is written out here are
// the relations between rows.
#include "ir/verify.hpp"

#include <fmt/format.h>

#include <cmath>

#include "ir/components.hpp"

namespace scenec::ir {
namespace {

class Verifier {
 public:
  explicit Verifier(const Scene& scene) : scene_(scene) {}

  std::vector<std::string> run() {
    check_textures();
    check_materials();
    check_shapes();
    check_items();
    for (std::uint32_t i = 0; i < scene_.transforms.size(); ++i)
      check_transform(scene_.transforms[TransformId(i)]);
    for (const Light& light : scene_.lights)
      std::visit([&](const auto& kind) { check_keys(kind); }, light.kind);
    for (const Camera& camera : scene_.cameras)
      std::visit([&](const auto& kind) { check_keys(kind); }, camera.kind);
    check_keys(scene_.render);
    if (!scene_.cameras.empty() && !scene_.render.camera.valid()) complain("no camera is chosen");
    return std::move(violations_);
  }

 private:
  void complain(std::string text) {
    constexpr std::size_t enough = 20;  // one broken loop must not print a million lines
    if (violations_.size() < enough) violations_.push_back(std::move(text));
  }
  template <class Tag>
  void check_id(std::string_view what, Id<Tag> id, std::size_t count) {
    if (id.valid() && id.value() >= count)
      complain(fmt::format("{}: id {} of {}", what, id.value(), count));
  }
  void check_reference(std::string_view what, AssetId id) {
    check_id(what, id, scene_.assets.size());
  }
  void check_reference(std::string_view what, TextureId id) {
    check_id(what, id, scene_.textures.size());
  }
  void check_reference(std::string_view what, MaterialId id) {
    check_id(what, id, scene_.materials.size());
  }
  void check_reference(std::string_view what, ProtoId id) {
    check_id(what, id, scene_.protos.size());
  }
  void check_reference(std::string_view what, CameraId id) {
    check_id(what, id, scene_.cameras.size());
  }
  template <class T>
  void check_reference(std::string_view what, const Input<T>& input) {
    check_reference(what, input.texture);
  }

  // Every key of one block: numbers in range and finite, ids inside their tables.
  template <class T>
  void check_keys(const T& fields) {
    visit_keys<T>([&](const auto& key) {
      using Member = typename std::remove_cvref_t<decltype(key)>::member_type;
      const Member& member = fields.*key.member;
      if constexpr (HasSchema<Member>) {
        check_keys(member);
      } else {
        for_each_number(member, [&](double number) {
          if (!std::isfinite(number) || !key.range.contains(number)) {
            complain(fmt::format("{}.{} is {}", Schema<T>::name, key.name, number));
          }
        });
        if constexpr (requires { check_reference(key.name, member); })
          check_reference(key.name, member);
      }
    });
  }

  void check_transform(const Transform& transform) {
    for (double entry : transform.m) {
      if (!std::isfinite(entry)) return complain("a transform is not finite");
    }
    if (determinant(transform) == 0) complain("a transform is singular");
  }

  void check_textures() {
    for (std::uint32_t i = 0; i < scene_.textures.size(); ++i) {
      const auto earlier = [&](TextureId id) {
        if (id.valid() && id.value() >= i)
          complain(fmt::format("texture {} refers to {}", i, id.value()));
      };
      std::visit([&](const auto& texture) { visit_sources(texture, earlier); },
                 scene_.textures[TextureId(i)].kind);
    }
  }
  template <class T, class F>
  static void visit_sources(const T& texture, F&& f) {
    if constexpr (requires {
                    texture.a;
                    texture.b;
                  })
      f(texture.a.texture), f(texture.b.texture);
    if constexpr (requires { texture.t; }) f(texture.t.texture);
    if constexpr (requires {
                    texture.line;
                    texture.fill;
                  })
      f(texture.line.texture), f(texture.fill.texture);
    if constexpr (requires { texture.source; }) f(texture.source);
  }

  void check_materials() {
    for (std::uint32_t i = 0; i < scene_.materials.size(); ++i) {
      const Material& material = scene_.materials[MaterialId(i)];
      std::visit([&](const auto& kind) { check_keys(kind); }, material.kind);
      check_keys(material.common);
      if (const auto* mix = std::get_if<Mix>(&material.kind)) {
        if (mix->a.value() >= i || mix->b.value() >= i)
          complain(fmt::format("mix {} refers to a later material", i));
      }
    }
  }

  void check_shapes() {
    std::apply([&](const auto&... table) { (check_table(table), ...); }, scene_.shapes);
  }
  template <class T>
  void check_table(const Table<T>& table) {
    for (const T& shape : table) check_keys(shape);
  }

  void check_items() {
    const std::uint32_t no_proto = static_cast<std::uint32_t>(scene_.protos.size());
    check_item_list(scene_.items, no_proto);
    for (std::uint32_t i = 0; i < scene_.protos.size(); ++i)
      check_item_list(scene_.protos[ProtoId(i)].items, i);
  }
  void check_item_list(const std::vector<Item>& items, std::uint32_t owner) {
    for (const Item& item : items) {
      std::visit([&](auto id) { check_shape_reference(id, item, owner); }, item.shape);
      check_id("item.transform", item.transform, scene_.transforms.size());
      check_id("item.material", item.material, scene_.materials.size());
      if (!item.transform.valid()) complain("an item has no transform");
    }
  }
  template <class T>
  void check_shape_reference(Id<T> id, const Item& item, std::uint32_t owner) {
    if (!id.valid() || id.value() >= scene_.table<T>().size())
      return complain("an item refers to no shape");
    if constexpr (std::same_as<T, Instance>) {
      if (scene_.shape(id).of.value() >= owner)
        complain("an instance refers to its own or a later proto");
    } else {
      if (!item.material.valid()) complain(fmt::format("a {} has no material", Schema<T>::name));
    }
  }

  const Scene& scene_;
  std::vector<std::string> violations_;
};

}  // namespace

std::vector<std::string> find_violations(const Scene& scene) {
  return Verifier(scene).run();
}

}  // namespace scenec::ir
