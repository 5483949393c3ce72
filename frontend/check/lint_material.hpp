// Lints about one material: colours that reflect more than they receive, roughness below what the
// model resolves. Textures are not looked at.
#pragma once

#include "frontend/check/check_block.hpp"
#include "ir/materials.hpp"

namespace scenec::frontend {

template <class T>
void lint_material(Session&, const T&, const BlockChecker&, Span) {}  // mixes have no colour
void lint_material(Session& session, const ir::Diffuse& material, const BlockChecker& checker,
                   Span head);
void lint_material(Session& session, const ir::Phong& material, const BlockChecker& checker,
                   Span head);
void lint_material(Session& session, const ir::Mirror& material, const BlockChecker& checker,
                   Span head);
void lint_material(Session& session, const ir::Dielectric& material, const BlockChecker& checker,
                   Span head);
void lint_material(Session& session, const ir::Conductor& material, const BlockChecker& checker,
                   Span head);
void lint_material(Session& session, const ir::Ggx& material, const BlockChecker& checker,
                   Span head);

}  // namespace scenec::frontend
