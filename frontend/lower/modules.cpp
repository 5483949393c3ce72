#include "frontend/lower/modules.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "frontend/lower/lowering.hpp"
#include "grammar/parse.hpp"

namespace scenec::frontend {

using grammar::NodeRef;
using grammar::SyntaxKind;

namespace {
constexpr std::size_t max_include_depth = 64;
constexpr std::size_t max_include_files = 4096;
constexpr std::uint64_t max_include_bytes = std::uint64_t{512} << 20;
constexpr std::string_view library_prefix = "std:";
}  // namespace

std::unique_ptr<grammar::SyntaxTree> Modules::read(const std::string& path, NodeRef use) {
  auto content = session_.files.read(path, max_include_bytes);
  if (!content) {
    session_.error(
        DiagnosticKind::file_unreadable, use.span(),
        fmt::format("cannot read {}: {}", quoted_string(path), text_of(content.error())));
    return nullptr;
  }
  const std::string_view text = content.value().bytes;
  const FileId file = session_.sources.add(path, text, content.value().owner);
  return std::make_unique<grammar::SyntaxTree>(grammar::parse_sdl(file, text, session_.sink));
}

std::shared_ptr<Scope> Modules::load(const std::string& written, NodeRef use) {
  const bool library = written.starts_with(library_prefix);
  const std::string path = library ? written : session_.resolved_path(written, use.span().file);
  const auto [place, added] = modules_.try_emplace(path);
  Module& module = place->second;
  if (!added) {
    if (module.loading)
      session_.error(DiagnosticKind::recursive_call, use.span(),
                     fmt::format("{} includes itself", quoted_string(path)));
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
  module.tree = read(path, use);
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

NodeRef Modules::parse_setting(const ParamSetting& setting) {
  auto& tree = settings_[setting.name];
  const std::size_t before = session_.sink.error_count();
  const FileId file = session_.sources.add("-D " + printable(setting.name),
                                           fmt::format("sdl 1;\nlet value = {};\n", setting.value));
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
