#include "io/deflate.hpp"

#include <zlib.h>

#include "base/check.hpp"

namespace phy::io {

std::string deflated(std::string_view bytes) {
  // compressBound is the most that the result can take, so one call is enough.
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  const int code =
      compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), Z_DEFAULT_COMPRESSION);
  PHY_CHECK(code == Z_OK, "a buffer of compressBound is enough");
  out.resize(size);
  return out;
}

namespace {

std::optional<std::string> inflated_as(int window, std::string_view bytes, std::size_t most) {
  z_stream z{};
  inflateInit2(&z, window);
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  z.avail_in = static_cast<uInt>(bytes.size());
  // Block by block, so that a damaged or malicious stream cannot ask for more memory than `most` and a block.
  std::string out, block(std::size_t{1} << 16U, '\0');
  int code = Z_OK;
  while (code == Z_OK && out.size() <= most) {
    z.next_out = reinterpret_cast<Bytef*>(block.data());
    z.avail_out = static_cast<uInt>(block.size());
    code = inflate(&z, Z_NO_FLUSH);
    out.append(block, 0, block.size() - z.avail_out);
  }
  inflateEnd(&z);
  // Anything but a complete stream is an error: a truncated one must not pass as a short text.
  if (code != Z_STREAM_END || out.size() > most) return std::nullopt;
  return out;
}

}  // namespace

std::optional<std::string> inflated(std::string_view bytes, std::size_t most) {
  return inflated_as(MAX_WBITS, bytes, most);
}

std::optional<std::string> inflated_raw(std::string_view bytes, std::size_t most) {
  return inflated_as(-MAX_WBITS, bytes, most);
}

std::uint32_t crc32_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace phy::io
