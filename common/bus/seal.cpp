#include "common/bus/seal.hpp"

#include <fmt/format.h>
#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <array>
#include <random>
#include <utility>

#include "common/core/failure.hpp"
#include "common/core/log.hpp"
#include "common/core/suggest.hpp"

namespace fsi::bus {

namespace {

/// Strangers are named in the log up to so many, that nobody can fill a disk with it.
constexpr std::size_t named_strangers = 20;

std::string random_name() {
  std::random_device source;
  std::string name;
  for (int k = 0; k < 4; ++k) name += fmt::format("{:08x}", source());
  return name;
}

std::string sealed_text(const wire::Control& request) {
  return fmt::format("{}:{},{}:{},{}:{},{}", request.run.size(), request.run, request.from.size(),
                     request.from, request.command.size(), request.command, request.number);
}

}  // namespace

std::string seal_of(const wire::Control& request, const std::string& key) {
  const std::string text = sealed_text(request);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  const auto* bytes = reinterpret_cast<const unsigned char*>(text.data());
  if (HMAC(EVP_sha256(), key.data(), static_cast<int>(key.size()), bytes, text.size(), digest.data(),
           &size) == nullptr)
    throw Failure(ExitCode::expectation_missed, "bus: libcrypto makes no HMAC-SHA-256");
  std::string seal;
  for (std::size_t k = 0; k < size; ++k) seal += fmt::format("{:02x}", digest.at(k));
  return seal;
}

Sealer::Sealer(std::string run, std::string key)
    : run_(std::move(run)), key_(std::move(key)), from_(random_name()) {}

wire::Control Sealer::request(const std::string& command) {
  wire::Control request{.run = run_, .command = command, .from = from_, .number = ++number_, .seal = {}};
  request.seal = seal_of(request, key_);
  return request;
}

Gatekeeper::Gatekeeper(std::string run, std::string key) : run_(std::move(run)), key_(std::move(key)) {}

bool Gatekeeper::lets_in(const wire::Control& request) {
  if (request.run != run_) return false;
  if (key_.empty()) return refuse(request, "this program was started without a key (AMP_FSI_KEY)");
  const std::string expected = seal_of(request, key_);
  if (request.seal.size() != expected.size() ||
      CRYPTO_memcmp(request.seal.data(), expected.data(), expected.size()) != 0)
    return refuse(request, "it does not bear the seal of this run");
  std::uint64_t& latest = latest_[request.from];
  if (request.number <= latest) return refuse(request, "it was made before");
  latest = request.number;
  return true;
}

bool Gatekeeper::refuse(const wire::Control& request, const std::string& why) {
  if (strangers_.size() < named_strangers && strangers_.insert(request.from).second)
    log_warning(fmt::format("ignored the request {} of sender {}: {}", in_ticks(request.command),
                            in_ticks(request.from), why));
  return false;
}

}  // namespace fsi::bus
