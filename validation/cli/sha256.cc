#include "validation/cli/sha256.h"

#include "synthetic/dataset/error.h"

#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <vector>

namespace pelvireg::cli
{
namespace
{
class Digest
{
public:
  Digest() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free)
  {
    require(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
  }

  void add(const char *data, std::size_t size) { require(EVP_DigestUpdate(context_.get(), data, size) == 1); }

  std::string hexadecimal()
  {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
    unsigned int size = 0;
    require(EVP_DigestFinal_ex(context_.get(), bytes.data(), &size) == 1);
    std::string text;
    for (unsigned int i = 0; i < size; ++i)
      for (const int digit : {bytes[i] >> 4, bytes[i] & 15})
        text += "0123456789abcdef"[digit];
    return text;
  }

private:
  static void require(bool ok)
  {
    if (!ok)
      throw std::runtime_error("OpenSSL cannot compute a SHA-256");
  }

  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};
} // namespace

std::string sha256_of_text(std::string_view text)
{
  Digest digest;
  digest.add(text.data(), text.size());
  return digest.hexadecimal();
}

std::string sha256_of_file(const std::filesystem::path &file)
{
  std::ifstream in(file, std::ios::binary);
  Digest digest;
  std::vector<char> buffer(1 << 20);
  while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || in.gcount() > 0)
    digest.add(buffer.data(), static_cast<std::size_t>(in.gcount()));
  if (!in.eof())
    throw InputError("'" + file.string() + "' cannot be read; run the stage that makes it first");
  return digest.hexadecimal();
}
} // namespace pelvireg::cli
