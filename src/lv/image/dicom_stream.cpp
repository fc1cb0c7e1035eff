#include "lv/image/dicom_stream.hpp"

#include "lv/base/check.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>

namespace lv::image {
namespace {

constexpr std::string_view deflated = "1.2.840.10008.1.2.1.99";
constexpr std::string_view explicit_little_endian = "1.2.840.10008.1.2.1";
constexpr std::size_t preamble = 132;          // with "DICM"
constexpr std::size_t longest_header = 65536;  // group 2, with what makers add to it

template <class Number>
Number number_at(std::string_view bytes, std::size_t at) {
  Number value;
  std::memcpy(&value, bytes.data() + at, sizeof(Number));
  return value;
}

/// The elements of group 2: where they end, and where the transfer syntax stands.
struct Header {
  std::size_t end = preamble, syntax_at = 0, syntax_length = 0;
};

Header header_of(std::string_view bytes) {
  constexpr std::size_t shortest = 12;  // element with a wide length
  constexpr std::array<std::string_view, 3> wide{"OB", "UN", "UT"};
  Header header;
  std::size_t& at = header.end;
  while (at + shortest <= bytes.size() && number_at<std::uint16_t>(bytes, at) == 2) {
    const bool is_wide = std::find(wide.begin(), wide.end(), bytes.substr(at + 4, 2)) != wide.end();
    const std::size_t length =
        is_wide ? number_at<std::uint32_t>(bytes, at + 8) : number_at<std::uint16_t>(bytes, at + 6);
    const std::size_t value = at + (is_wide ? 12 : 8);
    if (length > bytes.size() - value)
      return {};
    if (number_at<std::uint16_t>(bytes, at + 2) == 0x10)
      header = {at, value, length};
    at = value + length;
  }
  return header;
}

/// The name of the transfer syntax, which is padded to an even length.
std::string_view syntax_of(std::string_view bytes, const Header& header) {
  const std::string_view stored = bytes.substr(header.syntax_at, header.syntax_length);
  return stored.substr(0, stored.find('\0'));
}

/// Inflates raw data until they or the input end, or make no sense; whether they came to their end.
bool inflate_to(std::string_view packed, std::string& bytes) {
  z_stream stream{};
  LV_CHECK(inflateInit2(&stream, -MAX_WBITS) == Z_OK);
  const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, inflateEnd);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  std::array<char, 65536> block{};
  int state = Z_OK;
  while (state == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = block.size();
    state = inflate(&stream, Z_NO_FLUSH);
    bytes.append(block.data(), block.size() - stream.avail_out);
  }
  return state == Z_STREAM_END;
}

}  // namespace

DicomStream open_dicom(const std::filesystem::path& file) {
  auto stream = std::make_unique<std::ifstream>(file, std::ios::binary);
  std::string bytes(longest_header, '\0');
  stream->read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream->gcount()));
  stream->clear();
  const Header header = header_of(bytes);
  if (syntax_of(bytes, header) != deflated) {
    stream->seekg(0);
    return {std::move(stream), std::filesystem::file_size(file)};
  }
  bytes.append(std::istreambuf_iterator<char>(*stream), {});
  std::string plain = bytes.substr(0, header.end);
  plain.replace(header.syntax_at, header.syntax_length,
                std::string(explicit_little_endian)
                    .append(header.syntax_length - explicit_little_endian.size(), '\0'));
  const bool whole = inflate_to(std::string_view(bytes).substr(header.end), plain);
  const std::uintmax_t size = plain.size();
  return {std::make_unique<std::istringstream>(std::move(plain), std::ios::binary), size, !whole};
}

}  // namespace lv::image
