#include "ir/diff.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "ir/content_hasher.hpp"

namespace scenec::ir {
namespace {

// A part as the other side's parts are compared with.
struct Part {
  std::string_view kind;
  std::string_view name;   // empty: none
  std::string_view group;  // of a shape in a group, its name
  Hash128 hash;            // of all of it
  const void* value = nullptr;
};
using Parts = std::vector<Part>;
using KeyHashes = std::vector<std::pair<std::string_view, Hash128>>;

class Side {
 public:
  explicit Side(const Scene& scene) : scene_(scene), hasher_(scene, Reference::name) {}

  Parts shapes() {
    Parts parts;
    add_items(parts, scene_.items, {});
    for (std::uint32_t i = 0; i < scene_.protos.size(); ++i)
      add_items(parts, scene_.protos[ProtoId(i)].items,
                name_of(scene_.proto_names[ProtoId(i)].name));
    return parts;
  }
  Parts materials() { return parts_of<Material>(scene_.materials, scene_.material_names); }
  Parts lights() { return parts_of<Light>(scene_.lights, scene_.light_names); }
  Parts cameras() { return parts_of<Camera>(scene_.cameras, scene_.camera_names); }
  Parts settings() { return {{"render", {}, {}, hash_of(keys_of(scene_.render)), &scene_.render}}; }

  KeyHashes keys_of(const Item& item) {
    KeyHashes keys = std::visit([&](auto id) { return keys_of(scene_.shape(id)); }, item.shape);
    keys.emplace_back("transform", hasher_.of_value(scene_.transforms[item.transform].m));
    keys.emplace_back("material", hasher_.of_value(item.material));
    return keys;
  }
  KeyHashes keys_of(const Material& material) {
    KeyHashes keys = of_kind(material.kind);
    append(keys, keys_of(material.common));
    return keys;
  }
  KeyHashes keys_of(const Light& light) { return of_kind(light.kind); }
  KeyHashes keys_of(const Camera& camera) { return of_kind(camera.kind); }
  template <HasSchema T>
  KeyHashes keys_of(const T& fields) {
    KeyHashes keys;
    visit_keys<T>([&](const auto& key) {
      keys.emplace_back(key.name, hasher_.of_value(fields.*key.member));
    });
    return keys;
  }

 private:
  static void append(KeyHashes& keys, const KeyHashes& more) {
    keys.insert(keys.end(), more.begin(), more.end());
  }
  template <class Variant>
  KeyHashes of_kind(const Variant& kind) {
    return std::visit([&](const auto& fields) { return keys_of(fields); }, kind);
  }
  static Hash128 hash_of(const KeyHashes& keys) {
    Hasher hasher;
    for (const auto& [name, hash] : keys) hasher.add(hash);
    return hasher.result();
  }
  template <class Variant>
  static std::string_view kind_of(const Variant& kind) {
    return std::visit(
        [](const auto& fields) -> std::string_view {
          return Schema<std::remove_cvref_t<decltype(fields)>>::name;
        },
        kind);
  }
  [[nodiscard]] std::string_view name_of(NameId id) const {
    return id.valid() ? std::string_view(scene_.names[id]) : std::string_view();
  }

  void add_items(Parts& parts, const std::vector<Item>& items, std::string_view group) {
    for (const Item& item : items) {
      const std::string_view kind = std::visit(
          [&]<class T>(Id<T>) -> std::string_view { return Schema<T>::name; }, item.shape);
      parts.push_back({kind, name_of(item.name), group, hash_of(keys_of(item)), &item});
    }
  }
  template <class T, class Values, class Names>
  Parts parts_of(const Values& values, const Names& names) {
    Parts parts;
    for (std::uint32_t i = 0; i < values.size(); ++i) {
      const T& value = values[Id<T>(i)];
      parts.push_back({kind_of(value.kind),
                       name_of(names[Id<T>(i)].name),
                       {},
                       hash_of(keys_of(value)),
                       &value});
    }
    return parts;
  }

  const Scene& scene_;
  ContentHasher hasher_;
};

// Two parts are the same one when all of this is equal; of those without a name the kind decides.
using Identity = std::tuple<std::string_view, std::string_view, std::string_view>;
Identity identity_of(const Part& part) {
  return {part.group, part.name, part.name.empty() ? part.kind : std::string_view()};
}

// Takes out what both sides have.
void drop_equal(Parts& before, Parts& after) {
  const auto key = [](const Part& part) {
    Hasher hasher;
    hasher.add(part.group);
    hasher.add(part.name);
    hasher.add(part.kind);
    hasher.add(part.hash);
    return hasher.result();
  };
  std::unordered_map<Hash128, std::size_t> counts;
  for (const Part& part : before) ++counts[key(part)];
  std::unordered_map<Hash128, std::size_t> equal;
  std::erase_if(after, [&](const Part& part) {
    const auto found = counts.find(key(part));
    if (found == counts.end() || found->second == 0) return false;
    --found->second;
    ++equal[found->first];
    return true;
  });
  std::erase_if(before, [&](const Part& part) {
    const auto found = equal.find(key(part));
    if (found == equal.end() || found->second == 0) return false;
    --found->second;
    return true;
  });
}

std::vector<std::string> different_keys(const KeyHashes& before, const KeyHashes& after) {
  std::vector<std::string> keys;
  for (const auto& [name, hash] : after) {
    const auto old = std::find_if(before.begin(), before.end(),
                                  [&](const auto& entry) { return entry.first == name; });
    if (old == before.end() || old->second != hash) keys.emplace_back(name);
  }
  return keys;
}

class Comparison {
 public:
  Comparison(const Scene& before, const Scene& after) : before_(before), after_(after) {}

  std::vector<PartChange> run() {
    compare<Item>("shape", &Side::shapes);
    compare<Material>("material", &Side::materials);
    compare<Light>("light", &Side::lights);
    compare<Camera>("camera", &Side::cameras);
    compare<RenderSettings>("render", &Side::settings);
    return std::move(changes_);
  }

 private:
  template <class T>
  void compare(std::string_view family, Parts (Side::*parts)()) {
    Parts before = (before_.*parts)();
    Parts after = (after_.*parts)();
    drop_equal(before, after);
    std::map<Identity, std::vector<const Part*>> old;
    for (const Part& part : before) old[identity_of(part)].push_back(&part);
    std::map<Identity, std::size_t> taken;
    for (const Part& part : after) {
      const auto found = old.find(identity_of(part));
      std::size_t& next = taken[identity_of(part)];
      if (found == old.end() || next == found->second.size()) {
        add(PartChange::What::added, family, part, {});
        continue;
      }
      const Part& was = *found->second[next++];
      std::vector<std::string> keys{"kind"};
      if (was.kind == part.kind)
        keys = different_keys(before_.keys_of(*static_cast<const T*>(was.value)),
                              after_.keys_of(*static_cast<const T*>(part.value)));
      add(PartChange::What::changed, family, part, std::move(keys));
    }
    for (const auto& [identity, list] : old) {
      for (std::size_t i = taken[identity]; i < list.size(); ++i)
        add(PartChange::What::removed, family, *list[i], {});
    }
  }

  void add(PartChange::What what, std::string_view family, const Part& part,
           std::vector<std::string> keys) {
    std::string name(part.name);
    if (!part.group.empty() && !name.empty()) name = std::string(part.group) + "/" + name;
    auto& place = places_[{what, std::string(family), std::string(part.kind), name, keys}];
    if (place == 0) {
      changes_.push_back(
          {what, std::string(family), std::string(part.kind), name, 1, std::move(keys)});
      place = changes_.size();
    } else {
      ++changes_[place - 1].count;
    }
  }

  Side before_;
  Side after_;
  std::vector<PartChange> changes_;
  std::map<
      std::tuple<PartChange::What, std::string, std::string, std::string, std::vector<std::string>>,
      std::size_t>
      places_;  // one behind the index of those alike
};

}  // namespace

std::vector<PartChange> changes_between(const Scene& before, const Scene& after) {
  return Comparison(before, after).run();
}

}  // namespace scenec::ir
