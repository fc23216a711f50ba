#!/usr/bin/python3
"""commands.py must find commands that fail and output that is not printed."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import commands  # noqa: E402


class CommandsTest(unittest.TestCase):
    def faults(self, text):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "cases").mkdir()
            (root / "a.md").write_text(text)
            return commands.check_file(root / "a.md", root, "/bin/echo")

    def test_a_command_that_prints_what_is_shown_is_fine(self):
        self.assertEqual(self.faults("Text\n\n    $ camber one \\\n        two\n    one  two\n"), [])

    def test_output_that_is_not_printed_is_found(self):
        self.assertEqual(len(self.faults("    $ camber one\n\n    two\n")), 1)

    def test_another_exit_code_is_found(self):
        self.assertEqual(len(self.faults("    $ camber one   # exit code 3\n")), 1)

    def test_another_program_is_refused(self):
        self.assertEqual(len(self.faults("    $ rm one\n")), 1)


if __name__ == "__main__":
    unittest.main()
