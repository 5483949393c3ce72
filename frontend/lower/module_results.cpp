// What included files declare, kept from one compilation to the next: see frontend_cache.hpp. A
// module depends on its text and on what it includes, and on nothing else: its params are their
// defaults, and what reads assets is not kept.
#include <algorithm>
#include <functional>

#include "frontend/ast/sdl_ast.hpp"
#include "frontend/eval/evaluate.hpp"
#include "frontend/lower/lowering.hpp"
#include "frontend/lower/modules.hpp"

namespace scenec::frontend {

using grammar::NodeRef;
using grammar::SyntaxKind;

namespace {

// Whether the text could name a file: by calling `image`, or by placing a mesh in a proto.
bool mentions_assets(const grammar::SyntaxTree& tree) {
  const auto nodes = tree.nodes();
  return std::any_of(nodes.begin(), nodes.end(), [&](const grammar::SyntaxNode& node) {
    if (node.kind != SyntaxKind::name) return false;
    const std::string_view word = tree.text().substr(node.begin, node.end - node.begin);
    return word == "image" || word == ir::Schema<ir::Mesh>::name;
  });
}

template <class F>
void for_each_include(const grammar::SyntaxTree& tree, F&& f) {
  for (NodeRef item : tree.root().children()) {
    if (!item.is(SyntaxKind::include)) continue;
    if (const NodeRef path = item.find_child(SyntaxKind::string)) f(path);
  }
}

std::function<FileId(FileId)> looked_up_in(const std::map<FileId, FileId>& files) {
  return [&files](FileId file) {
    const auto found = files.find(file);
    return found == files.end() ? FileId{} : found->second;
  };
}

}  // namespace

Modules::Traces Modules::traces() const {
  return {session_.sink.error_count() + session_.sink.warning_count(), lowering_.lint_count(),
          false};
}

Modules::Module* Modules::find_included(NodeRef path) {
  const auto found = modules_.find(place_of(decoded_string(path.text()), path.span().file));
  return found == modules_.end() ? nullptr : &found->second;
}

void Modules::evaluate(Module& module, const Traces& before) {
  const bool emission = lowering_.exchange_emission(false);
  auto scope = std::make_shared<Scope>();
  lowering_.declare_all(*module.tree, *scope);
  module.scope = std::move(scope);
  if (session_.options.cache != nullptr) {
    session_.options.cache->count_module(false);
    module.kept = keep(module, before);
  }
  lowering_.exchange_emission(lowering_.exchange_emission(false) || emission);
}

bool Modules::reuse(Module& module) {
  FrontendCache* const cache = session_.options.cache;
  const auto kept = cache == nullptr ? nullptr : cache->find_module(module.key);
  if (kept == nullptr) return false;
  std::vector<std::shared_ptr<Scope>> included;
  for (const KeptModule::Include& include : kept->includes) {
    const NodeRef path(module.tree.get(), include.node);
    included.push_back(load(decoded_string(path.text()), path));
    const Module* const found = find_included(path);
    if (included.back() == nullptr || found == nullptr || found->content != include.content)
      return false;
  }
  const FileId file = module.tree->file();
  const FileId number = cache->file_number(module.key);
  kept_files_[file] = number;
  here_files_[number] = file;
  const auto file_of = looked_up_in(here_files_);
  SceneCopy copy({cache->rows().scene(), session_.builder, here_of_kept_, kept_of_here_, file_of});
  auto scope = std::make_shared<Scope>();
  std::size_t next_include = 0;
  for (const KeptModule::Declaration& one : kept->declarations) {
    Binding binding{.name = module.tree->text().substr(one.begin, one.end - one.begin),
                    .span = {file, one.begin, one.end},
                    .kind = one.kind,
                    .value = copy(one.value),
                    .node = one.node == 0 ? NodeRef{} : NodeRef(module.tree.get(), one.node)};
    binding.lint_unused = one.lint_unused;
    const Binding& added = scope->add(std::move(binding));
    if (one.kind == BindingKind::name_space)
      scope->add_name_space(added.name, included[next_include++]);
  }
  if (!copy.sound()) return false;
  module.scope = std::move(scope);
  module.content = kept->content;
  module.kept = true;
  if (kept->emission) lowering_.exchange_emission(true);
  cache->count_module(true);
  return true;
}

bool Modules::keep(Module& module, const Traces& before) {
  FrontendCache& cache = *session_.options.cache;
  KeptModule kept;
  Hasher content;
  content.add(module.key);
  bool complete = !mentions_assets(*module.tree);
  for_each_include(*module.tree, [&](NodeRef path) {
    const Module* const found = find_included(path);
    complete = complete && found != nullptr && found->kept;
    if (found == nullptr) return;
    content.add(found->content);
    kept.includes.push_back({path.index(), found->content});
  });
  module.content = kept.content = content.result();
  const Traces now = traces();
  const bool silent = now.diagnostics == before.diagnostics && now.lints == before.lints;
  // A lint that is allowed round this include may not be round another.
  const auto kinds = all_diagnostic_kinds();
  const bool allowing =
      std::any_of(kinds.begin(), kinds.end(),
                  [&](const DiagnosticKindInfo& info) { return session_.is_allowed(info.kind); });
  if (!complete || !silent || allowing) return false;
  const FileId number = cache.file_number(module.key);
  kept_files_[module.tree->file()] = number;
  here_files_[number] = module.tree->file();
  kept.emission = lowering_.exchange_emission(false);
  lowering_.exchange_emission(kept.emission);
  if (!keep_scope(module, kept)) return false;
  cache.keep_module(module.key, std::move(kept));
  return true;
}

bool Modules::keep_scope(Module& module, KeptModule& kept) {
  const auto file_of = looked_up_in(kept_files_);
  SceneCopy copy({session_.builder.scene(), session_.options.cache->rows(), kept_of_here_,
                  here_of_kept_, file_of});
  for (const Binding& binding : module.scope->bindings()) {
    if (binding.value.is(Type::proto) && binding.value.known &&
        lowering_.has_gaps(binding.value.id<ir::Proto>()))
      return false;
    kept.declarations.push_back({.begin = binding.span.begin,
                                 .end = binding.span.end,
                                 .kind = binding.kind,
                                 .lint_unused = binding.lint_unused,
                                 .node = binding.node ? binding.node.index() : 0,
                                 .value = copy(binding.value)});
  }
  return copy.sound();
}

}  // namespace scenec::frontend
