#include "frontend/lower/modules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/text.hpp"
#include "frontend/frontend_cache.hpp"
#include "frontend/lower/lowering.hpp"
#include "frontend/lower/std_library.hpp"
#include "grammar/parse.hpp"

namespace scenec::frontend {

using grammar::NodeRef;
using grammar::SyntaxKind;

Modules::Modules(Lowering& lowering, Session& session) : lowering_(lowering), session_(session) {
  if (session.options.cache != nullptr) session.options.cache->begin_compilation();
}

void Modules::open_scene(FileId file, FileIdentity identity) {
  open_.push_back({std::string(session_.sources.path(file)), identity, {}});
  source_bytes_ = session_.sources.text(file).size();
}

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

bool Modules::parse(FileId file, std::string_view text, NodeRef use, Module& module) {
  session_.note_include(file, use.span());
  source_bytes_ += text.size();
  const std::uint64_t most = session_.options.limits.source_bytes;
  if (source_bytes_ > most) {
    session_.error(
        Diagnostic(DiagnosticKind::text_too_long, use.span(),
                   fmt::format("the scene and what it includes have more than {} bytes", most))
            .hint(sets_the_limit(limit_option::source_bytes)));
    return false;
  }
  DiagnosticSink found;  // told with the way to the file
  module.tree = std::make_unique<grammar::SyntaxTree>(
      parsed_text(session_.options, grammar::Dialect::sdl, file, text, found));
  for (Diagnostic& diagnostic : found.sorted()) session_.report(std::move(diagnostic));
  Hasher hasher;
  hasher.add(session_.sources.path(file));
  hasher.add(text);
  module.key = hasher.result();
  return true;
}

bool Modules::read_library(const std::string& path, NodeRef use, Module& module) {
  const std::optional<std::string_view> text = find_library(path);
  if (!text) {
    std::string_view name = path;
    if (name.ends_with(library_extension)) name.remove_suffix(library_extension.size());
    const std::vector<std::string> names = library_names();
    const std::vector<std::string_view> legal(names.begin(), names.end());
    session_.error(unknown_word(DiagnosticKind::unknown_library, use.span(),
                                fmt::format("there is no library {}", quoted_string(name)), name,
                                legal, "libraries"));
    return false;
  }
  if (is_cycle(path, {}, use)) return false;
  const FileId file = session_.sources.add(path, *text, nullptr);
  library_texts_.insert(file);
  open_.push_back({path, {}, use.span()});
  return parse(file, *text, use, module);
}

bool Modules::read(const Place& place, NodeRef use, Module& module) {
  if (place.in_library) return read_library(place.path, use, module);
  auto content = session_.files.read(place.path, grammar::ParseLimits{}.file);
  if (!content) {
    session_.unreadable(place.path, content.error(), use.span());
    return false;
  }
  if (is_cycle(place.path, content.value().identity, use)) return false;
  const std::string_view text = content.value().bytes;
  const FileId file = session_.sources.add(place.path, text, content.value().owner);
  open_.push_back({place.path, content.value().identity, use.span()});
  return parse(file, text, use, module);
}

bool Modules::is_cycle(const std::string& path, FileIdentity identity, NodeRef use) {
  const auto is_same = [&](const Open& open) {
    return open.path == path || (identity.valid() && open.identity == identity);
  };
  const auto first = std::find_if(open_.begin(), open_.end(), is_same);
  if (first == open_.end()) return false;
  Diagnostic diagnostic(DiagnosticKind::recursive_call, use.span(),
                        fmt::format("{} includes itself", quoted_string(first->path)));
  if (first->path != path)
    diagnostic.notes.push_back({fmt::format("{} is the same file", quoted_string(path)), {}});
  for (auto step = first + 1; step != open_.end(); ++step) {
    diagnostic.notes.push_back({fmt::format("{} includes {} here", quoted_string((step - 1)->path),
                                            quoted_string(step->path)),
                                step->use});
  }
  session_.error(std::move(diagnostic));
  return true;
}

bool Modules::check_limits(NodeRef use) {
  const Limits& limits = session_.options.limits;
  const auto exceeded = [&](std::string message, std::string_view option) {
    session_.error(Diagnostic(DiagnosticKind::too_many_includes, use.span(), std::move(message))
                       .hint(sets_the_limit(option)));
    return false;
  };
  if (open_.size() > limits.include_depth) {
    return exceeded(fmt::format("includes are nested deeper than {}", limits.include_depth),
                    limit_option::include_depth);
  }
  if (modules_.size() > limits.include_files) {
    return exceeded(fmt::format("there are more than {} included files", limits.include_files),
                    limit_option::include_files);
  }
  return true;
}

std::shared_ptr<Scope> Modules::load(const std::string& written, NodeRef use) {
  const Place place = place_of(written, use.span().file);
  if (const auto known = modules_.find(place); known != modules_.end()) {
    static_cast<void>(is_cycle(place.path, {}, use));
    return known->second.scope;
  }
  Module& module = modules_[place];
  if (!check_limits(use)) return nullptr;
  const std::size_t depth = open_.size();
  const Traces before = traces();
  if (read(place, use, module) && !reuse(module)) evaluate(module, before);
  open_.resize(depth);
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
