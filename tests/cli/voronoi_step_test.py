"""geovor voronoi -o CELLS.step: the cells as CAD faces, read back."""

import collections
import re
import unittest

from program import LEAVES_FACE, ProgramTest, sample


class VoronoiStep(ProgramTest):
    def check(self, name, *arguments):
        """Writes the cells, reads them back, and returns the diagram and the faces that were read. Every face is valid
        (neither OpenCASCADE's checker nor the healing of the reader has a word to say), is named after its site, and the
        faces of a site are as large as its cell, whose area in the JSON was found in another way (in polar
        coordinates)."""
        self.succeed("voronoi", sample(name), "-o", "out.json", "-o", "out.step", *arguments,
                     may_warn=LEAVES_FACE)
        document = self.read_json("out.json")
        self.write("read.json", self.succeed("info", "out.step", "--json"))
        faces = self.read_json("read.json")["faces"]
        areas = collections.defaultdict(float)
        for face in faces:
            self.assertEqual(face["problems"], [], face["face"])
            areas[face["name"]] += face["area"]
        self.assertEqual(sorted(areas), sorted(f"site {site['id']}" for site in document["sites"]))
        whole = self.area_of(name, document["face"])
        self.assertAlmostEqual(sum(areas.values()) / whole, 1, delta=1e-6)
        for cell in document["cells"]:
            self.assertAlmostEqual(areas[f"site {cell['site']}"] / whole, cell["area"] / whole, delta=2e-4)
        return document, faces

    def area_of(self, name, face):
        self.write("input.json", self.succeed("info", sample(name), "--json"))
        return self.read_json("input.json")["faces"][face - 1]["area"]

    def test_a_spline_face(self):
        document, faces = self.check("wave.step", "--count", 9)
        self.assertEqual(len(faces), 9)
        self.assertTrue(all(face["kind"] == "bspline" for face in faces))
        text = (self.folder / "out.step").read_text()
        for edge in document["edges"]:
            left, right = edge["sites"]
            self.assertIn(f"PRODUCT('edge {edge['id']} (sites {left} {right})'", text)

    def test_neighbours_share_their_edge(self):
        document, _ = self.check("paraboloid.step", "--count", 5)
        text = (self.folder / "out.step").read_text().replace("\n", "")
        uses = collections.Counter(re.findall(r"ORIENTED_EDGE\('',\*,\*,(#\d+),", text))
        self.assertEqual(sum(1 for count in uses.values() if count == 2), len(document["edges"]))
        self.assertEqual(max(uses.values()), 2)

    def test_a_plane_with_holes_turned_away(self):
        _, faces = self.check("plate.step", "--face", 3, "--count", 7)
        self.assertEqual(len(faces), 7)

    def test_a_trimmed_face_with_a_hole(self):
        self.check("freeform_trimmed.step", "--count", 6)

    def test_cells_on_a_tube_are_one_face_each_across_its_seam(self):
        document, faces = self.check("cylinder_tube.step", "--count", 5)
        self.assertEqual(len(faces), len(document["sites"]))

    def test_islands_are_faces_in_holes(self):
        self.write("sites.csv", "u,v\n0,-1\n-1,0.2\n1,0.2\n")  # the paper's figure 6
        _, faces = self.check("bumps.step", "--sites", "sites.csv")
        self.assertEqual(len(faces), 3)

    def test_an_edge_along_the_seam(self):
        self.write("sites.csv", "x,y,z\n0,10,15\n0,-10,15\n")  # the seam, at y = 0, x = 10, is half of their bisector
        _, faces = self.check("cylinder_tube.step", "--sites", "sites.csv")
        self.assertEqual(len(faces), 2)

    def test_one_site_on_a_tube_has_the_whole_face(self):
        _, faces = self.check("cylinder_tube.step", "--count", 1)
        self.assertEqual(len(faces), 1)

    def test_a_sphere(self):
        self.check("sphere.step", "--count", 6)

    def test_two_halves_of_a_sphere_that_meet_at_the_equator(self):
        self.write("sites.csv", "u,v\n0,1.5707963267948966\n0,-1.5707963267948966\n")
        _, faces = self.check("sphere.step", "--sites", "sites.csv")
        self.assertEqual(len(faces), 2)

    def test_a_torus(self):
        self.check("torus.step", "--count", 6)


if __name__ == "__main__":
    unittest.main()
