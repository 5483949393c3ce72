// The plan of a native file: one walk over the tree in pre-order with a stack of open nodes.
#include "frontend/format/plan_builder.hpp"

namespace scenec::frontend::layout {

namespace {

using grammar::NodeRef;
using grammar::SyntaxKind;
using grammar::SyntaxNode;

constexpr std::uint32_t indent_of_blocks = 2;

struct Open {
  SyntaxKind kind;
  std::uint32_t index;
  std::uint32_t next;
  std::uint32_t group;     // its own or the one around it
  std::uint32_t branches;  // of an if_item: the group of all branches
  bool owns_group = false;
  std::uint32_t elements = 0;  // nodes directly inside
  std::uint32_t element = 0;   // the last of them
  bool all_numbers = true;
};

bool is_chain(SyntaxKind kind) {
  return kind == SyntaxKind::multiply_chain || kind == SyntaxKind::add_chain ||
         kind == SyntaxKind::comparison || kind == SyntaxKind::and_chain ||
         kind == SyntaxKind::or_chain;
}
bool takes_comma(SyntaxKind kind) {
  return kind == SyntaxKind::list || kind == SyntaxKind::arguments ||
         kind == SyntaxKind::parameters;
}
bool is_bracket(SyntaxKind kind) {
  return takes_comma(kind) || kind == SyntaxKind::comprehension || kind == SyntaxKind::paren;
}
bool holds_items(SyntaxKind kind) {
  return kind == SyntaxKind::file || kind == SyntaxKind::block;
}

class Walk {
 public:
  explicit Walk(const grammar::SyntaxTree& tree) : tree_(tree), builder_(tree, indent_of_blocks) {}

  Plan run() {
    const auto& nodes = tree_.nodes();
    for (std::uint32_t index = 0; index < nodes.size(); ++index) {
      while (!open_.empty() && open_.back().next <= index) leave();
      if (grammar::is_token(nodes[index].kind)) {
        add_token(index);
      } else {
        enter(index);
      }
    }
    while (!open_.empty()) leave();
    return builder_.finish();
  }

 private:
  const SyntaxNode& node(std::uint32_t index) const { return tree_.nodes()[index]; }
  std::vector<Group>& groups() { return builder_.plan().groups; }

  void enter(std::uint32_t index) {
    const SyntaxNode& one = node(index);
    Open open{one.kind, index, one.next, no_group, no_group};
    if (!open_.empty()) {
      Open& parent = open_.back();
      open.group = parent.group;
      open.branches = parent.kind == SyntaxKind::if_item ? parent.branches : no_group;
      if (holds_items(parent.kind)) expect_break(Break::item, parent.group);
      ++parent.elements;
      parent.element = index;
      parent.all_numbers = parent.all_numbers && is_number(index);
    }
    if (one.kind == SyntaxKind::block) {
      own(open, GroupKind::block, open.branches == no_group ? open.group : open.branches);
    } else if (is_bracket(one.kind)) {
      own(open, GroupKind::bracket, open.group);
    } else if (is_chain(one.kind)) {
      own(open, GroupKind::chain, open.group);
    }
    open_.push_back(open);
  }

  void own(Open& open, GroupKind kind, std::uint32_t parent) {
    open.group = builder_.open_group(kind, parent);
    open.owns_group = true;
  }

  void leave() {
    const Open open = open_.back();
    open_.pop_back();
    if (open.owns_group) builder_.close_group(open.group);
    if (open.kind == SyntaxKind::annotation) expect_break(Break::annotation, open.group);
    if (open.kind == SyntaxKind::if_item && open.branches != no_group &&
        (open_.empty() || open_.back().kind != SyntaxKind::if_item)) {
      builder_.close_group(open.branches);
    }
    if (open.owns_group && is_bracket(open.kind)) {
      Group& group = groups()[open.group];
      group.takes_comma = takes_comma(open.kind) && open.elements > 0;
      group.fills = open.kind == SyntaxKind::list && open.elements > 0 && open.all_numbers;
      group.hugs = open.elements == 1 && open.kind != SyntaxKind::comprehension &&
                   is_embraced(group, open.element);
    }
  }

  bool is_number(std::uint32_t index) const {
    if (node(index).kind == SyntaxKind::unary) {
      std::uint32_t operand = index + 1;
      while (grammar::is_token(node(operand).kind)) ++operand;
      return node(operand).kind == SyntaxKind::number_literal;
    }
    return node(index).kind == SyntaxKind::number_literal;
  }

  // Whether the only element is itself a bracket, perhaps behind a name, and no comment stands
  // between the two brackets.
  bool is_embraced(const Group& outer, std::uint32_t element) const {
    std::uint32_t value = element;
    if (node(element).kind == SyntaxKind::argument) {
      for (const NodeRef child : NodeRef(&tree_, element).children()) value = child.index();
    }
    const SyntaxKind kind = node(value).kind;
    if (kind != SyntaxKind::list && kind != SyntaxKind::comprehension && kind != SyntaxKind::call) {
      return false;
    }
    const auto& plan = builder_.plan();
    const Token& closer = plan.tokens[outer.last];
    const Token& inner_closer = plan.tokens[outer.last - 1];
    const bool is_full = plan.groups[inner_closer.group].first + 1 < outer.last - 1;
    return is_full && closer.comment_count == 0 && plan.tokens[outer.first + 1].comment_count == 0;
  }

  void expect_break(Break brk, std::uint32_t group) {
    pending_ = brk;
    pending_group_ = group;
  }

  void add_token(std::uint32_t index) {
    const SyntaxNode& one = node(index);
    Open& parent = open_.back();
    const char first = one.begin < one.end ? tree_.text()[one.begin] : '\0';
    const bool is_mark = one.kind == SyntaxKind::punctuation;
    if (is_mark && first == ',' && takes_comma(parent.kind) && index + 2 == parent.next) {
      builder_.skip_token(one.begin, one.end);
      return;
    }
    if (one.kind == SyntaxKind::keyword && parent.kind == SyntaxKind::if_item &&
        parent.branches == no_group) {
      parent.branches = builder_.open_group(GroupKind::branches, parent.group);
    }
    Token& token = builder_.add_token(one.begin, one.end);
    token.brk = pending_;
    token.group = pending_group_;
    expect_break(Break::never, no_group);
    if (one.kind == SyntaxKind::number) token.spacing = Spacing::number;
    if (one.kind == SyntaxKind::operator_token) plan_operator(token, parent);
    if (is_mark) plan_mark(token, parent, first);
  }

  static void plan_operator(Token& token, const Open& parent) {
    if (parent.kind == SyntaxKind::unary) {
      token.spacing = Spacing::prefix;
    } else if (is_chain(parent.kind)) {
      token.brk = Break::operation;
      token.group = parent.group;
    }
  }

  void plan_mark(Token& token, const Open& parent, char first) {
    switch (first) {
      case '(':
      case '[': {
        const bool is_tight = parent.kind == SyntaxKind::arguments ||
                              parent.kind == SyntaxKind::parameters ||
                              parent.kind == SyntaxKind::index;
        token.spacing = is_tight ? Spacing::tight_open : Spacing::open;
        if (is_bracket(parent.kind)) expect_break(Break::element, parent.group);
        break;
      }
      case ')':
      case ']':
        token.spacing = Spacing::close;
        if (is_bracket(parent.kind)) close(token, parent);
        break;
      case ',':
        token.spacing = Spacing::mark;
        if (takes_comma(parent.kind)) expect_break(Break::element, parent.group);
        break;
      case ':':
        token.spacing = Spacing::mark;
        if (is_bracket(parent.kind)) expect_break(Break::element, parent.group);
        break;
      case ';':
        token.spacing = Spacing::mark;
        break;
      case '.':
        if (token.end - token.begin == 1) token.spacing = Spacing::dot;
        break;
      case '@':
        token.spacing = Spacing::prefix;
        break;
      case '}':
        close(token, parent);
        break;
      default:
        break;
    }
  }

  static void close(Token& token, const Open& parent) {
    token.brk = Break::closer;
    token.group = parent.group;
  }

  const grammar::SyntaxTree& tree_;
  PlanBuilder builder_;
  std::vector<Open> open_;
  Break pending_ = Break::never;
  std::uint32_t pending_group_ = no_group;
};

}  // namespace

Plan plan_sdl(const grammar::SyntaxTree& tree) {
  return Walk(tree).run();
}

}  // namespace scenec::frontend::layout
