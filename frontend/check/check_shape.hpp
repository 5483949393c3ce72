// Rules inside one shape, light or camera that a schema cannot state: relations between its keys.
#pragma once

#include "base/span.hpp"
#include "frontend/check/check_block.hpp"
#include "frontend/session.hpp"
#include "ir/cameras.hpp"
#include "ir/lights.hpp"
#include "ir/render_settings.hpp"
#include "ir/shapes.hpp"

namespace scenec::frontend {

// `checker` knows where keys were written; `head` is the place for what concerns all of them.
template <class T>
void check_shape(Session&, const T&, const BlockChecker&, Span) {}  // most shapes have no such rule
void check_shape(Session& session, const ir::Box& box, const BlockChecker& checker, Span head);
void check_shape(Session& session, const ir::Triangle& triangle, const BlockChecker& checker,
                 Span head);
void check_shape(Session& session, const ir::Quad& quad, const BlockChecker& checker, Span head);
void check_shape(Session& session, const ir::Revolve& revolve, const BlockChecker& checker,
                 Span head);
void check_shape(Session& session, const ir::Cylinder& cylinder, const BlockChecker& checker,
                 Span head);
void check_shape(Session& session, const ir::Mesh& mesh, const BlockChecker& checker, Span head);

template <class T>
void check_light(Session&, const T&, const BlockChecker&, Span) {}
void check_light(Session& session, const ir::SpotLight& light, const BlockChecker& checker,
                 Span head);
void check_light(Session& session, const ir::QuadLight& light, const BlockChecker& checker,
                 Span head);

void check_camera_frame(Session& session, const ir::CameraFrame& frame, Span head);
template <class T>
void check_camera(Session& session, const T& camera, const BlockChecker&, Span head) {
  check_camera_frame(session, camera, head);
}
void check_camera(Session& session, const ir::ThinLens& camera, const BlockChecker& checker,
                  Span head);

void check_render(Session& session, const ir::RenderSettings& render, const BlockChecker& checker);

}  // namespace scenec::frontend
