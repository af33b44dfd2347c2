# SPDX-License-Identifier: Apache-2.0
"""A signature beside a recording: who signed, whether it holds, and whether it is of whom the user
trusts. It changes no byte of the recording."""
import os
import pathlib
import tempfile
import unittest

from clew_command import Run, run_graph


class Sign(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.directory = pathlib.Path(scratch.name)
        self.recording = self.directory / "r.mcap"
        self.signature = self.directory / "r.mcap.sig"
        self.home = {"XDG_CONFIG_HOME": str(self.directory / "config")}
        run_graph("krishna_kalra", "--layout", "composed", "--max-ticks", "20", "--record",
                  self.recording)

    def sign(self, *arguments):
        return Run(["sign", self.recording, *arguments], environment=self.home)

    def info(self, *arguments):
        return Run(["info", self.recording, "--json", *arguments])

    def test_a_key_of_ones_own_is_made_once_and_signs(self):
        before = self.recording.read_bytes()
        unsigned = self.info()
        first = self.sign()
        again = self.sign("--force")

        self.assertEqual(unsigned.report["signature"], None)
        self.assertEqual(first.status, 0, first.err)
        self.assertIn("made a key to sign with", first.err)
        self.assertEqual(again.err, "")
        self.assertEqual(self.recording.read_bytes(), before)
        key = self.directory / "config/clew/signing.pem"
        self.assertEqual(key.stat().st_mode & 0o777, 0o600)
        told = self.info()
        self.assertEqual(told.status, 0)
        self.assertEqual(told.report["signature"]["holds"], True)
        self.assertIn(told.report["signature"]["key"], first.out)
        self.assertRegex(Run(["info", self.recording]).out,
                         r"\nsignature  holds, of 'CN=[^']+', key SHA256:[0-9a-f]{64}\n")

    def test_what_was_changed_after_it_was_signed_says_so(self):
        self.assertEqual(self.sign().status, 0)
        good = self.recording.read_bytes()
        # Behind the end nothing else looks at it; in the middle it is no recording any more.
        for changed in (good + b"\0", good[:1000] + bytes([good[1000] ^ 1]) + good[1001:]):
            self.recording.write_bytes(changed)

            done = Run(["info", self.recording])

            self.assertNotEqual(done.status, 0)
            self.assertIn("DOES NOT HOLD: the file was changed after it was signed",
                          done.out + done.err)

    def test_an_authority_signs_and_is_trusted(self):
        keys = self.directory / "keys"
        self.assertEqual(Run(["keys", "init", keys, "--name", "lab 3"]).status, 0)
        self.assertEqual(self.sign("--keys", keys).status, 0)
        trusted = self.info("--signed-by", keys / "ca.pem")
        self.assertEqual(trusted.status, 0, trusted.err)
        self.assertEqual(trusted.report["signature"]["signer"], "CN=lab 3")

        self.assertEqual(self.sign("--force").status, 0)
        stranger = self.info("--signed-by", keys / "ca.pem")
        self.signature.unlink()
        nobody = self.info("--signed-by", keys / "ca.pem")

        self.assertEqual(stranger.status, 1)
        self.assertIn("not by 'CN=lab 3'", stranger.report["untrusted"])
        self.assertEqual(nobody.status, 1)
        self.assertEqual(nobody.report["untrusted"], "it is not signed")

    def test_bad_input_is_refused(self):
        self.assertEqual(self.sign().status, 0)
        key = self.directory / "config/clew/signing.pem"
        os.chmod(key, 0o644)
        garbage = self.directory / "garbage"
        garbage.write_text("garbage", encoding="utf-8")
        for words, told in (([], "r.mcap.sig: is there already; --force replaces it"),
                            (["--force"], "may be read by others: its mode is 0644"),
                            (["--force", "--keys", "/nowhere"], "/nowhere/ca.key: cannot be read"),
                            (["--force", "--key", garbage], "garbage"),
                            (["--force", "--key", key, "--keys", "/nowhere"], "--key")):
            with self.subTest(words=words):
                done = self.sign(*words)
                self.assertEqual(done.status, 2, done.out)
                self.assertIn(told, done.err)
        self.signature.write_text("garbage", encoding="utf-8")
        done = self.info()
        self.assertEqual(done.status, 2)
        self.assertIn("r.mcap.sig: is no signature of clew sign", done.err)
        self.assertEqual(Run(["sign", garbage]).status, 2)
        self.assertEqual(self.info("--signed-by", garbage).status, 2)


if __name__ == "__main__":
    unittest.main()
