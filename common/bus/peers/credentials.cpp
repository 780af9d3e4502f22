#include "common/bus/peers/credentials.hpp"

#include <fmt/format.h>
#include <openssl/bio.h>
#include <openssl/bn.h>
#include <openssl/core_names.h>
#include <openssl/ec.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>
#include <openssl/param_build.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/rand.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

#include "common/core/failure.hpp"

namespace fsi::bus {

namespace {

template <auto free>
struct Freed {
  template <class T>
  void operator()(T* object) const {
    free(object);
  }
};
using Bio = std::unique_ptr<BIO, Freed<&BIO_free_all>>;
using Number = std::unique_ptr<BIGNUM, Freed<&BN_clear_free>>;
using Key = std::unique_ptr<EVP_PKEY, Freed<&EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Freed<&X509_free>>;

constexpr const char* curve = "prime256v1";
/// Clocks may jump; the keys are gone with the run anyway.
constexpr const char* not_before = "20000101000000Z";
constexpr const char* not_after = "21000101000000Z";

void expect(bool fine, const char* what) {
  if (!fine) throw Failure(ExitCode::internal_error, fmt::format("bus: libcrypto: {} failed", what));
}
template <class T>
T made(T object, const char* what) {
  expect(object != nullptr, what);
  return object;
}

/// A private key of the curve that follows from the run's key: the same for everybody who knows it.
Number authority_scalar(const EC_GROUP* group, const RunKey& key, const std::string& run) {
  const std::string text = "certificate authority of AMP-FSI run " + run;
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  expect(
      HMAC(EVP_sha512(), key.secret.data(), static_cast<int>(key.secret.size()),
           reinterpret_cast<const unsigned char*>(text.data()), text.size(), digest.data(), &size) != nullptr,
      "HMAC");
  // 512 bits modulo the order less one: 1 .. order - 1, all as good as equally likely.
  Number scalar(made(BN_bin2bn(digest.data(), static_cast<int>(size), nullptr), "number"));
  const Number limit(made(BN_dup(EC_GROUP_get0_order(group)), "order"));
  const std::unique_ptr<BN_CTX, Freed<&BN_CTX_free>> scratch(made(BN_CTX_new(), "BN_CTX"));
  expect(BN_sub_word(limit.get(), 1) == 1 &&
             BN_mod(scalar.get(), scalar.get(), limit.get(), scratch.get()) == 1 &&
             BN_add_word(scalar.get(), 1) == 1,
         "reduction");
  return scalar;
}

/// Its public point, as octets.
std::string public_point(const EC_GROUP* group, const BIGNUM* scalar) {
  const std::unique_ptr<EC_POINT, Freed<&EC_POINT_free>> point(made(EC_POINT_new(group), "point"));
  expect(EC_POINT_mul(group, point.get(), scalar, nullptr, nullptr, nullptr) == 1, "public key");
  std::array<unsigned char, 65> octets{};
  expect(EC_POINT_point2oct(group, point.get(), POINT_CONVERSION_UNCOMPRESSED, octets.data(), octets.size(),
                            nullptr) == octets.size(),
         "public key");
  return {octets.begin(), octets.end()};
}

Key authority_key(const RunKey& key, const std::string& run) {
  const std::unique_ptr<EC_GROUP, Freed<&EC_GROUP_free>> group(
      made(EC_GROUP_new_by_curve_name(NID_X9_62_prime256v1), "curve"));
  const Number scalar = authority_scalar(group.get(), key, run);
  const std::string point = public_point(group.get(), scalar.get());
  const std::unique_ptr<OSSL_PARAM_BLD, Freed<&OSSL_PARAM_BLD_free>> builder(
      made(OSSL_PARAM_BLD_new(), "parameters"));
  expect(OSSL_PARAM_BLD_push_utf8_string(builder.get(), OSSL_PKEY_PARAM_GROUP_NAME, curve, 0) == 1 &&
             OSSL_PARAM_BLD_push_BN(builder.get(), OSSL_PKEY_PARAM_PRIV_KEY, scalar.get()) == 1 &&
             OSSL_PARAM_BLD_push_octet_string(builder.get(), OSSL_PKEY_PARAM_PUB_KEY, point.data(),
                                              point.size()) == 1,
         "parameters");
  const std::unique_ptr<OSSL_PARAM, Freed<&OSSL_PARAM_free>> parameters(
      made(OSSL_PARAM_BLD_to_param(builder.get()), "parameters"));
  const std::unique_ptr<EVP_PKEY_CTX, Freed<&EVP_PKEY_CTX_free>> context(
      made(EVP_PKEY_CTX_new_from_name(nullptr, "EC", nullptr), "EVP_PKEY_CTX"));
  EVP_PKEY* result = nullptr;
  expect(EVP_PKEY_fromdata_init(context.get()) == 1 &&
             EVP_PKEY_fromdata(context.get(), &result, EVP_PKEY_KEYPAIR, parameters.get()) == 1,
         "authority key");
  return Key(result);
}

void add_extension(X509* certificate, int kind, const char* value) {
  const std::unique_ptr<X509_EXTENSION, Freed<&X509_EXTENSION_free>> extension(
      made(X509V3_EXT_conf_nid(nullptr, nullptr, kind, value), "extension"));
  expect(X509_add_ext(certificate, extension.get(), -1) == 1, "extension");
}

/// A certificate for `owner`, signed by the holder of `signer`, whose name is `issuer`.
Certificate certify(const std::string& name, EVP_PKEY* owner, const std::string& issuer, EVP_PKEY* signer) {
  Certificate result(made(X509_new(), "certificate"));
  std::uint64_t serial = 0;
  expect(RAND_bytes(reinterpret_cast<unsigned char*>(&serial), sizeof serial) == 1, "random number");
  const auto add_name = [](X509_NAME* to, const std::string& text) {
    expect(X509_NAME_add_entry_by_txt(to, "CN", MBSTRING_UTF8,
                                      reinterpret_cast<const unsigned char*>(text.data()),
                                      static_cast<int>(text.size()), -1, 0) == 1,
           "name");
  };
  add_name(X509_get_subject_name(result.get()), name);
  add_name(X509_get_issuer_name(result.get()), issuer);
  expect(X509_set_version(result.get(), X509_VERSION_3) == 1 &&
             ASN1_INTEGER_set_uint64(X509_get_serialNumber(result.get()), serial) == 1 &&
             ASN1_TIME_set_string_X509(X509_getm_notBefore(result.get()), not_before) == 1 &&
             ASN1_TIME_set_string_X509(X509_getm_notAfter(result.get()), not_after) == 1 &&
             X509_set_pubkey(result.get(), owner) == 1,
         "certificate");
  add_extension(result.get(), NID_basic_constraints, name == issuer ? "critical,CA:TRUE" : "CA:FALSE");
  expect(X509_sign(result.get(), signer, EVP_sha256()) > 0, "signature");
  return result;
}

std::string text_of(const std::function<int(BIO*)>& write) {
  const Bio memory(made(BIO_new(BIO_s_mem()), "memory"));
  expect(write(memory.get()) == 1, "text");
  char* begin = nullptr;
  const auto size = BIO_get_mem_data(memory.get(), &begin);
  return {begin, static_cast<std::size_t>(size)};
}

/// S/MIME: the document with the signature behind it.
std::string signed_document(const std::string& document, X509* signer, EVP_PKEY* key) {
  constexpr int flags = PKCS7_TEXT | PKCS7_DETACHED | PKCS7_STREAM;
  const Bio content(made(BIO_new_mem_buf(document.data(), static_cast<int>(document.size())), "memory"));
  const std::unique_ptr<PKCS7, Freed<&PKCS7_free>> signature(
      made(PKCS7_sign(signer, key, nullptr, content.get(), flags), "signature"));
  return text_of([&](BIO* out) { return SMIME_write_PKCS7(out, signature.get(), content.get(), flags); });
}

/// Endpoints that need no protection of their own would be matched before their participant has shown who it
/// is; so discovery and liveliness are protected and access
/// is controlled, though all packets are signed anyway.
std::string governance_document(Protection protection) {
  return fmt::format(R"(<?xml version="1.0" encoding="utf-8"?>
<dds><domain_access_rules><domain_rule>
  <domains><id_range><min>0</min><max>230</max></id_range></domains>
  <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
  <enable_join_access_control>true</enable_join_access_control>
  <discovery_protection_kind>SIGN</discovery_protection_kind>
  <liveliness_protection_kind>SIGN</liveliness_protection_kind>
  <rtps_protection_kind>{}</rtps_protection_kind>
  <topic_access_rules><topic_rule>
    <topic_expression>*</topic_expression>
    <enable_discovery_protection>true</enable_discovery_protection>
    <enable_liveliness_protection>true</enable_liveliness_protection>
    <enable_read_access_control>true</enable_read_access_control>
    <enable_write_access_control>true</enable_write_access_control>
    <metadata_protection_kind>NONE</metadata_protection_kind>
    <data_protection_kind>NONE</data_protection_kind>
  </topic_rule></topic_access_rules>
</domain_rule></domain_access_rules></dds>
)",
                     protection == Protection::encrypt ? "ENCRYPT" : "SIGN");
}

std::string permissions_document(const std::string& role) {
  return fmt::format(R"(<?xml version="1.0" encoding="utf-8"?>
<dds><permissions><grant name="{0}">
  <subject_name>CN={0}</subject_name>
  <validity><not_before>2000-01-01T00:00:00</not_before><not_after>2100-01-01T00:00:00</not_after></validity>
  <allow_rule>
    <domains><id_range><min>0</min><max>230</max></id_range></domains>
    <publish><topics><topic>*</topic></topics></publish>
    <subscribe><topics><topic>*</topic></topics></subscribe>
  </allow_rule>
  <default>DENY</default>
</grant></permissions></dds>
)",
                     role);
}

}  // namespace

RunKey parse_key(const std::string& text) {
  if (text.empty()) return {};
  const auto colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  if (colon == std::string::npos || colon + 1 == text.size() || (kind != "sign" && kind != "encrypt")) {
    throw Failure(
        ExitCode::user_mistake,
        "AMP_FSI_KEY is no key of a run: sign:SECRET or encrypt:SECRET, with many random digits for "
        "SECRET");
  }
  return {.protection = kind == "sign" ? Protection::sign : Protection::encrypt,
          .secret = text.substr(colon + 1)};
}

Credentials make_credentials(const RunKey& key, const std::string& run, const std::string& role) {
  // Everybody's root certificate has the same name and key, but another signature (ECDSA draws numbers). What
  // the others check must therefore not contain it: documents are signed by the identity that it vouches for.
  const std::string issuer = "authority of the run";
  const Key authority = authority_key(key, run);
  const Certificate root = certify(issuer, authority.get(), issuer, authority.get());
  const Key own(made(EVP_EC_gen(curve), "identity key"));
  const Certificate identity = certify(role, own.get(), issuer, authority.get());
  return {
      .authority = text_of([&](BIO* out) { return PEM_write_bio_X509(out, root.get()); }),
      .certificate = text_of([&](BIO* out) { return PEM_write_bio_X509(out, identity.get()); }),
      .private_key = text_of([&](BIO* out) {
        return PEM_write_bio_PKCS8PrivateKey(out, own.get(), nullptr, nullptr, 0, nullptr, nullptr);
      }),
      .governance = signed_document(governance_document(key.protection), identity.get(), own.get()),
      .permissions = signed_document(permissions_document(role), identity.get(), own.get()),
  };
}

}  // namespace fsi::bus
