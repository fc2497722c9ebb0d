"""geovor check: what it says of meshes whose faults are known."""

import json
import math
import struct
import unittest

from program import UNREADABLE, USAGE, ProgramTest, sample
from stl import read_obj

# The sphere of samples/cad.
RADIUS = 10.0


def tetrahedron_of_sphere(scale=1.0):
    """An OBJ of the regular tetrahedron inscribed in the sphere."""
    points = [(1, 1, 1), (-1, -1, 1), (-1, 1, -1), (1, -1, -1)]
    r = scale * RADIUS / math.sqrt(3)
    text = "".join(f"v {r * x!r} {r * y!r} {r * z!r}\n" for x, y, z in points)
    return text + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"


class Check(ProgramTest):
    def check(self, mesh, against, *more):
        return json.loads(self.succeed("check", mesh, "--against", sample(against), "--json", *more))

    def test_a_tetrahedron_in_a_sphere(self):
        found = self.check(self.write("t.obj", tetrahedron_of_sphere()), "sphere.step")
        self.assertEqual((found["format"], found["version"]), ("geovor-check", 1))
        # The inscribed sphere of a regular tetrahedron has a third of the radius of that around it.
        self.assertAlmostEqual(found["distances"]["mesh_to_cad"]["largest"], RADIUS * 2 / 3, places=9)
        self.assertAlmostEqual(found["distances"]["cad_to_mesh"]["largest"], RADIUS * 2 / 3, places=5)
        self.assertLess(found["vertices"]["of_diagonal"], 1e-12)
        self.assertAlmostEqual(found["angles"]["smallest"], 60.0)
        self.assertEqual((found["topology"]["closed"], found["topology"]["euler_number"]), (True, 2))
        self.assertAlmostEqual(found["volume"], 8 / (9 * math.sqrt(3)) * RADIUS**3)
        self.assertEqual(found["orientation"], {"inverted": [], "without_area": []})

    def test_the_table_says_the_same(self):
        text = self.succeed("check", self.write("t.obj", tetrahedron_of_sphere()), "--against", sample("sphere.step"))
        self.assertRegex(text, r"(?m)^closed +yes; manifold; Euler number 2, components 1$")
        self.assertRegex(text, r"(?m)^mesh to CAD +6\.667 mm at most")
        self.assertRegex(text, r"(?m)^Face1 +4 ")

    def test_a_mesh_of_ours_is_on_its_face(self):
        self.succeed("mesh", sample("cylinder.step"), "--size", 3, "-o", "m.obj", "-o", "m.stl")
        exact, rounded = self.check("m.obj", "cylinder.step"), self.check("m.stl", "cylinder.step")
        self.assertLess(exact["vertices"]["of_diagonal"], 1e-9)
        self.assertEqual(exact["vertices"]["beyond"], 0)
        self.assertEqual(exact["file"]["precision"], "double precision")
        self.assertTrue(exact["topology"]["closed"])
        self.assertEqual(sum(face["triangles"] for face in exact["faces"]), len(read_obj(self.folder / "m.obj")))
        self.assertEqual(rounded["file"]["precision"], "single precision")
        self.assertGreater(rounded["vertices"]["largest"], exact["vertices"]["largest"])
        self.assertLess(rounded["vertices"]["largest"], rounded["file"]["rounding"])
        self.assertEqual(rounded["vertices"]["beyond"], 0)
        self.assertEqual(rounded["topology"]["vertices"], exact["topology"]["vertices"])

    def test_what_was_broken_is_found(self):
        lines = tetrahedron_of_sphere().splitlines()
        lines[5] = "f 2 1 4"
        found = self.check(self.write("t.obj", "\n".join(lines[:7]) + "\n"), "sphere.step")
        self.assertEqual(found["orientation"]["inverted"], [2])
        self.assertEqual(len(found["topology"]["open_edges"]), 3)
        self.assertEqual(len(found["topology"]["disagreeing_edges"]), 2)
        self.assertFalse(found["topology"]["closed"])

    def test_a_mesh_in_another_unit_is_suspected(self):
        found = self.check(self.write("t.obj", tetrahedron_of_sphere(1 / 25.4)), "sphere.step")
        self.assertIn("units may differ", " ".join(found["warnings"]))

    def test_the_picture_shows_the_worst_places(self):
        self.write("t.obj", tetrahedron_of_sphere())
        self.succeed("check", "t.obj", "--against", sample("sphere.step"), "-o", "t.svg", "-o", "t.html", "-o", "t.json")
        svg = (self.folder / "t.svg").read_text()
        self.assertIn("farthest from the CAD", svg)
        self.assertIn("smallest angle", svg)
        self.assertIn(svg, (self.folder / "t.html").read_text())
        self.assertEqual(self.read_json("t.json"), self.check("t.obj", "sphere.step"))

    def test_the_same_bytes_from_any_number_of_threads(self):
        self.succeed("mesh", sample("bracket.step"), "--size", 6, "-o", "m.obj")
        one = self.succeed("check", "m.obj", "--against", sample("bracket.step"), "--json", "--threads", 1)
        self.assertEqual(self.succeed("check", "m.obj", "--against", sample("bracket.step"), "--json", "--threads", 3), one)

    def test_help_names_its_options_and_exit_codes(self):
        text = self.succeed("check", "--help")
        for words in ("--against", "--json", "-o", "--threads", "0 where the mesh was measured"):
            self.assertIn(words, text)


class BadUseOfCheck(ProgramTest):
    def test_against_is_needed(self):
        self.fail_with(USAGE, "--against", "check", self.write("t.obj", tetrahedron_of_sphere()))

    def test_a_missing_mesh_is_named(self):
        self.fail_with(UNREADABLE, "no.stl: there is no such file", "check", "no.stl", "--against", sample("sphere.step"))

    def test_a_missing_cad_file_is_named(self):
        name = self.write("t.obj", tetrahedron_of_sphere())
        self.fail_with(UNREADABLE, "no.step: ", "check", name, "--against", "no.step")

    def test_a_mesh_of_unknown_ending_is_named(self):
        self.fail_with(UNREADABLE, "m.doc: the ending '.doc'", "check", self.write("m.doc", "x"), "--against",
                       sample("sphere.step"))

    def test_a_cut_stl_is_found_out(self):
        data = bytes(80) + struct.pack("<I", 12) + bytes(100)
        self.fail_with(UNREADABLE, "cut.stl: ", "check", self.write("cut.stl", data), "--against", sample("sphere.step"))

    def test_a_mesh_without_triangles_is_named(self):
        self.fail_with(UNREADABLE, "holds no triangle", "check", self.write("e.obj", "v 0 0 0\n"), "--against",
                       sample("sphere.step"))

    def test_an_output_of_unknown_ending(self):
        name = self.write("t.obj", tetrahedron_of_sphere())
        self.fail_with(USAGE, "t.png: the ending '.png'", "check", name, "--against", sample("sphere.step"), "-o", "t.png")

    def test_an_output_that_is_the_mesh(self):
        self.write("t.json", "{}")
        self.fail_with(USAGE, "t.json", "check", "t.json", "--against", sample("sphere.step"), "-o", "t.json")


if __name__ == "__main__":
    unittest.main()
