// What the page's POSTs mean: from JSON to wishes, to what is under a pixel, to a changed source
// text. Everything in a body is checked; what is wrong is said, never guessed.
#pragma once

#include <string>
#include <string_view>

#include "runtime/watch/http_message.hpp"
#include "runtime/watch/render_loop.hpp"

namespace scenec::runtime {

// {"scene": 0, "param": {"name": "n", "value": "3"}}  (a value of null takes it back)
// {"scene": 0, "params": null}                         takes all back
// {"scene": 0, "camera": {"eye": [x, y, z], "aim": [..], "up": [..]}}   or null
// {"scene": 0, "region": [x0, y0, x1, y1]}             or null
// {"scene": 0, "paused": true}
[[nodiscard]] HttpResponse take_wish(RenderLoop& loop, const std::string& body);

// {"scene": 0, "x": 10, "y": 20}: what is there, and where it was written.
[[nodiscard]] HttpResponse probe_pixel(const RenderLoop& loop, const std::string& body);

// {"scene": 0, "name": "n", "value": "3", "apply": false}: the difference that writing the value
// into the file would make. With "apply": true and the "hash" that answer gave, it is written;
// refused when the file is not what it was.
[[nodiscard]] HttpResponse write_back(const RenderLoop& loop, const std::string& body);

}  // namespace scenec::runtime
