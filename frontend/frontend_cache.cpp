#include "frontend/frontend_cache.hpp"

#include <algorithm>
#include <utility>

#include "frontend/compile.hpp"

namespace scenec::frontend {

namespace {

grammar::SyntaxTree parse(grammar::Dialect dialect, FileId file, std::string_view text,
                          DiagnosticSink& sink) {
  return dialect == grammar::Dialect::sdl ? grammar::parse_sdl(file, text, sink)
                                          : grammar::parse_course(file, text, sink);
}

// The diagnostic about the same text in another file.
Diagnostic about_file(Diagnostic diagnostic, FileId file) {
  const auto move = [&](Span& span) {
    if (span.valid()) span.file = file;
  };
  move(diagnostic.span);
  for (Label& label : diagnostic.labels) move(label.span);
  for (Note& note : diagnostic.notes) move(note.span);
  for (FixIt& fix : diagnostic.fixits) move(fix.span);
  return diagnostic;
}

std::size_t size_of(const grammar::SyntaxTree& tree, const std::vector<Diagnostic>& found) {
  constexpr std::size_t entry = 256;  // names, lists and the index
  return entry + tree.nodes().size_bytes() + tree.trivia().size() * sizeof(grammar::Trivia) +
         found.size() * (sizeof(Diagnostic) + entry);
}

}  // namespace

grammar::SyntaxTree FrontendCache::tree_of(grammar::Dialect dialect, FileId file,
                                           std::string_view text, DiagnosticSink& sink) {
  const Key key{hash_bytes(text), text.size(), dialect};
  if (const auto known = index_.find(key); known != index_.end()) {
    ++counters_.files_reused;
    entries_.splice(entries_.begin(), entries_, known->second);
    entries_.front().last_used = compilations_;
    for (const Diagnostic& diagnostic : known->second->found)
      sink.report(about_file(diagnostic, file));
    return known->second->tree.of_file(file, text);
  }
  ++counters_.files_parsed;
  DiagnosticSink parsing;
  grammar::SyntaxTree tree = parse(dialect, file, text, parsing);
  std::vector<Diagnostic> found = parsing.sorted();
  for (const Diagnostic& diagnostic : found) sink.report(diagnostic);
  const std::size_t bytes = size_of(tree, found);
  if (bytes > byte_budget_) return tree;
  forget_down_to(byte_budget_ - bytes);
  entries_.push_front({key, tree.of_file({}, {}), std::move(found), bytes, compilations_});
  index_.emplace(key, entries_.begin());
  bytes_ += bytes;
  return tree;
}

void FrontendCache::forget_down_to(std::size_t budget) {
  while (bytes_ > budget) forget_oldest();
}

void FrontendCache::forget_oldest() {
  const Entry& oldest = entries_.back();
  bytes_ -= oldest.bytes;
  index_.erase(oldest.key);
  entries_.pop_back();
  ++counters_.files_forgotten;
}

// ---- modules

std::size_t FrontendCache::module_bytes() const {
  constexpr std::size_t row = 256;  // of any table, with the maps that find it
  const ir::Scene& scene = rows_.scene();
  std::size_t rows = declaration_count_ + scene.textures.size() + scene.materials.size() +
                     scene.transforms.size() + scene.origins.size() + scene.names.size();
  for (const ir::Proto& proto : scene.protos) rows += 1 + proto.items.size();
  return rows * row;
}

void FrontendCache::begin_compilation() {
  params_.clear();
  ++compilations_;
  while (!entries_.empty() && compilations_ - entries_.back().last_used > unused_for_)
    forget_oldest();
  if (module_bytes() <= module_budget_ && !has_stale_modules()) return;
  modules_.clear();
  file_numbers_.clear();
  rows_ = ir::SceneBuilder();
  declaration_count_ = 0;
}

bool FrontendCache::has_stale_modules() const {
  constexpr std::size_t few = 256;  // counting them is not worth the while
  if (modules_.size() <= few) return false;
  const auto is_stale = [&](const auto& entry) {
    return compilations_ - entry.second.last_used > unused_for_;
  };
  const auto stale = std::count_if(modules_.begin(), modules_.end(), is_stale);
  return static_cast<std::size_t>(stale) > modules_.size() / 2;
}

std::shared_ptr<const KeptModule> FrontendCache::find_module(Hash128 key) {
  const auto found = modules_.find(key);
  if (found == modules_.end()) return nullptr;
  found->second.last_used = compilations_;
  return found->second.module;
}

void FrontendCache::keep_module(Hash128 key, KeptModule module) {
  declaration_count_ += module.declarations.size();
  modules_.insert_or_assign(
      key, ModuleEntry{std::make_shared<const KeptModule>(std::move(module)), compilations_});
}

FileId FrontendCache::file_number(Hash128 key) {
  return file_numbers_.try_emplace(key, static_cast<std::uint32_t>(file_numbers_.size()))
      .first->second;
}

grammar::SyntaxTree parsed_text(const CompileOptions& options, grammar::Dialect dialect,
                                FileId file, std::string_view text, DiagnosticSink& sink) {
  const WorkClock::Running parsing(options.clocks != nullptr ? &options.clocks->parsing : nullptr);
  if (options.cache != nullptr) return options.cache->tree_of(dialect, file, text, sink);
  return parse(dialect, file, text, sink);
}

}  // namespace scenec::frontend
