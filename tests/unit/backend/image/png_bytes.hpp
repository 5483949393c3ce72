// PNG files for tests, chunk by chunk and independent of libpng: stored deflate blocks, correct
// checksums unless the test damages them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace scenec::backend {

inline std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(value >> shift));
  return bytes;
}

inline std::string png_chunk(std::string_view type, std::string_view data) {
  const std::string body = std::string(type) + std::string(data);
  std::uint32_t crc = 0xFFFF'FFFF;
  for (const char c : body) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xEDB8'8320u : 0u);
  }
  return big_endian(static_cast<std::uint32_t>(data.size())) + body + big_endian(~crc);
}

// A zlib stream of stored blocks.
inline std::string stored_zlib(std::string_view data) {
  std::string bytes = "\x78\x01";
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const char c : data) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  do {
    const std::size_t size = data.size() < 65535 ? data.size() : 65535;
    bytes.push_back(size == data.size() ? '\1' : '\0');
    for (const std::size_t value : {size, ~size}) {
      bytes.push_back(static_cast<char>(value & 0xFF));
      bytes.push_back(static_cast<char>(value >> 8 & 0xFF));
    }
    bytes.append(data.substr(0, size));
    data.remove_prefix(size);
  } while (!data.empty());
  return bytes + big_endian(b << 16 | a);
}

inline std::string png_header(std::uint32_t width, std::uint32_t height, int depth, int colour,
                              int interlace = 0) {
  std::string data = big_endian(width) + big_endian(height);
  for (const int value : {depth, colour, 0, 0, interlace}) data.push_back(static_cast<char>(value));
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", data);
}

// `rows`: filter byte and stored samples of every row.
inline std::string png_file(const std::string& header, std::string_view rows,
                            const std::string& before_data = "") {
  return header + before_data + png_chunk("IDAT", stored_zlib(rows)) + png_chunk("IEND", "");
}

}  // namespace scenec::backend
