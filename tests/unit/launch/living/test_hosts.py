#!/usr/bin/python3
"""Which programs run on which machines by --hosts, where they meet, and what is said where that cannot be."""

import socket
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import launcher  # noqa: E402
from fsi_launch.failure import PEER_LOST, UserMistake  # noqa: E402
from fsi_launch.living import hosts  # noqa: E402
from fsi_launch.living.supervise import Ending  # noqa: E402
from fsi_launch.results import verdict  # noqa: E402

CASE = SimpleNamespace(programs={"fluid": "fluid_solver", "disk": "solid_solver_beam", "coupler": "coupler"})
KNOWN = {"a": "10.0.0.2", "b": "10.0.0.3", "home": "127.0.1.1", "10.1.0.2": "10.1.0.2"}


def look_up(name, *_):
    if name not in KNOWN:
        raise socket.gaierror(-2, "Name or service not known")
    return [(None, None, None, None, (KNOWN[name], 0))]


class Wanted(unittest.TestCase):
    def setUp(self):
        patch = mock.patch("socket.getaddrinfo", side_effect=look_up)
        patch.start()
        self.addCleanup(patch.stop)

    def test_each_program_its_machine(self):
        self.assertEqual(hosts.wanted(None, CASE), {})
        self.assertEqual(hosts.wanted("fluid=a,disk=me@b", CASE), {"fluid": hosts.Host("a", "10.0.0.2"), "disk": hosts.Host("me@b", "10.0.0.3")})

    def test_address_beside_the_name(self):
        self.assertEqual(hosts.wanted("fluid=alias/10.1.0.2", CASE), {"fluid": hosts.Host("alias", "10.1.0.2")})

    def test_what_cannot_be(self):
        for text, words in (("fluid=nowhere", "write it behind the name: nowhere/ADDRESS"), ("fluid=home", "home is this machine itself"),
                            ("fluid=-oProxyCommand=x", "is no machine"), ("gas=a", "it has fluid, disk"), ("coupler=a", "give it on a")):
            with self.subTest(text), self.assertRaisesRegex(UserMistake, words):
                hosts.wanted(text, CASE)

    def test_each_machine_is_told_its_own_address_first(self):
        far = hosts.wanted("fluid=a,disk=b", CASE)
        with mock.patch.object(hosts, "_own_address", return_value="10.0.0.1"):
            self.assertEqual(hosts.networks(far), {"": "10.0.0.1,10.0.0.2,10.0.0.3", "10.0.0.2": "10.0.0.2,10.0.0.1,10.0.0.3",
                                                   "10.0.0.3": "10.0.0.3,10.0.0.1,10.0.0.2"})
        with mock.patch.object(hosts, "_own_address", side_effect=["10.0.0.1", "192.168.0.1"]), self.assertRaisesRegex(
                UserMistake, "choose addresses of one network"):
            hosts.networks(far)


class LastWord(unittest.TestCase):
    def test_what_a_login_says_does_not_disturb(self):
        self.assertEqual(hosts.last_word('Welcome!\n{"code": 4, "report": ""}\nlogout\n'), {"code": 4, "report": ""})
        self.assertIsNone(hosts.last_word("Welcome!\n4\n"))

    def test_lost_connection_is_the_cause_and_named(self):
        endings = [Ending("fluid", PEER_LOST, 1.0, cut="the connection to a ended"), Ending("coupler", 143, 2.0, ours=True)]
        cause = verdict.root_cause(endings, {"coupler": "coupler"})
        self.assertEqual(cause.name, "fluid")
        code, reason = verdict._explain(cause, CASE, launcher.Path("/nowhere"), {}, [cause])
        self.assertEqual((code, reason), (PEER_LOST, "lost fluid (fluid_solver): the connection to a ended"))


if __name__ == "__main__":
    unittest.main()
