// What all phases of one compilation share: files, sources, diagnostics, the builder, and the
// budget. One per call of `compile`; never global.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "base/diagnostic.hpp"
#include "base/file_system.hpp"
#include "base/source_map.hpp"
#include "base/stack_guard.hpp"
#include "frontend/compile.hpp"
#include "frontend/eval/value.hpp"
#include "ir/builder.hpp"

namespace scenec::frontend {

inline constexpr std::size_t max_list_elements = 2'000'000;
inline constexpr std::size_t max_string_bytes = std::size_t{1} << 20;
inline constexpr std::uint64_t max_asset_bytes = std::uint64_t{2} << 30;
// An element holds a cache line of memory, a round of a loop makes a scope, a call binds arguments
// besides.
inline constexpr std::uint64_t steps_per_list_element = 64;
inline constexpr std::uint64_t steps_per_scope = 32;
inline constexpr std::uint64_t steps_per_call = 384;
inline constexpr std::size_t max_call_depth = 512;

class Session {
 public:
  Session(const CompileOptions& compile_options, FileSystem& file_system, SourceMap& source_map,
          DiagnosticSink& diagnostic_sink);

  const CompileOptions& options;
  FileSystem& files;
  SourceMap& sources;
  DiagnosticSink& sink;
  ir::SceneBuilder builder;

  // Bodies are being checked, not run: values are types only, nothing is built.
  [[nodiscard]] bool checking_only() const { return checking_ > 0; }
  struct CheckOnly {
    explicit CheckOnly(Session& owner) : session(owner) { ++session.checking_; }
    ~CheckOnly() { --session.checking_; }
    CheckOnly(const CheckOnly&) = delete;
    CheckOnly& operator=(const CheckOnly&) = delete;
    Session& session;
  };

  // Inside a loop, function or macro that is being run: its body has been checked already.
  [[nodiscard]] bool running() const { return running_ > 0 || !expansions_.empty(); }
  struct Running {
    explicit Running(Session& owner) : session(owner) { ++session.running_; }
    ~Running() { --session.running_; }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;
    Session& session;
  };

  // ---- diagnostics
  void report(Diagnostic diagnostic);  // adds "expanded from" notes
  // Reports and gives the poison value.
  Value error(DiagnosticKind kind, Span span, std::string message);
  Value error(Diagnostic diagnostic);
  // Reports unless an `@allow` of an item around it names the lint.
  void lint(Diagnostic diagnostic);
  [[nodiscard]] bool is_allowed(DiagnosticKind kind) const;
  // A lint about something placed, found when all is placed: reports it at its head and with the
  // calls that led there, unless an `@allow` round it names the lint. Of very many the rest is
  // lost.
  void lint_item(Diagnostic diagnostic, ir::OriginId origin);
  // The words before the block of what was placed there; of a library's items the author's call.
  [[nodiscard]] Span head_of(ir::OriginId origin) const;

  // The lints allowed for an item and what is inside it.
  struct Allowing {
    Allowing(Session& owner, std::span<const DiagnosticKind> kinds)
        : session(owner), before(owner.allowed_.size()) {
      session.allowed_.insert(session.allowed_.end(), kinds.begin(), kinds.end());
    }
    ~Allowing() { session.allowed_.resize(before); }
    Allowing(const Allowing&) = delete;
    Allowing& operator=(const Allowing&) = delete;
    Session& session;
    std::size_t before;
  };

  // One step outwards from expanded text: the call of `name` at `span`.
  enum class Callee : std::uint8_t { macro, function };
  struct Expanding {
    Expanding(Session& owner, Callee kind, std::string_view name, Span span);
    ~Expanding();
    Expanding(const Expanding&) = delete;
    Expanding& operator=(const Expanding&) = delete;
    Session& session;
    ir::OriginId before;
  };
  [[nodiscard]] bool expanding() const { return !expansions_.empty(); }
  [[nodiscard]] ir::OriginId add_origin(Span span);
  // `file` is a text that an include at `use` brought in.
  void note_include(FileId file, Span use) { includes_.try_emplace(file.value(), use); }

  // What is evaluated now reports nothing: it will be evaluated again.
  struct Muted {
    explicit Muted(Session& owner) : session(owner) { ++session.muted_; }
    ~Muted() { --session.muted_; }
    Muted(const Muted&) = delete;
    Muted& operator=(const Muted&) = delete;
    Session& session;
  };

  // ---- budgets
  // False when the budget is used up (reported once); loops then end.
  bool spend(std::uint64_t steps, Span where) {
    steps_ += steps;
    return steps_ <= options.limits.steps || exhausted(where);
  }
  [[nodiscard]] bool out_of_steps() const { return steps_ > options.limits.steps; }
  // What is about to be run takes at least that many items and steps; false (reported once at
  // `where`) when the budgets cannot pay for it. Nothing is placed from then on.
  bool affords(std::uint64_t items, std::uint64_t steps, Span where);
  // False (reported at `where`) when calls or blocks nest deeper than can be followed.
  bool deep_enough(std::size_t calls, Span where);
  // Counts a placed item or light; false when there are too many (reported once).
  bool count_item(Span where);
  [[nodiscard]] std::uint64_t item_count() const { return items_; }

  // ---- files
  // The asset a path written in `file` names; invalid (reported at `span`) when it cannot be read.
  ir::AssetId asset(std::string_view path, FileId file, Span span);
  // Says at `span` why the file could not be read.
  void unreadable(const std::string& path, FileError reason, Span span);
  // `path` as the file system opens it, seen from the file that names it.
  [[nodiscard]] std::string resolved_path(std::string_view path, FileId file) const;

 private:
  bool exhausted(Span where);
  [[nodiscard]] ir::OriginId shared_origin(const ir::Origin& origin);
  void add_trail(Diagnostic& diagnostic) const;
  [[nodiscard]] bool in_library(Span span) const;

  struct Expansion {
    Callee kind;
    std::string_view name;
    Span span;
  };
  int checking_ = 0;
  int muted_ = 0;
  int running_ = 0;
  std::vector<DiagnosticKind> allowed_;
  std::vector<Expansion> expansions_;
  ir::OriginId expansion_origin_;
  // Origins made lately: the rounds of a loop have theirs in common.
  struct RecentOrigin {
    ir::Origin origin;
    ir::OriginId id;
  };
  std::array<RecentOrigin, 64> recent_origins_{};
  std::unordered_map<std::uint32_t, std::vector<DiagnosticKind>> allowed_at_;  // by origin
  std::size_t item_lints_ = 0;
  std::uint64_t steps_ = 0;
  std::uint64_t items_ = 0;
  bool exhaustion_reported_ = false;
  StackGuard stack_;
  std::unordered_map<std::uint32_t, Span> includes_;  // by file: the first include that names it
  std::unordered_map<std::string, ir::AssetId> assets_;
};

// A diagnostic about a name nobody knows: "did you mean" and the legal names.
[[nodiscard]] Diagnostic unknown_word(DiagnosticKind kind, Span span, std::string message,
                                      std::string_view word,
                                      std::span<const std::string_view> legal,
                                      std::string_view legal_title);

}  // namespace scenec::frontend
