// PNG by libpng. As in the decoder, the function that calls setjmp holds no object with a
// destructor, and no exception passes through libpng.
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <exception>

#include "backend/image/write_image.hpp"
#include "base/assert.hpp"
#include "base/text.hpp"

namespace scenec::backend {
namespace {

// On a noisy 1280 x 720 render half the time of level 6 (169 against 326 ms) and no more bytes.
constexpr int compression_level = 4;

struct PngSink {
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string bytes;
  char message[160] = "";

  PngSink() = default;
  PngSink(const PngSink&) = delete;
  PngSink& operator=(const PngSink&) = delete;
  ~PngSink() { png_destroy_write_struct(&png, &info); }
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  auto& sink = *static_cast<PngSink*>(png_get_error_ptr(png));
  std::strncpy(sink.message, message, sizeof sink.message - 1);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

bool append(std::string& bytes, const char* data, std::size_t size) {
  try {
    bytes.append(data, size);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

void write_bytes(png_structp png, png_bytep data, std::size_t size) {
  auto& sink = *static_cast<PngSink*>(png_get_io_ptr(png));
  if (!append(sink.bytes, reinterpret_cast<const char*>(data), size)) {
    png_error(png, "not enough memory");
  }
}

void flush_nothing(png_structp) {}

bool write(PngSink& sink, const Rgb8View& image, const std::vector<png_text>& text) {
  if (setjmp(png_jmpbuf(sink.png)) != 0) return false;
  png_set_write_fn(sink.png, &sink, write_bytes, flush_nothing);
  png_set_compression_level(sink.png, compression_level);
  png_set_IHDR(sink.png, sink.info, image.width, image.height, 8, PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(sink.png, sink.info, PNG_sRGB_INTENT_PERCEPTUAL);
  if (!text.empty()) {
    png_set_text(sink.png, sink.info, text.data(), static_cast<int>(text.size()));
  }
  png_write_info(sink.png, sink.info);
  for (std::size_t y = 0; y < image.height; ++y) {
    png_write_row(sink.png, image.rgb.data() + y * image.width * 3);
  }
  png_write_end(sink.png, nullptr);
  return true;
}

bool is_ascii(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

bool is_key(std::string_view key) {
  return !key.empty() && key.size() <= 79 && key.front() != ' ' && key.back() != ' ' &&
         std::ranges::all_of(key, [](char c) { return c >= 0x20 && c < 0x7F; });
}

// libpng takes its strings as mutable pointers but copies them.
png_text entry_of(const std::pair<std::string, std::string>& pair) {
  png_text entry{};
  const bool ascii = is_ascii(pair.second);
  entry.compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
  entry.key = const_cast<png_charp>(pair.first.c_str());
  entry.text = const_cast<png_charp>(pair.second.c_str());
  (ascii ? entry.text_length : entry.itxt_length) = pair.second.size();
  return entry;
}

}  // namespace

Result<std::string, AssetProblem> encode_png(const Rgb8View& image, const PngText& text) {
  SCENEC_ASSERT(image.width > 0 && image.height > 0);
  SCENEC_ASSERT(image.rgb.size() == std::size_t{3} * image.width * image.height);
  std::vector<png_text> entries;
  for (const auto& pair : text) {
    if (!is_key(pair.first) || pair.second.find('\0') != std::string::npos) {
      return Failure{
          AssetProblem{0, fmt::format("PNG text `{}` cannot be stored", printable(pair.first))}};
    }
    entries.push_back(entry_of(pair));
  }
  PngSink sink;
  sink.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, on_error, on_warning);
  if (sink.png != nullptr) sink.info = png_create_info_struct(sink.png);
  if (sink.info == nullptr) return Failure{AssetProblem{0, "cannot start the PNG encoder"}};
  if (!write(sink, image, entries)) {
    return Failure{AssetProblem{0, fmt::format("cannot encode the PNG: {}", sink.message)}};
  }
  return std::move(sink.bytes);
}

}  // namespace scenec::backend
