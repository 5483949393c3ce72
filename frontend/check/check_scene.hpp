// The rules between the entities of a scene, checked once everything is placed.
#pragma once

#include "frontend/lower/lowering.hpp"
#include "frontend/session.hpp"
#include "grammar/syntax_tree.hpp"

namespace scenec::frontend {

// Reports an empty file, a missing or ambiguous camera, a scene without light, shapes without
// material; chooses the camera of `render`.
void check_scene(Session& session, Span end_of_file, Lowering& lowering);

// `///` behind code documents nothing.
void check_doc_comments(Session& session, const grammar::SyntaxTree& tree);

}  // namespace scenec::frontend
