"""geovor voronoi: the diagram file, held against laws that every diagram obeys."""

import math
import re
import signal
import subprocess
import unittest
import xml.etree.ElementTree

from program import DONE, FACE_REJECTED, INTERRUPTED, LEAVES_FACE, PROGRAM, ProgramTest, four_planes, sample


def distance(a, b):
    return math.dist(a["xyz"], b["xyz"])


def painted_area(d):
    """Of the polygons of a path as the program writes it: M, l, h, v and z; holes run the other way round."""
    twice, command, numbers = 0.0, "", []
    points = []
    for word in re.findall(r"[a-zA-Z]|-?\d*\.?\d+", d):
        if word == "z":
            twice += sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(points, points[1:] + points[:1]))
        if word.isalpha():
            command = word
            continue
        numbers.append(float(word))
        if len(numbers) < (1 if command in "hv" else 2):
            continue
        x, y = (0, 0) if command == "M" else points[-1]
        dx, dy = {"h": lambda a: (a, 0), "v": lambda a: (0, a)}.get(command, lambda a, b: (a, b))(*numbers)
        points = ([] if command == "M" else points) + [(x + dx, y + dy)]
        numbers = []
    return abs(twice) / 2


class Voronoi(ProgramTest):
    def diagram(self, name, *arguments):
        self.succeed("voronoi", sample(name), "-o", "out.json", *arguments, may_warn=LEAVES_FACE)
        return self.read_json("out.json")

    def diagram_of_twenty(self):
        # Multiples of the golden ratio fill the square evenly. Placing sites would take far longer than their diagram.
        golden = (math.sqrt(5) - 1) / 2
        rows = [f"{-2.9 + 5.8 * (i * golden % 1)!r},{-2.9 + 0.29 * i!r}\n" for i in range(20)]
        self.write("sites.csv", "u,v\n" + "".join(rows))
        return self.diagram("wave.step", "--sites", "sites.csv")

    def test_the_file_says_what_it_is(self):
        document = self.diagram("wave.step", "--count", 12)
        self.assertEqual((document["format"], document["version"]), ("geovor-voronoi", 1))
        self.assertEqual(document["face"], 1)
        self.assertEqual(document["unit"], "mm")
        self.assertEqual(len(document["sites"]), 12)
        self.assertEqual(len(document["cells"]), 12)

    def test_the_header_may_be_as_spreadsheets_write_it(self):
        self.write("sites.csv", "u,v\n0.5,0.25\n-1,0\n")
        plain = self.diagram("wave.step", "--sites", "sites.csv")
        for text in (b"\xef\xbb\xbfu,v\r\n0.5,0.25\r\n-1,0\r\n", b"U,V\n0.5,0.25\n-1,0\n"):
            self.write("sites.csv", text)
            self.assertEqual(self.diagram("wave.step", "--sites", "sites.csv"), plain)

    def test_sites_on_crossings_of_knot_lines_have_whole_diagrams(self):
        # The wave is odd in u: along v = const geodesics leave u = 0 by the fourth power of the way, and knots lie at
        # every third of a unit.
        for uv in ("0,1", "0,0.3333333333333333", "1e-6,1"):
            self.write("sites.csv", f"u,v\n{uv}\n")
            self.assertEqual(self.diagram("wave.step", "--sites", "sites.csv")["warnings"], [])

    def test_cells_of_the_wave_add_up_to_the_face(self):
        document = self.diagram_of_twenty()
        # Area of the graph of sin u cos v over [-3,3]^2: integral of sqrt(1 + cos^2 u cos^2 v + sin^2 u sin^2 v), by the
        # midpoint rule, whose error falls with the square of the step.
        steps = 1000
        grid = [-3 + 6 * (i + 0.5) / steps for i in range(steps)]
        squares = [(math.cos(x) ** 2, math.sin(x) ** 2) for x in grid]
        area = math.fsum(math.sqrt(1 + c1 * c2 + s1 * s2) for c1, s1 in squares for c2, s2 in squares) * (6 / steps) ** 2
        self.assertAlmostEqual(math.fsum(cell["area"] for cell in document["cells"]) / area, 1, delta=1e-4)

    def test_vertices_are_equally_far_from_their_sites(self):
        document = self.diagram_of_twenty()
        self.assertGreater(len(document["vertices"]), 0)
        for vertex in document["vertices"]:
            self.assertLess(vertex["residual"], 1e-9)

    def test_straight_distances_bound_the_radius_from_below(self):
        document = self.diagram_of_twenty()
        for vertex in document["vertices"]:
            for site in vertex["sites"]:
                self.assertGreaterEqual(vertex["radius"] * (1 + 1e-9), distance(vertex, document["sites"][site]))

    def test_every_edge_ends_at_its_vertices(self):
        document = self.diagram_of_twenty()
        for edge in document["edges"]:
            if edge["vertices"] is None:
                self.assertTrue(edge["closed"])
                continue
            for vertex, point in zip(edge["vertices"], (edge["points"][0], edge["points"][-1])):
                self.assertLess(distance(document["vertices"][vertex], point), 1e-8)

    def test_on_a_cylinders_wall_two_sites_face_each_other_across_two_straight_lines(self):
        # Sites at opposite sides of the tube, at mid height: the bisector is the two lines halfway round.
        self.write("sites.csv", "x,y,z\n10,0,15\n-10,0,15\n")
        document = self.diagram("cylinder_tube.step", "--sites", "sites.csv")
        edges = [edge for edge in document["edges"] if edge["kind"] == "bisector"]
        self.assertEqual(len(edges), 2)
        for edge in edges:
            self.assertAlmostEqual(edge["length"], 30, delta=1e-6)
            for point in edge["points"]:
                self.assertAlmostEqual(point["xyz"][0], 0, delta=1e-6)
                self.assertAlmostEqual(point["radius"], math.hypot(10 * math.pi / 2, point["xyz"][2] - 15), delta=1e-6)

    def test_sites_in_space_and_in_parameters_give_the_same_diagram(self):
        self.write("space.csv", f"x,y,z  # a graph: x = u, y = v\n0.5,0.25,{math.sin(0.5) * math.cos(0.25)!r}\n"
                                f"-1,1,{math.sin(-1) * math.cos(1)!r}\n")
        self.write("plane.csv", "# the same two\nu,v\n\n0.5,0.25\n-1,1\n")
        a = self.diagram("wave.step", "--sites", "space.csv")
        b = self.diagram("wave.step", "--sites", "plane.csv")
        for p, q in zip(a["sites"], b["sites"]):
            self.assertLess(distance(p, q), 1e-7)
        self.assertEqual(len(a["edges"]), len(b["edges"]))

    def test_the_same_seed_gives_the_same_bytes(self):
        arguments = ("voronoi", sample("paraboloid.step"), "--count", 9, "--seed", 4)
        self.succeed(*arguments, "-o", "a.json", "-o", "a.svg", may_warn=LEAVES_FACE)
        self.succeed(*arguments, "-o", "b.json", "-o", "b.svg", may_warn=LEAVES_FACE)
        for ending in ("json", "svg"):
            self.assertEqual((self.folder / f"a.{ending}").read_bytes(), (self.folder / f"b.{ending}").read_bytes())

    def test_another_seed_gives_other_sites(self):
        self.assertNotEqual(self.diagram("paraboloid.step", "--count", 9, "--seed", 1)["sites"],
                            self.diagram("paraboloid.step", "--count", 9, "--seed", 2)["sites"])

    def test_a_face_of_several_is_chosen_by_number_or_name(self):
        by_number = self.diagram("plate.step", "--face", 3, "--count", 3)
        by_name = self.diagram("plate.step", "--face", "Face3", "--count", 3)
        self.assertEqual(by_number, by_name)
        self.assertEqual(by_number["face"], 3)

    def test_one_site_has_the_whole_face(self):
        self.write("sites.csv", "u,v\n0.3,0.2\n")
        document = self.diagram("paraboloid.step", "--sites", "sites.csv")
        self.assertEqual([document["sites"][0]["uv"], document["edges"], document["vertices"]], [[0.3, 0.2], [], []])
        self.assertEqual(len(document["cells"]), 1)
        self.assertFalse(document["delaunay"]["is_triangulation"])

    def test_two_sites_share_one_edge(self):
        self.write("sites.csv", "u,v\n0.3,0.2\n-0.4,0.1\n")
        document = self.diagram("paraboloid.step", "--sites", "sites.csv")
        self.assertEqual(len(document["edges"]), 1)
        self.assertEqual([v["on_boundary"] for v in document["vertices"]], [True, True])
        self.assertEqual([e["sites"] for e in document["delaunay"]["edges"]], [document["edges"][0]["sites"]])

    def test_paths_that_leave_the_face_are_said_and_no_failure(self):
        done = self.run_program("voronoi", sample("plate.step"), "--face", 3, "--count", 3, "-o", "out.json")
        self.assertEqual(done.returncode, DONE)
        self.assertIn(LEAVES_FACE, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertIn("path_leaves_face", [w["kind"] for w in self.read_json("out.json")["warnings"]])

    def test_a_certificate_states_its_claims(self):
        printed = self.succeed("voronoi", sample("sphere.step"), "--count", 5, "--certify", "-o", "out.json")
        certificate = self.read_json("out.json")["certificate"]
        self.assertTrue(certificate["holds"])
        self.assertGreater(len(certificate["claims"]), 4)
        for claim in certificate["claims"]:
            self.assertTrue(claim["holds"])
            self.assertLessEqual(claim["measured"], claim["bound"])
            self.assertIn(f"{claim['name']}: holds", printed)
        self.assertIn(certificate["result"], printed)

    def test_a_certificate_that_does_not_hold_is_exit_code_3(self):
        self.write("planes.igs", four_planes())
        self.write("sites.csv", "u,v\n0.75,0.1\n-0.6,0.2\n")
        done = self.run_program("voronoi", "planes.igs", "--sites", "sites.csv", "--certify", "-o", "out.json")
        self.assertEqual(done.returncode, FACE_REJECTED)
        certificate = self.read_json("out.json")["certificate"]
        self.assertFalse(certificate["holds"])
        failed = [claim["name"] for claim in certificate["claims"] if not claim["holds"]]
        self.assertIn(f"geovor: planes.igs: Face1: the claim '{failed[0]}' of the certificate fails near u = ",
                      done.stderr)
        self.assertRegex(done.stdout, r"\ncertificate +not proved: ")

    def test_what_can_not_be_cad_faces_is_written_in_other_forms(self):
        self.write("planes.igs", four_planes())
        self.write("sites.csv", "u,v\n0.75,0.1\n-0.6,0.2\n")
        done = self.run_program("voronoi", "planes.igs", "--sites", "sites.csv", "-o", "out.step", "-o", "out.json")
        self.assertEqual(done.returncode, FACE_REJECTED)
        self.assertEqual(self.files(), ["out.json", "planes.igs", "sites.csv"])
        self.assertRegex(done.stderr, r"(?m)^geovor: planes\.igs: Face1: out\.step: .*can't be written as CAD faces; .*$")
        self.assertNotIn("wrote             out.step", done.stdout)

    def test_without_the_flag_there_is_no_certificate(self):
        self.assertNotIn("certificate", self.diagram("sphere.step", "--count", 2))

    def test_every_member_that_the_interface_names_is_there(self):
        document = self.diagram("cylinder_tube.step", "--count", 1)
        self.assertEqual(list(document), ["format", "version", "generator", "input", "face", "unit", "tolerance", "surface",
                                          "sites", "vertices", "edges", "cells", "warnings", "delaunay"])
        self.assertGreater(document["tolerance"], 0)
        self.assertEqual(sorted(document["surface"]), ["type", "u", "u_period", "v", "v_period"])
        for edge in document["edges"]:
            self.assertEqual(list(edge), ["id", "sites", "vertices", "closed", "kind", "length", "points", "residual"])
            self.assertEqual(edge["kind"], "cut_locus")
            self.assertEqual(edge["vertices"] is None, edge["closed"])
            self.assertEqual(list(edge["points"][0]), ["uv", "xyz", "radius"])
        for vertex in document["vertices"]:
            self.assertEqual(list(vertex), ["id", "uv", "xyz", "radius", "sites", "on_boundary", "residual"])
        self.assertEqual(list(document["delaunay"]), ["edges", "triangles", "is_triangulation", "why_not"])
        self.assertIsInstance(document["delaunay"]["why_not"], str)

    def test_the_picture_is_well_formed(self):
        self.succeed("voronoi", sample("wave.step"), "--count", 10, "-o", "out.svg")
        root = xml.etree.ElementTree.parse(self.folder / "out.svg").getroot()
        self.assertEqual(root.tag, "{http://www.w3.org/2000/svg}svg")
        self.assertLess((self.folder / "out.svg").stat().st_size, 250_000)  # a page of documents can hold it

    def test_the_picture_paints_the_face_and_not_its_holes(self):
        self.succeed("voronoi", sample("plate.step"), "--face", 3, "--count", 5, "-o", "out.svg", "-o", "out.json",
                     may_warn=LEAVES_FACE)
        root = xml.etree.ElementTree.parse(self.folder / "out.svg").getroot()
        paths = [path.get("d") for path in root.iter("{http://www.w3.org/2000/svg}path") if path.get("fill-rule")]
        self.assertGreaterEqual(len(paths), 5)  # the slot divides a cell
        frame = next(path.get("d") for path in root.iter("{http://www.w3.org/2000/svg}path")
                     if path.get("class") == "f")
        holes = 4 * 16 * math.pi + 100 * math.pi + 24 * 12 + 36 * math.pi
        self.assertAlmostEqual(sum(map(painted_area, paths)) / painted_area(frame), 1 - holes / 6000, delta=5e-4)

    def test_a_cut_locus_that_ends_freely_has_residuals(self):
        # Its end is conjugate to the site: no second geodesic is there to measure against.
        document = self.diagram("torus.step", "--count", 2)
        self.assertIn(1, [len(vertex["sites"]) for vertex in document["vertices"]])
        for item in document["vertices"] + document["edges"]:
            self.assertLess(item["residual"], 1e-9)

    def test_placed_sites_lie_in_the_face_where_paths_to_its_border_leave_it(self):
        # Geodesics along the paraboloid's straight sides bulge out over them.
        document = self.diagram("paraboloid.step", "--count", 9, "--seed", 2)
        for site in document["sites"]:
            self.assertLessEqual(max(map(abs, site["uv"])), 1.0)


class VoronoiProgress(ProgramTest):
    def test_it_counts_sites_and_cells_where_asked(self):
        done = self.run_program("voronoi", sample("sphere.step"), "--count", 5, "-o", "out.json", "--progress")
        self.assertEqual(done.returncode, DONE)
        self.assertEqual(done.stderr.splitlines(), [f"geovor: sites placed {n}/5" for n in range(1, 6)] +
                         [f"geovor: cells reached {n}/5" for n in range(1, 6)])

    def test_sites_by_their_spacing_are_counted_without_an_end(self):
        done = self.run_program("voronoi", sample("flat.step"), "--spacing", 2.5, "-o", "out.json", "--progress")
        self.assertEqual(done.returncode, DONE)
        sites = len(self.read_json("out.json")["sites"])
        self.assertEqual(done.stderr.splitlines(), [f"geovor: sites placed {n}" for n in range(1, sites + 1)] +
                         [f"geovor: cells reached {n}/{sites}" for n in range(1, sites + 1)])

    def interrupt(self, after, *arguments):
        """Starts `geovor voronoi`, waits for the line `after` on stderr, and sends Ctrl-C: it ends at once, and there is
        no new file."""
        before = self.files()
        program = subprocess.Popen([PROGRAM, "voronoi", *map(str, arguments), "--progress"], cwd=self.folder,
                                   stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.assertIn(after, iter(program.stderr.readline, ""))
        program.send_signal(signal.SIGINT)
        program.communicate(timeout=10)
        self.assertEqual(program.returncode, INTERRUPTED)
        self.assertEqual(self.files(), before)

    def test_an_interrupt_stops_soon_and_leaves_nothing(self):
        # The lines of so many cells fill the pipe, so that the program can't be ready before the signal comes.
        rows = [f"{-2.9 + 5.8 * i / 100!r},{-2.9 + 5.8 * k / 100!r}\n" for i in range(100) for k in range(100)]
        self.write("sites.csv", "u,v\n" + "".join(rows))
        self.interrupt("geovor: cells reached 1/10000\n", sample("flat.step"), "--sites", "sites.csv", "-o", "out.json",
                       "-o", "out.step")

    def test_an_interrupt_while_sites_are_placed_leaves_nothing(self):
        # As many as take minutes.
        self.interrupt("geovor: sites placed 3/100000\n", sample("wave.step"), "--count", 100000, "-o", "out.json")


if __name__ == "__main__":
    unittest.main()
