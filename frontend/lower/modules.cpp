#include "frontend/lower/modules.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "base/text.hpp"
#include "frontend/lower/lowering.hpp"
#include "frontend/lower/std_library.hpp"
#include "grammar/parse.hpp"

namespace scenec::frontend {

using grammar::NodeRef;
using grammar::SyntaxKind;

namespace {
constexpr std::size_t max_include_depth = 64;
constexpr std::size_t max_include_files = 4096;
constexpr std::uint64_t max_include_bytes = std::uint64_t{512} << 20;
}  // namespace

Modules::Place Modules::place_of(const std::string& written, FileId from) const {
  const bool from_library = library_texts_.contains(from);
  if (!from_library && !written.starts_with(library_prefix)) {
    return {false, session_.resolved_path(written, from)};
  }
  // The extension belongs to the name of a file, which a relative include gives.
  std::string path = written;
  if (!written.starts_with(library_prefix)) {
    path = std::string(library_prefix) + normalized_path(written);
  } else if (!written.ends_with(library_extension)) {
    path += library_extension;
  }
  return {true, std::move(path)};
}

std::unique_ptr<grammar::SyntaxTree> Modules::read_library(const std::string& path, NodeRef use) {
  const std::optional<std::string_view> text = find_library(path);
  if (!text) {
    std::string_view name = path;
    if (name.ends_with(library_extension)) name.remove_suffix(library_extension.size());
    const std::vector<std::string> names = library_names();
    const std::vector<std::string_view> legal(names.begin(), names.end());
    session_.error(unknown_word(DiagnosticKind::unknown_library, use.span(),
                                fmt::format("there is no library {}", quoted_string(name)), name,
                                legal, "libraries"));
    return nullptr;
  }
  const FileId file = session_.sources.add(path, *text, nullptr);
  library_texts_.insert(file);
  return std::make_unique<grammar::SyntaxTree>(grammar::parse_sdl(file, *text, session_.sink));
}

std::unique_ptr<grammar::SyntaxTree> Modules::read(const Place& place, NodeRef use) {
  if (place.in_library) return read_library(place.path, use);
  auto content = session_.files.read(place.path, max_include_bytes);
  if (!content) {
    session_.unreadable(place.path, content.error(), use.span());
    return nullptr;
  }
  const std::string_view text = content.value().bytes;
  const FileId file = session_.sources.add(place.path, text, content.value().owner);
  return std::make_unique<grammar::SyntaxTree>(grammar::parse_sdl(file, text, session_.sink));
}

std::shared_ptr<Scope> Modules::load(const std::string& written, NodeRef use) {
  const Place place = place_of(written, use.span().file);
  const auto [entry, added] = modules_.try_emplace(place);
  Module& module = entry->second;
  if (!added) {
    if (module.loading)
      session_.error(DiagnosticKind::recursive_call, use.span(),
                     fmt::format("{} includes itself", quoted_string(place.path)));
    return module.loading ? nullptr : module.scope;
  }
  if (open_.size() >= max_include_depth || modules_.size() > max_include_files) {
    const bool deep = open_.size() >= max_include_depth;
    session_.error(DiagnosticKind::too_many_includes, use.span(),
                   deep ? fmt::format("includes are nested deeper than {}", max_include_depth)
                        : fmt::format("there are more than {} included files", max_include_files));
    module.loading = false;
    return nullptr;
  }
  module.tree = read(place, use);
  if (module.tree == nullptr) {
    module.loading = false;
    return nullptr;
  }
  open_.push_back(use.span());
  module.scope = std::make_shared<Scope>();
  lowering_.declare_all(*module.tree, *module.scope);
  open_.pop_back();
  module.loading = false;
  return module.scope;
}

NodeRef Modules::parse_setting(const ParamSetting& setting, const std::string& text) {
  auto& tree = settings_[setting.name];
  const std::size_t before = session_.sink.error_count();
  const FileId file = session_.sources.add(setting.source + " " + printable(setting.name),
                                           fmt::format("sdl 1;\nlet value = {};\n", text));
  tree = std::make_unique<grammar::SyntaxTree>(
      grammar::parse_sdl(file, session_.sources.text(file), session_.sink));
  const NodeRef expression = setting_expression(setting.name);
  if (session_.sink.error_count() > before) return {};
  // More than one expression (`-D n="1; sphere {}"`) leaves more than one item.
  std::size_t items = 0;
  for (NodeRef child : tree->root().children()) items += child.is(SyntaxKind::edition) ? 0u : 1u;
  if (items == 1 && expression) return expression;
  session_.error(DiagnosticKind::param_setting, tree->root().span(),
                 fmt::format("the value of `{}` is not one expression", printable(setting.name)));
  return {};
}

NodeRef Modules::setting_expression(std::string_view name) const {
  const auto place = settings_.find(name);
  if (place == settings_.end() || place->second == nullptr) return {};
  const NodeRef let = place->second->root().find_child(SyntaxKind::let);
  return let ? ast::expression_of(let) : NodeRef{};
}

}  // namespace scenec::frontend
