#include "synthetic/observation/images/content_uid.h"

#include <openssl/evp.h>

#include <array>
#include <stdexcept>

namespace pelvireg::observation
{
namespace
{
/// 128 bits as a decimal number, by long division.
std::string decimal(std::array<unsigned char, 16> bytes)
{
  std::string digits;
  for (bool is_zero = false; !is_zero;)
  {
    unsigned remainder = 0;
    is_zero = true;
    for (unsigned char &byte : bytes)
    {
      const unsigned value = remainder * 256 + byte;
      byte = static_cast<unsigned char>(value / 10);
      remainder = value % 10;
      is_zero = is_zero && byte == 0;
    }
    digits.insert(digits.begin(), static_cast<char>('0' + remainder));
  }
  return digits;
}
} // namespace

std::string content_uid(const std::string &text)
{
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  if (EVP_Digest(text.data(), text.size(), digest.data(), nullptr, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("cannot make a SHA-256 digest");
  std::array<unsigned char, 16> uuid{};
  std::copy(digest.begin(), digest.begin() + 16, uuid.begin());
  uuid[6] = static_cast<unsigned char>((uuid[6] & 0x0F) | 0x80); // version 8
  uuid[8] = static_cast<unsigned char>((uuid[8] & 0x3F) | 0x80); // variant of RFC 9562
  return "2.25." + decimal(uuid);
}
} // namespace pelvireg::observation
