#pragma once
/// What lets a program take part in a run: everybody who knows the key of the run makes himself the same
/// certificate authority from it, and with that an identity of his own (DDS Security, plugins of Cyclone
/// DDS). Who does not know the key can neither be heard nor hear: his packets do not bear the code that only
/// members can compute.

#include <string>

namespace fsi::bus {

/// How the packets of a run are protected.
enum class Protection {
  off,      ///< not at all: whoever is on this machine can read and falsify
  sign,     ///< every packet bears a message authentication code (AES-GMAC)
  encrypt,  ///< and nobody else can read it (AES-GCM)
};

/// The key of a run as the launcher hands it out in AMP_FSI_KEY:
/// "sign:SECRET" or "encrypt:SECRET"; empty: no protection.
struct RunKey {
  Protection protection = Protection::off;
  std::string secret;
};

/// @throws Failure the text is no key
RunKey parse_key(const std::string& text);

/// What the plugins of Cyclone DDS ask for: PEM texts and documents signed as S/MIME.
struct Credentials {
  std::string authority;    ///< certificate of the run's authority, of identities as of permissions
  std::string certificate;  ///< identity of this participant
  std::string private_key;  ///< of that
  std::string governance;   ///< what is protected, and how
  std::string permissions;  ///< what this participant may do
};

/// Credentials for one participant, made anew each time. `role` becomes the name in its certificate.
Credentials make_credentials(const RunKey& key, const std::string& run, const std::string& role);

}  // namespace fsi::bus
