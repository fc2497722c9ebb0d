"""Holds check_rooms.py against small trees that break one rule each."""

import pathlib
import tempfile
import unittest

import check_rooms

GOOD = {
    "docs/ARCHITECTURE.md": "| room | what | may include |\n| `base` | points | |\n| `surface` | maps | base |\n"
                            "| `occ_adapter` | files | surface base |\n",
    "src/base/CMakeLists.txt": "geovor_room(base)",
    "src/base/uv.h": "#pragma once\n#include <cmath>\n",
    "src/surface/CMakeLists.txt": "geovor_room(surface SOURCES a.cpp\n  DEPENDS base)",
    "src/surface/a.h": '#pragma once\n#include "base/uv.h"\n',
    "src/surface/a.cpp": '#include "surface/a.h"\n',
    "occ_adapter/CMakeLists.txt": "geovor_room(occ_adapter SOURCES r.cpp DEPENDS surface base)",
    "occ_adapter/r.cpp": "#include <gp_Pnt.hxx>\n",
}


def breaches_of(changes):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in {**GOOD, **changes}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        return list(check_rooms.breaches(root))


class CheckRooms(unittest.TestCase):
    def expect_one(self, changes, words):
        found = breaches_of(changes)
        self.assertEqual(len(found), 1, found)
        self.assertIn(words, found[0])

    def test_a_good_tree_has_no_breach(self):
        self.assertEqual(breaches_of({}), [])

    def test_a_lower_room_may_not_include_a_higher_one(self):
        self.expect_one({"src/base/bad.h": '#include "surface/b.h"\n'}, "base may not include surface")

    def test_rooms_may_not_depend_in_a_circle(self):
        self.expect_one({"src/base/CMakeLists.txt": "geovor_room(base DEPENDS surface)",
                         "docs/ARCHITECTURE.md": GOOD["docs/ARCHITECTURE.md"].replace("| |", "| surface |")},
                        "rooms depend on each other")

    def test_the_table_of_the_rooms_is_true(self):
        self.expect_one({"src/surface/CMakeLists.txt": "geovor_room(surface DEPENDS)",
                         "src/surface/a.h": ""}, "surface: the table")

    def test_files_may_not_include_in_a_circle(self):
        self.expect_one({"src/surface/a.h": '#include "surface/b.h"\n', "src/surface/b.h": '#include "surface/a.h"\n'},
                        "files include each other")

    def test_kernel_headers_stay_in_the_adapter(self):
        self.expect_one({"src/surface/bad.cpp": "#include <gp_Pnt.hxx>\n"}, "gp_Pnt.hxx")

    def test_kernel_headers_stay_out_of_the_adapters_headers(self):
        self.expect_one({"occ_adapter/bad.h": "#include <gp_Pnt.hxx>\n"}, "gp_Pnt.hxx")

    def test_a_name_is_one_type(self):
        self.expect_one({"src/base/a.h": "struct Place {\n};\n", "src/surface/b.h": "class Place;\nclass Place {\n};\n"},
                        "Place is the name of another type in src/base/a.h")

    def test_files_stay_short(self):
        self.expect_one({"src/base/long.h": "\n" * 601}, "601 lines")


if __name__ == "__main__":
    unittest.main()
