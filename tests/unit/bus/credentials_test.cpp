/// Who may take part: the key of a run, and what follows from it.

#include "common/bus/peers/credentials.hpp"

#include <gtest/gtest.h>

#include "common/core/failure.hpp"

namespace fsi::bus::test {
namespace {

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Credentials, KeySaysHowARunIsProtected) {
  EXPECT_EQ(parse_key("").protection, Protection::off);
  EXPECT_EQ(parse_key("sign:abc").protection, Protection::sign);
  EXPECT_EQ(parse_key("sign:abc").secret, "abc");
  EXPECT_EQ(parse_key("encrypt:a:b").protection, Protection::encrypt);
  EXPECT_EQ(parse_key("encrypt:a:b").secret, "a:b");
  for (const char* text : {"abc", "sign", "sign:", "off:abc", ":abc", "SIGN:abc"}) {
    EXPECT_THROW(parse_key(text), Failure) << text;
  }
}

TEST(Credentials, GovernanceSaysWhatTheKeyAsksFor) {
  const Credentials sign = make_credentials(parse_key("sign:abc"), "run", "fluid");
  EXPECT_TRUE(holds(sign.governance, "<rtps_protection_kind>SIGN</rtps_protection_kind>"));
  EXPECT_TRUE(holds(sign.governance,
                    "<allow_unauthenticated_participants>false</allow_unauthenticated_participants>"));
  EXPECT_TRUE(holds(sign.permissions, "<subject_name>CN=fluid</subject_name>"));
  const Credentials encrypt = make_credentials(parse_key("encrypt:abc"), "run", "fluid");
  EXPECT_TRUE(holds(encrypt.governance, "<rtps_protection_kind>ENCRYPT</rtps_protection_kind>"));
}

TEST(Credentials, EveryParticipantHasAnIdentityOfItsOwn) {
  const Credentials one = make_credentials(parse_key("sign:abc"), "run", "fluid"),
                    other = make_credentials(parse_key("sign:abc"), "run", "fluid");
  EXPECT_NE(one.private_key, other.private_key);
  EXPECT_NE(one.certificate, other.certificate);
}

}  // namespace
}  // namespace fsi::bus::test
