/// Requests are obeyed when whoever made them knows the key of the run, and once.

#include "common/bus/seal.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <vector>

namespace fsi::bus {
namespace {

TEST(Seal, IsTheHmacSha256ThatOtherLanguagesCompute) {
  const wire::Control request{.run = "piston-1", .command = "stop", .from = "0123", .number = 7, .seal = {}};
  // Python: hmac.new(b"a key", b"8:piston-1,4:0123,4:stop,7", hashlib.sha256).hexdigest()
  EXPECT_EQ(seal_of(request, "a key"), "3d670739b1adda95498b710be8a5635fd3f4479f8bd1cb47ea3ac831da864d1d");
}

TEST(Seal, RequestsThatReadAlikeHaveDifferentSeals) {
  std::set<std::string> seals;
  for (const auto& [run, from] : {std::pair{"a", "b,c"}, {"a,b", "c"}, {"a,1:b", "c"}, {"", "a,b,c"}})
    seals.insert(seal_of({.run = run, .command = "stop", .from = from, .number = 1, .seal = {}}, "key"));
  EXPECT_EQ(seals.size(), 4U);
}

TEST(Gatekeeper, LetsEveryRequestOfOursInOnce) {
  Gatekeeper gate("run", "key");
  Sealer one("run", "key"), two("run", "key");
  for (const char* command : {"pause", "resume", "pause", "stop"}) {
    for (Sealer* sealer : {&one, &two}) {
      const wire::Control request = sealer->request(command);
      EXPECT_TRUE(gate.lets_in(request));
      EXPECT_FALSE(gate.lets_in(request)) << "what was overheard is worth nothing";
    }
  }
}

TEST(Gatekeeper, OlderRequestIsRefusedAfterANewerOne) {
  Gatekeeper gate("run", "key");
  Sealer sealer("run", "key");
  const wire::Control older = sealer.request("stop"), newer = sealer.request("pause");
  EXPECT_TRUE(gate.lets_in(newer));
  EXPECT_FALSE(gate.lets_in(older));
}

TEST(Gatekeeper, WhateverIsChangedInARequestBreaksItsSeal) {
  const std::vector<std::function<void(wire::Control&)>> changes = {
      [](wire::Control& c) { c.command = "stop"; },
      [](wire::Control& c) { c.from += "x"; },
      [](wire::Control& c) { ++c.number; },
      [](wire::Control& c) { c.seal.clear(); },
      [](wire::Control& c) { c.seal.front() ^= 1; },
      [](wire::Control& c) { c.seal += '0'; },
      [](wire::Control& c) { c.seal.resize(c.seal.size() / 2); }};
  for (const auto& change : changes) {
    Gatekeeper gate("run", "key");
    wire::Control request = Sealer("run", "key").request("pause");
    change(request);
    EXPECT_FALSE(gate.lets_in(request));
  }
}

TEST(Gatekeeper, KeyOrRunOfAnotherOpensNothing) {
  Gatekeeper gate("run", "key");
  EXPECT_FALSE(gate.lets_in(Sealer("run", "another key").request("stop")));
  EXPECT_FALSE(gate.lets_in(Sealer("run", "").request("stop")));
  EXPECT_FALSE(gate.lets_in(Sealer("another run", "key").request("stop")));
  EXPECT_TRUE(gate.lets_in(Sealer("run", "key").request("stop")));
}

TEST(Gatekeeper, WithoutAKeyNobodyIsLetIn) {
  Gatekeeper gate("run", "");
  EXPECT_FALSE(gate.lets_in(Sealer("run", "").request("stop")));
  EXPECT_FALSE(gate.lets_in(Sealer("run", "key").request("stop")));
}

}  // namespace
}  // namespace fsi::bus
