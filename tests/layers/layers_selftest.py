#!/usr/bin/python3
"""layers.py must find every kind of fault that is planted, and nothing in a clean tree."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import layers  # noqa: E402

ARROWS = """
low:
high: low   # may use what is below
apps: high
@Kernel/ => low private
@*.hxx => low
!std::cout => low/may.cpp
"""


class LayersTest(unittest.TestCase):
    def faults(self, files, arrows=ARROWS):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name in ("src/camber", "apps"):
                (root / name).mkdir(parents=True)
            for name, text in files.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            (root / "arrows.txt").write_text(arrows)
            return layers.check(root, root / "arrows.txt")

    def one_fault(self, files, words, arrows=ARROWS):
        faults = self.faults(files, arrows)
        self.assertEqual(len(faults), 1, faults)
        self.assertIn(words, faults[0])

    def test_a_clean_tree_has_no_faults(self):
        self.assertEqual(self.faults({
            "src/camber/high/a.cpp": "#include <camber/low/b.hpp>\n#include <vector>\n",
            "src/camber/low/b.hpp": "int b;\n", "src/camber/low/b.cpp": "#include <Kernel/x>\n",
            "src/camber/high/CMakeLists.txt": "camber_module(high DEPENDS camber::low)"}), [])

    def test_an_upward_include_is_found(self):
        self.one_fault({"src/camber/low/a.cpp": '#include <camber/high/a.hpp>\n'},
                       "low may not include high")

    def test_an_upward_link_is_found(self):
        self.one_fault({"src/camber/low/CMakeLists.txt": "DEPENDS camber::high"},
                       "low may not link high")

    def test_a_cycle_of_arrows_is_found(self):
        self.assertTrue(any("cycle" in f for f in self.faults({}, "a: b\nb: a\n")))

    def test_a_cycle_of_headers_is_found(self):
        self.one_fault({"src/camber/low/a.hpp": "#include <camber/low/b.hpp>\n",
                        "src/camber/low/b.hpp": "#include <camber/low/a.hpp>\n"}, "headers: cycle")

    def test_a_private_header_of_another_module_is_found(self):
        self.one_fault({"src/camber/high/a.cpp": "#include <camber/low/detail/x.hpp>\n"}, "private to low")

    def test_a_third_party_header_in_the_wrong_module_is_found(self):
        self.one_fault({"src/camber/high/a.cpp": "#include <gp_Pnt.hxx>\n"}, "does not belong into high")

    def test_a_third_party_header_in_a_public_header_is_found(self):
        self.one_fault({"src/camber/low/a.hpp": "#include <Kernel/x>\n"}, "in a public header")

    def test_a_relative_include_across_folders_is_found(self):
        self.one_fault({"src/camber/high/a.cpp": '#include "../low/b.hpp"\n'}, "write <camber/...>")

    def test_a_library_that_prints_is_found(self):
        self.one_fault({"src/camber/low/a.cpp": "std::cout << 1;\n// std::cout is bad\n",
                        "src/camber/low/may.cpp": "std::cout << 1;\n",
                        "apps/a.cpp": "std::cout << 1;\n"}, "does not call std::cout")

    def test_an_unknown_module_is_found(self):
        self.one_fault({"src/camber/odd/a.cpp": "int a;\n"}, "not in the arrows")

    def test_a_file_that_is_too_long_is_found(self):
        self.one_fault({"src/camber/low/a.cpp": "\n" * 801}, "801 lines")


if __name__ == "__main__":
    unittest.main()
