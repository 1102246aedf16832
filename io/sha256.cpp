#include "io/sha256.h"

#include <openssl/evp.h>

#include <vector>

#include "core/foundation/error.h"
#include "io/bytes.h"

namespace adit::io {
namespace {

void check(int result) {
  if (result != 1) throw Error("SHA-256 is not available from OpenSSL", {}, "check the installation of OpenSSL");
}

}  // namespace

struct Sha256::Context {
  EVP_MD_CTX* state = EVP_MD_CTX_new();
  ~Context() { EVP_MD_CTX_free(state); }
};

Sha256::Sha256() : context_(std::make_unique<Context>()) {
  check(EVP_DigestInit_ex(context_->state, EVP_sha256(), nullptr));
}

Sha256::~Sha256() = default;

void Sha256::add(std::span<const std::byte> bytes) {
  check(EVP_DigestUpdate(context_->state, bytes.data(), bytes.size()));
}

void Sha256::add(std::string_view text) {
  add(std::as_bytes(std::span(text)));
}

std::string Sha256::hex() {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned size = 0;
  check(EVP_DigestFinal_ex(context_->state, digest, &size));
  std::string text;
  for (unsigned i = 0; i < size; ++i) {
    text += "0123456789abcdef"[digest[i] >> 4];
    text += "0123456789abcdef"[digest[i] & 15];
  }
  return text;
}

std::string sha256_of_bytes(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes);
  return hash.hex();
}

std::string sha256_of_file(const std::filesystem::path& path, Progress& progress) {
  const InputFile file(path);
  Sha256 hash;
  std::vector<std::byte> block(std::size_t{4} << 20);
  for (std::uint64_t offset = 0; offset < file.size();) {
    progress.step(static_cast<std::size_t>(offset), static_cast<std::size_t>(file.size()));
    const std::size_t got = file.read_some(offset, block.data(), block.size());
    if (got == 0) throw Error("the file became shorter while it was read", file.at_byte(offset), "read it again");
    hash.add(std::span(block).first(got));
    offset += got;
  }
  return hash.hex();
}

}  // namespace adit::io
