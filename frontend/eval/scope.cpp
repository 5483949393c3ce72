#include "frontend/eval/scope.hpp"

namespace scenec::frontend {

namespace {
// Up to here looking through the names is faster than hashing them.
constexpr std::size_t max_unindexed = 8;

bool is_visible(const Binding& binding, Span use) {
  return binding.span.file != use.file || binding.span.begin < use.begin;
}
}  // namespace

std::string_view text_of(BindingKind kind) {
  switch (kind) {
    case BindingKind::let:
      return "let";
    case BindingKind::param:
      return "param";
    case BindingKind::loop_variable:
      return "loop variable";
    case BindingKind::parameter:
      return "parameter";
    case BindingKind::material:
      return "material";
    case BindingKind::proto:
      return "proto";
    case BindingKind::function:
      return "function";
    case BindingKind::macro:
      return "macro";
    case BindingKind::name_space:
      return "namespace";
  }
  return "name";
}

Binding* Scope::find_here(std::string_view name) {
  if (bindings_.size() > max_unindexed) {
    const auto place = extras_->index.find(name);
    return place == extras_->index.end() ? nullptr : &bindings_[place->second];
  }
  for (Binding& binding : bindings_) {
    // Most names differ in their length or first letter; a comparison of the rest is a call.
    const bool alike =
        binding.name.size() == name.size() && !name.empty() && binding.name.front() == name.front();
    if (alike && binding.name == name) return &binding;
  }
  return nullptr;
}

Scope::Found Scope::find(std::string_view name, Span use) {
  for (Scope* scope = this; scope != nullptr; scope = scope->parent_) {
    Binding* binding = scope->find_here(name);
    if (binding != nullptr && is_visible(*binding, use)) return {binding, scope};
  }
  return {};
}

Scope::Extras& Scope::extras() {
  if (extras_ == nullptr) extras_ = std::make_unique<Extras>();
  return *extras_;
}

Binding& Scope::add(Binding binding) {
  bindings_.push_back(std::move(binding));
  if (bindings_.size() > max_unindexed) {
    auto& index = extras().index;
    for (std::size_t i = index.size(); i < bindings_.size(); ++i)
      index.emplace(bindings_[i].name, static_cast<std::uint32_t>(i));
  }
  return bindings_.back();
}

std::vector<std::string_view> Scope::visible_names(Span use) const {
  std::vector<std::string_view> names;
  for (const Scope* scope = this; scope != nullptr; scope = scope->parent_) {
    for (const Binding& binding : scope->bindings_) {
      if (is_visible(binding, use)) names.push_back(binding.name);
    }
  }
  return names;
}

const std::shared_ptr<Scope>& Scope::name_space(std::string_view name) const {
  static const std::shared_ptr<Scope> none;
  if (extras_ == nullptr) return none;
  const auto place = extras_->name_spaces.find(name);
  return place == extras_->name_spaces.end() ? none : place->second;
}

void Scope::add_name_space(std::string_view name, std::shared_ptr<Scope> scope) {
  extras().name_spaces.emplace(name, std::move(scope));
}

}  // namespace scenec::frontend
