#include "lv/page/packing.hpp"

#include "lv/base/check.hpp"

#include <vtkBase64Utilities.h>
#include <vtkNew.h>
#include <vtkZLibDataCompressor.h>

#include <type_traits>

namespace lv::page {
namespace {

using Bytes = std::vector<unsigned char>;

template <class Number>
Bytes differences(const std::vector<Number>& values) {
  using Unsigned = std::make_unsigned_t<Number>;
  Bytes bytes(sizeof(Number) * values.size());
  Unsigned before = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto now = static_cast<Unsigned>(values[i]);
    const auto difference = static_cast<Unsigned>(now - before);
    for (std::size_t b = 0; b < sizeof(Number); ++b)
      bytes[b * values.size() + i] = static_cast<unsigned char>(difference >> (8 * b));
    before = now;
  }
  return bytes;
}

std::string letters(const unsigned char* bytes, std::size_t length) {
  std::string text(4 * ((length + 2) / 3) + 4, '\0');
  text.resize(
      vtkBase64Utilities::Encode(bytes, length, reinterpret_cast<unsigned char*>(text.data())));
  return text;
}

std::string compressed(const Bytes& bytes) {
  vtkNew<vtkZLibDataCompressor> zlib;
  zlib->SetCompressionLevel(9);
  Bytes small(zlib->GetMaximumCompressionSpace(bytes.size()));
  const std::size_t length = zlib->Compress(bytes.data(), bytes.size(), small.data(), small.size());
  LV_CHECK(length > 0 || bytes.empty());
  return letters(small.data(), length);
}

}  // namespace

std::string packed(const std::vector<std::int16_t>& values) {
  return compressed(differences(values));
}

std::string packed(const std::vector<std::int32_t>& values) {
  return compressed(differences(values));
}

std::string base64(const std::string& bytes) {
  return letters(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
}

}  // namespace lv::page
