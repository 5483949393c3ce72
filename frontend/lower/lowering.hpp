// Items to IR: one walk over the tree, declaring names, placing shapes, running loops and macros.
// Bodies are checked with types only where they are written, then run.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "frontend/ast/sdl_ast.hpp"
#include "frontend/check/check_block.hpp"
#include "frontend/check/fields.hpp"
#include "frontend/eval/evaluate.hpp"
#include "frontend/lower/item_bound.hpp"
#include "frontend/lower/placement.hpp"
#include "frontend/lower/proto_gaps.hpp"
#include "frontend/part_reader.hpp"
#include "frontend/session.hpp"
#include "grammar/syntax_tree.hpp"

namespace scenec::frontend {

// The included files of one compilation, each loaded once.
class Modules;

// What the walk has met, for the rules between entities.
struct SceneNotes {
  Span first_placed;  // shape or light; invalid: none
  Span first_camera;  // also one that has mistakes
  Span second_camera;
  Span render;                  // kind of the `render` block; invalid: none
  grammar::NodeRef camera_key;  // expression of `camera` in it
  Span first_bare;              // shape without a material
  std::size_t bare_count = 0;
  bool light = false;
  bool emission = false;
  bool is_empty = true;  // no item in the file
};

class Lowering final : public FieldCollector {
 public:
  explicit Lowering(Session& session);
  ~Lowering();
  Lowering(const Lowering&) = delete;
  Lowering& operator=(const Lowering&) = delete;

  // The file given on the command line.
  void lower_scene(TreeSource& trees, FileId file, FileIdentity identity);
  // An included file: declares its names in `scope`; what it places is only checked.
  void declare_all(const grammar::SyntaxTree& tree, Scope& scope);
  [[nodiscard]] const SceneNotes& notes() const { return notes_; }
  [[nodiscard]] ir::RenderSettings& render() { return render_; }
  [[nodiscard]] ir::OriginId render_origin() const { return render_origin_; }

  // What evaluating a module leaves behind besides its scope.
  [[nodiscard]] std::size_t lint_count() const { return unused_.size(); }
  [[nodiscard]] bool has_gaps(ir::ProtoId proto) const { return proto_gaps_.any(proto); }
  bool exchange_emission(bool emission) { return std::exchange(notes_.emission, emission); }

  void collect(grammar::NodeRef block, Scope& scope, Fields& fields) override;

 private:
  using NodeRef = grammar::NodeRef;
  enum class Pass : std::uint8_t { all, declarations, placements };

  void items(NodeRef block, Scope& scope, const Surroundings& around, Pass pass = Pass::all);
  void item(NodeRef node, Scope& scope, const Surroundings& around);
  void item_unannotated(NodeRef node, Scope& scope, const Surroundings& around);
  [[nodiscard]] std::vector<DiagnosticKind> allowed_lints(NodeRef node);
  void check_annotation(NodeRef annotation, NodeRef node, std::vector<DiagnosticKind>& allowed);

  // declarations
  void declare_let(NodeRef node, Scope& scope);
  void declare_param(NodeRef node, Scope& scope);
  void declare_function(NodeRef node, Scope& scope, BindingKind kind);
  void declare_proto(NodeRef node, Scope& scope, const Surroundings& around);
  void declare_material(NodeRef node, Scope& scope);
  void include(NodeRef node, Scope& scope);
  void declare(Scope& scope, NodeRef name, BindingKind kind, Value value, NodeRef node);
  void close(Scope& scope);
  [[nodiscard]] std::optional<Value> param_setting(std::string_view name, const TypeRef& type);
  void report_unknown_settings(Scope& scope);
  // The value of the `@clock` param `node` in the frame asked for, if one is.
  [[nodiscard]] std::optional<Value> clock_setting(NodeRef node, Scope& scope);
  [[nodiscard]] Value clock_in_frame(const ast::Item& parts, const Frame& frame, Scope& scope);
  void report_missing_clock(Scope& scope);
  // What the tree says apart from its items; whether something will refer to its nodes.
  [[nodiscard]] bool take_notes(const grammar::SyntaxTree& tree);

  // placed things
  void shape(NodeRef node, Scope& scope, const Surroundings& around);
  void instance(NodeRef node, Scope& scope, const Surroundings& around);
  void group(NodeRef node, Scope& scope, const Surroundings& around);
  void light(NodeRef node, Scope& scope, const Surroundings& around);
  void camera(NodeRef node, Scope& scope, const Surroundings& around);
  void render_block(NodeRef node, Scope& scope);
  template <class T>
  void place(const ast::Item& parts, NodeRef node, Scope& scope, const Surroundings& around);
  // The keys of a block into `first`, whose schema names the block, and the `rest`. Then
  // `checked(checker)`, when all is right and values are known. False: something is wrong
  // (reported).
  template <class Checked, class First, class... Rest>
  bool read_block(NodeRef block, Span head, Scope& scope, const Checked& checked, First& first,
                  Rest&... rest);
  template <class T>
  void read_light(const ast::Item& parts, NodeRef node, Scope& scope, const Surroundings& around);
  template <class T>
  void read_camera(const ast::Item& parts, NodeRef node, Scope& scope, const Surroundings& around);
  template <class T>
  void read_material(const ast::Item& parts, NodeRef node, Scope& scope, Value& value);
  // What a shape or instance without a material takes: its group's, or the default one.
  template <class T>
  void fill_material(T& shape, ir::Item& item, const Surroundings& around, Span span);
  [[nodiscard]] ir::MaterialId default_material();
  void note_gap(const Surroundings& around, Span lint);
  [[nodiscard]] ir::TransformId transform_for(const std::optional<ir::Transform>& own,
                                              const Surroundings& around, Span span);
  void misplaced(NodeRef node, std::string_view where);

  // control
  void for_loop(NodeRef node, Scope& scope, const Surroundings& around);
  void if_chain(NodeRef node, Scope& scope, const Surroundings& around);
  void assertion(NodeRef node, Scope& scope);
  void macro_call(NodeRef node, Scope& scope, const Surroundings& around);
  [[nodiscard]] bool affordable(NodeRef node, Scope& scope);
  void body(NodeRef block, Scope& scope, const Surroundings& around);

  Session& session_;
  Evaluator evaluator_;
  ItemBound item_bound_;
  std::deque<Fields> field_pool_;  // one a level of nesting, reused
  std::size_t field_depth_ = 0;
  FileId main_file_;
  Span edition_;
  Span clock_;  // name of the `@clock` param; invalid: none
  SceneNotes notes_;
  ir::RenderSettings render_;
  ir::OriginId render_origin_;
  ir::MaterialId default_material_;
  ProtoGaps proto_gaps_;
  std::vector<Diagnostic> unused_;  // lints, reported when nothing is wrong
  std::unique_ptr<Modules> modules_;
  struct FieldsLease;
};

}  // namespace scenec::frontend
