// The places of a picture that look least like another rendering of it are rendered again, many
// times, and the picture must not stand out among those (backend/film/lineup.hpp). It finds what
// is small but certain: a moved object of which only a thin edge is left.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "backend/film/agreement.hpp"
#include "base/parallel.hpp"

namespace scenec::backend {

// Renders a part of the picture as its file says it was made, but with random numbers that follow
// from `peer`: three values a pixel, nothing when it was stopped. Called from worker threads.
using RenderPeer =
    std::function<std::optional<std::vector<float>>(const ir::Region& part, std::uint64_t peer)>;

// Pixels that second_look() has rendered when it is done, each once for every peer.
[[nodiscard]] std::int64_t second_look_pixels(std::size_t width, std::size_t height);

// `other`: a rendering of the same scene, with any number of samples. Nothing when it was stopped.
// What is found holds for the whole picture: `tests` are its cells.
[[nodiscard]] std::optional<Agreement> second_look(const NoisyPicture& picture,
                                                   const NoisyPicture& other, ThreadPool& pool,
                                                   const RenderPeer& render);

}  // namespace scenec::backend
