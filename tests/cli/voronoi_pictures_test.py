"""geovor voronoi -o DIAGRAM.vtp and .html: parsed again and held against the JSON."""

import base64
import html.parser
import json
import math
import pathlib
import re
import struct
import unittest
import xml.etree.ElementTree

from program import LEAVES_FACE, ProgramTest, sample

SITE, BISECTOR, CUT_LOCUS, BORDER, CELL = range(5)


def area_of_triangle(a, b, c):
    u, v = [b[k] - a[k] for k in range(3)], [c[k] - a[k] for k in range(3)]
    return 0.5 * math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def areas_of_cells(triangles, points, site_of, count):
    areas = [0.0] * count
    for i, corners in enumerate(triangles):
        areas[site_of(i)] += area_of_triangle(*(points[c] for c in corners))
    return areas


def triples(values):
    return [tuple(values[i:i + 3]) for i in range(0, len(values), 3)]


class Vtp:
    """What a reader of VTK's XML makes of the file."""

    def __init__(self, path):
        piece = xml.etree.ElementTree.parse(path).getroot().find("PolyData/Piece")
        self.counts = {name: int(piece.get(f"NumberOf{name}")) for name in ("Points", "Verts", "Lines", "Polys")}
        self.points = triples(self.array(piece.find("Points")))
        self.radius = self.array(piece.find("PointData"), "radius")
        self.cells = []
        for kind in ("Verts", "Lines", "Polys"):
            section = piece.find(kind)
            corners, start = self.array(section, "connectivity", int), 0
            for end in self.array(section, "offsets", int):
                self.cells.append(corners[start:end])
                start = end
            assert start == len(corners)
        self.kind, self.id, self.a, self.b = (self.array(piece.find("CellData"), name, int)
                                              for name in ("kind", "id", "site_a", "site_b"))

    @staticmethod
    def array(section, name=None, number=float):
        for array in section.findall("DataArray"):
            if name is None or array.get("Name") == name:
                return [number(x) for x in array.text.split()]
        raise AssertionError(name)


class Page(html.parser.HTMLParser):
    """The parts of a page, and that its tags close."""

    def __init__(self, text):
        super().__init__()
        self.open, self.data, self.attributes = [], "", []
        self.feed(text)
        assert self.open == [], self.open

    def handle_starttag(self, tag, attributes):
        self.attributes += attributes
        if tag != "meta":
            self.open.append((tag, dict(attributes).get("id")))

    def handle_endtag(self, tag):
        assert self.open.pop()[0] == tag

    def handle_data(self, data):
        if self.open and self.open[-1] == ("script", "data"):
            self.data += data


class VoronoiPictures(ProgramTest):
    def write_all(self, name, *arguments):
        self.succeed("voronoi", sample(name), "-o", "out.json", "-o", "out.vtp", "-o", "out.html", *arguments,
                     may_warn=LEAVES_FACE)
        return self.read_json("out.json")

    def check_vtp(self, document):
        vtp = Vtp(self.folder / "out.vtp")
        self.assertEqual(len(vtp.points), vtp.counts["Points"])
        self.assertEqual(len(vtp.cells), vtp.counts["Verts"] + vtp.counts["Lines"] + vtp.counts["Polys"])
        for list_ in (vtp.kind, vtp.id, vtp.a, vtp.b):
            self.assertEqual(len(list_), len(vtp.cells))
        for i, site in enumerate(document["sites"]):
            self.assertEqual((vtp.kind[i], vtp.id[i], vtp.cells[i]), (SITE, i, [i]))
            self.assertEqual(vtp.points[i], tuple(site["xyz"]))
        for edge in document["edges"]:
            i = len(document["sites"]) + edge["id"]
            self.assertEqual(vtp.kind[i], CUT_LOCUS if edge["kind"] == "cut_locus" else BISECTOR)
            self.assertEqual([vtp.a[i], vtp.b[i]], edge["sites"])
            self.assertEqual([vtp.points[c] for c in vtp.cells[i]], [tuple(p["xyz"]) for p in edge["points"]])
            self.assertEqual([vtp.radius[c] for c in vtp.cells[i]], [p["radius"] for p in edge["points"]])
        cells = [i for i, kind in enumerate(vtp.kind) if kind == CELL]
        self.check_areas(document, areas_of_cells([vtp.cells[i] for i in cells], vtp.points, lambda i: vtp.id[cells[i]],
                                                  len(document["sites"])))

    def check_html(self, document):
        text = (self.folder / "out.html").read_text()
        page = Page(text)
        self.assertNotRegex(text, r"(?i)https?:|src=|@import|url\(")  # nothing from outside
        data = json.loads(page.data)
        floats = {name: [x for x, in struct.iter_unpack("<f", base64.b64decode(data[name], validate=True))]
                  for name in ("points", "normals", "sites")}
        owners, corners = ([x for x, in struct.iter_unpack("<I", base64.b64decode(data[name], validate=True))]
                           for name in ("owners", "triangles"))
        points, triangles = triples(floats["points"]), triples(corners)
        self.assertEqual((len(floats["normals"]), len(owners)), (len(floats["points"]), len(points)))
        self.assertEqual(len(floats["sites"]), 3 * len(document["sites"]))
        self.assertLess(max(math.hypot(*p) for p in points), 1.000001)
        scaled = [[data["size"] * x for x in p] for p in points]
        self.check_areas(document, areas_of_cells(triangles, scaled, lambda i: owners[triangles[i][0]] // 16,
                                                  len(document["sites"])))
        self.assertEqual(data["areas"], [cell["area"] for cell in document["cells"]])
        colour = {owner // 16: owner % 16 for owner in owners}
        for edge in document["edges"]:
            left, right = edge["sites"]
            self.assertTrue(left == right or colour[left] != colour[right])
        self.check_lines(document, base64.b64decode(data["lines"], validate=True))

    def check_lines(self, document, data):
        words, numbers, at, kinds = struct.unpack(f"<{len(data) // 4}I", data), [], 0, []
        while at < len(words):
            kinds.append(words[at])
            self.assertGreaterEqual(words[at + 1], 2)
            at += 2 + 3 * words[at + 1]
        self.assertEqual(at, len(words))
        edges = document["edges"]
        self.assertEqual(kinds[:len(edges)], [1 if edge["kind"] == "cut_locus" else 0 for edge in edges])

    def check_areas(self, document, areas):
        whole = sum(cell["area"] for cell in document["cells"])
        for cell in document["cells"]:
            self.assertAlmostEqual(areas[cell["site"]] / whole, cell["area"] / whole, delta=2e-3)

    def test_a_face_with_holes(self):
        document = self.write_all("freeform_trimmed.step", "--count", 6)
        self.check_vtp(document)
        self.check_html(document)

    def test_a_closed_surface_with_cut_loci(self):
        document = self.write_all("cylinder_tube.step", "--count", 1)
        self.assertIn("cut_locus", [edge["kind"] for edge in document["edges"]])
        self.check_vtp(document)
        self.check_html(document)

    def test_a_sphere_with_seam_and_poles(self):
        document = self.write_all("sphere.step", "--count", 7)
        self.check_vtp(document)
        self.check_html(document)

    def test_a_name_with_marks_of_html_is_only_a_name(self):
        name = self.write('a<b>&"c.step', pathlib.Path(sample("plate.step")).read_bytes())
        self.succeed("voronoi", name, "--face", 3, "--count", 3, "-o", "out.html", may_warn=LEAVES_FACE)
        page = Page((self.folder / "out.html").read_text())
        self.assertEqual(json.loads(page.data)["title"], 'a<b>&"c.step Face3: 3 sites')

    def test_the_same_sites_give_the_same_bytes(self):
        for name in ("a", "b"):
            self.succeed("voronoi", sample("paraboloid.step"), "--count", 5, "-o", f"{name}.html", "-o", f"{name}.vtp",
                         "-o", f"{name}.step", may_warn=LEAVES_FACE)
        for ending in ("html", "vtp"):
            self.assertEqual((self.folder / f"a.{ending}").read_bytes(), (self.folder / f"b.{ending}").read_bytes())
        texts = [re.sub(r"FILE_NAME\('[ab]\.step'", "", (self.folder / f"{name}.step").read_text()) for name in "ab"]
        self.assertEqual(texts[0], texts[1])


if __name__ == "__main__":
    unittest.main()
