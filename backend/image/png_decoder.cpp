// PNG by libpng. libpng leaves by longjmp, so every function that calls setjmp holds no object with
// a destructor; what must be freed lives in the caller's frame.
#include <fmt/format.h>
#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstring>
#include <utility>

#include "backend/image/decoders.hpp"

namespace scenec::backend {
namespace {

// Deflate cannot do better, so fewer compressed bytes than this cannot hold the pixels.
constexpr std::uint64_t best_deflate_ratio = 1'032;
constexpr png_alloc_size_t chunk_bytes = std::size_t{2} << 20;

struct PngSource {
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string_view rest;
  char message[160] = "";
  // Facts of the header, then of the samples to come.
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint64_t stored_bytes = 0;
  std::uint32_t channels = 0;
  std::uint32_t sample_bytes = 0;
  int passes = 1;
  // Of a palette picture, whose samples are indices.
  png_colorp palette = nullptr;
  int palette_size = 0;
  png_bytep opacity = nullptr;
  int opacity_size = 0;

  PngSource() = default;
  PngSource(const PngSource&) = delete;
  PngSource& operator=(const PngSource&) = delete;
  ~PngSource() { png_destroy_read_struct(&png, &info, nullptr); }
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  auto& source = *static_cast<PngSource*>(png_get_error_ptr(png));
  std::strncpy(source.message, message, sizeof source.message - 1);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void read_bytes(png_structp png, png_bytep data, std::size_t size) {
  auto& source = *static_cast<PngSource*>(png_get_io_ptr(png));
  if (size > source.rest.size()) png_error(png, "file ends too early");
  std::memcpy(data, source.rest.data(), size);
  source.rest.remove_prefix(size);
}

// Ancillary chunks we do not use are skipped unread: no profile or text can be a bomb.
void skip_unused_chunks(png_structp png) {
  static const png_byte names[] =
      "bKGD\0cHRM\0eXIf\0gAMA\0hIST\0iCCP\0iTXt\0oFFs\0pCAL\0pHYs\0sBIT\0sCAL\0sPLT\0sRGB\0sTER\0"
      "tEXt\0tIME\0zTXt";
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, 0);
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, names, sizeof names / 5);
}

bool read_header(PngSource& source, const ImageLimits& limits) {
  if (setjmp(png_jmpbuf(source.png)) != 0) return false;
  png_set_read_fn(source.png, &source, read_bytes);
  png_set_user_limits(source.png, limits.side, limits.side);
  png_set_chunk_malloc_max(source.png, chunk_bytes);
  png_set_crc_action(source.png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  png_set_benign_errors(source.png, 0);
  skip_unused_chunks(source.png);
  png_read_info(source.png, source.info);
  source.width = png_get_image_width(source.png, source.info);
  source.height = png_get_image_height(source.png, source.info);
  source.stored_bytes = std::uint64_t{png_get_rowbytes(source.png, source.info)} * source.height;
  if (png_get_color_type(source.png, source.info) == PNG_COLOR_TYPE_PALETTE) {
    // libpng's own expansion takes indices beyond the palette as black.
    png_get_PLTE(source.png, source.info, &source.palette, &source.palette_size);
    png_get_tRNS(source.png, source.info, &source.opacity, &source.opacity_size, nullptr);
    png_set_packing(source.png);
  } else {
    png_set_expand(source.png);  // fewer than 8 bits to 8, transparency to alpha
  }
  if constexpr (std::endian::native == std::endian::little) png_set_swap(source.png);
  source.passes = png_set_interlace_handling(source.png);
  png_read_update_info(source.png, source.info);
  source.channels = png_get_channels(source.png, source.info);
  source.sample_bytes = png_get_bit_depth(source.png, source.info) == 16 ? 2 : 1;
  return true;
}

bool read_rows(PngSource& source, png_bytep samples) {
  if (setjmp(png_jmpbuf(source.png)) != 0) return false;
  const std::size_t row_size = png_get_rowbytes(source.png, source.info);
  for (int pass = 0; pass < source.passes; ++pass) {
    for (std::size_t y = 0; y < source.height; ++y) {
      png_read_row(source.png, samples + y * row_size, nullptr);
    }
  }
  png_read_end(source.png, nullptr);
  return true;
}

// Indices become RGB, or RGBA where the palette has transparency. False: index out of range.
bool expand_palette(const PngSource& source, DecodedImage& image) {
  const auto& indices = std::get<std::vector<std::uint8_t>>(image.samples);
  const std::size_t channels = source.opacity == nullptr ? 3 : 4;
  std::vector<std::uint8_t> samples(indices.size() * channels);
  std::uint8_t* out = samples.data();
  for (const std::uint8_t index : indices) {
    if (index >= source.palette_size) return false;
    const png_color& colour = source.palette[index];
    out[0] = colour.red;
    out[1] = colour.green;
    out[2] = colour.blue;
    if (channels == 4) out[3] = index < source.opacity_size ? source.opacity[index] : 255;
    out += channels;
  }
  image.channels = static_cast<std::uint32_t>(channels);
  image.samples = std::move(samples);
  return true;
}

AssetProblem damaged(const PngSource& source) {
  return {0, fmt::format("damaged PNG: {}", source.message)};
}

template <class Sample>
bool read_samples(PngSource& source, DecodedImage& image) {
  std::vector<Sample> samples(std::size_t{image.width} * image.height * image.channels);
  const bool done = read_rows(source, reinterpret_cast<png_bytep>(samples.data()));
  image.samples = std::move(samples);
  return done;
}

}  // namespace

DecodeResult decode_png(std::string_view bytes, const ImageLimits& limits) {
  PngSource source;
  source.rest = bytes;
  source.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, on_error, on_warning);
  if (source.png == nullptr) return Failure{AssetProblem{0, "cannot start the PNG decoder"}};
  source.info = png_create_info_struct(source.png);
  if (source.info == nullptr) return Failure{AssetProblem{0, "cannot start the PNG decoder"}};
  if (!read_header(source, limits)) return Failure{damaged(source)};
  if (auto problem = find_size_problem(
          source.width, source.height,
          source.palette != nullptr ? 4 : std::uint64_t{source.channels} * source.sample_bytes,
          limits)) {
    return Failure{std::move(*problem)};
  }
  if (source.stored_bytes / best_deflate_ratio > bytes.size()) {
    return Failure{AssetProblem{0, fmt::format("PNG file of {} bytes cannot hold {} x {} pixels",
                                               bytes.size(), source.width, source.height)}};
  }
  DecodedImage image;
  image.width = source.width;
  image.height = source.height;
  image.channels = source.channels;
  const bool done = source.sample_bytes == 2 ? read_samples<std::uint16_t>(source, image)
                                             : read_samples<std::uint8_t>(source, image);
  if (!done) return Failure{damaged(source)};
  if (source.palette != nullptr && !expand_palette(source, image)) {
    return Failure{AssetProblem{0, "damaged PNG: palette index out of range"}};
  }
  return image;
}

}  // namespace scenec::backend
