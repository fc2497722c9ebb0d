"""geovor distance: lengths held against closed forms, and what the program says and writes about the paths."""

import math
import pathlib
import unittest
import xml.etree.ElementTree

from program import FACE_REJECTED, UNWRITABLE, USAGE, ProgramTest, sample, shared_file


def point(*numbers):
    return ",".join(repr(float(x)) for x in numbers)


def on_sphere(u, v, radius=10.0):
    return [radius * math.cos(v) * math.cos(u), radius * math.cos(v) * math.sin(u), radius * math.sin(v)]


class Distances(ProgramTest):
    def measure(self, path, start, end, *arguments):
        self.succeed("distance", path, "--from", start, "--to", end, "-o", "out.json", *arguments)
        return self.read_json("out.json")

    def measure_leaving(self, path, start, end, *arguments):
        """The same for a path that leaves the face: exit code 3, one line on stderr, and the file all the same."""
        done = self.run_program("distance", path, "--from", start, "--to", end, "-o", "out.json", *arguments)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (FACE_REJECTED, 1), done.stderr)
        self.assertIn("leaves the face", done.stderr)
        self.assertIn("leaves the face", done.stdout)
        return self.read_json("out.json")

    def assert_close(self, found, wanted, relative):
        self.assertLessEqual(abs(found - wanted), relative * abs(wanted), (found, wanted))

    def test_the_file_says_what_it_is(self):
        document = self.measure(sample("wave.step"), "-1,0.5", "1.5,-2")
        self.assertEqual((document["format"], document["version"], document["face"], document["unit"]),
                         ("geovor-distance", 1, 1, "mm"))
        self.assertEqual(document["surface"]["type"], "bspline")
        self.assertEqual((document["from"]["uv"], document["to"]["uv"]), ([-1, 0.5], [1.5, -2]))
        self.assertEqual(document["length"], document["paths"][0]["length"])
        self.assertIsNone(document["paths"][0]["leaves_face"])
        self.assertIsNone(document["stays_on_face"])

    def test_points_run_from_one_end_to_the_other_and_measure_the_length(self):
        document = self.measure(sample("wave.step"), "-2,-1", "2,1.5")
        points = document["paths"][0]["points"]
        for end, p in (("from", points[0]), ("to", points[-1])):
            self.assertLess(math.dist(document[end]["xyz"], p["xyz"]), 1e-10)
        self.assertEqual((points[0]["s"], points[-1]["s"]), (0, document["length"]))
        chords = math.fsum(math.dist(a["xyz"], b["xyz"]) for a, b in zip(points, points[1:]))
        # Chords that sag by 1e-5 of the length are shorter than the path by a part of about 1e-4 at most.
        self.assertLessEqual(chords, document["length"] * (1 + 1e-12))
        self.assertGreaterEqual(chords, document["length"] * (1 - 1e-3))

    def test_great_circles_on_the_sphere(self):
        for a, b in (((0.1, 0.2), (2, -0.5)), ((6.2, 1.5), (0.1, 1.4)), ((0, -1.57), (3, -1.5)), ((1, 0), (1.01, 0))):
            document = self.measure(sample("sphere.step"), point(*a), point(*b))
            p, q = on_sphere(*a), on_sphere(*b)
            length = 20 * math.asin(math.dist(p, q) / 20)
            self.assert_close(document["length"], length, 2e-14)
            # y = R sin(s / R); a great circle is x cos(s / R) + R t sin(s / R).
            path = document["paths"][0]
            self.assert_close(path["y"], 10 * math.sin(length / 10), 1e-12)
            self.assert_close(1, math.hypot(*path["start_direction"]["xyz"]), 1e-14)
            c, d = math.cos(length / 10), 10 * math.sin(length / 10)
            for x, t, wanted in zip(p, path["start_direction"]["xyz"], q):
                self.assertAlmostEqual(c * x + d * t, wanted, delta=1e-12)
            self.assertEqual(document["certain"], True)

    def test_straight_lines_on_the_cylinder_cross_the_seam(self):
        document = self.measure(sample("cylinder_tube.step"), point(6, 4), point(0.5, 21))
        length = math.hypot(10 * (2 * math.pi + 0.5 - 6), 17)
        self.assert_close(document["length"], length, 2e-14)
        self.assert_close(document["paths"][0]["y"], length, 1e-12)
        self.assertGreater(document["paths"][0]["points"][-1]["uv"][0], 2 * math.pi)

    def test_opposite_points_of_the_cylinder_have_two_shortest_paths(self):
        document = self.measure(sample("cylinder_tube.step"), point(0, 5), point(math.pi, 20))
        self.assertEqual(len(document["paths"]), 2)
        for path in document["paths"]:
            self.assert_close(path["length"], math.hypot(10 * math.pi, 15), 2e-14)
        turns = [path["start_direction"]["uv"][0] for path in document["paths"]]
        self.assertLess(turns[0] * turns[1], 0)

    def test_one_shape_under_many_parameterizations_has_one_distance(self):
        # The wall x^2 + y^2 = 25 between 0 and 120 degrees.
        a, b = (0.2, 1.0), (1.9, 8.0)
        ends = [point(5 * math.cos(t), 5 * math.sin(t), z) for t, z in (a, b)]
        for name in ("cyl_orig", "cyl_nurbs", "cyl_moeb16", "cyl_pow3uv"):
            document = self.measure(shared_file(self, f"faces/{name}.step"), *ends)
            self.assert_close(document["length"], math.hypot(5 * (b[0] - a[0]), b[1] - a[1]), 2e-12)

    def test_there_and_back_are_equally_far(self):
        there = self.measure(sample("freeform.step"), "0.1,0.2", "0.9,0.7")
        back = self.measure(sample("freeform.step"), "0.9,0.7", "0.1,0.2")
        self.assert_close(there["length"], back["length"], 1e-12)
        for x, y in zip(there["paths"][0]["start_direction"]["xyz"], back["paths"][0]["end_direction"]["xyz"]):
            self.assertAlmostEqual(x, -y, delta=1e-10)

    def test_a_point_has_no_distance_from_itself(self):
        document = self.measure(sample("wave.step"), "1,1", "1,1", "-o", "out.svg")
        self.assertEqual(document["length"], 0)
        self.assertIsNone(document["paths"][0]["start_direction"])
        self.assertEqual(len(document["paths"][0]["points"]), 1)

    def test_a_path_leaves_a_plate_at_its_hole_and_comes_back(self):
        # The hole: centre (30, 30), radius 10. The path runs through its middle.
        document = self.measure_leaving(sample("plate.step"), "1,30,8", "49,30,8", "--face", 3)
        exit = document["paths"][0]["leaves_face"]
        for place, x in ((exit, 20), (exit["back"], 40)):
            self.assertLess(math.dist(place["xyz"], [x, 30, 8]), 1e-6)
            self.assertAlmostEqual(place["s"], x - 1, delta=1e-6)
        self.assertAlmostEqual(document["length"], 48, delta=1e-12)
        self.assertEqual([w["kind"] for w in document["warnings"]], ["path_leaves_face"])

    def test_a_path_that_touches_the_hole_stays_on_the_plate(self):
        document = self.measure(sample("plate.step"), "1,40,8", "49,40,8", "--face", 3)
        self.assertIsNone(document["paths"][0]["leaves_face"])

    def test_a_path_that_cuts_the_hole_a_little_leaves_the_plate(self):
        # A chord 1e-5 deep is 2 sqrt(2 r 1e-5) wide.
        document = self.measure_leaving(sample("plate.step"), "1,39.99999,8", "49,39.99999,8", "--face", 3)
        exit = document["paths"][0]["leaves_face"]
        self.assertAlmostEqual(exit["back"]["s"] - exit["s"], 2 * math.sqrt(20 * 1e-5), delta=1e-3)

    def test_a_path_along_the_border_has_not_left(self):
        document = self.measure(sample("plate.step"), "0,0,8", "100,0,8", "--face", 3)
        self.assert_close(document["length"], 100, 1e-14)

    def test_the_same_question_gives_the_same_bytes(self):
        arguments = ("distance", sample("freeform.step"), "--from", "0.1,0.2", "--to", "0.9,0.7")
        for name in ("a", "b"):
            self.succeed(*arguments, *(x for e in ("json", "svg") for x in ("-o", f"{name}.{e}")))
        for ending in ("json", "svg"):
            self.assertEqual((self.folder / f"a.{ending}").read_bytes(), (self.folder / f"b.{ending}").read_bytes())

    def test_the_picture_is_well_formed(self):
        self.succeed("distance", sample("torus.step"), "--from", "0,0.3", "--to", "2,1", "-o", "out.svg")
        root = xml.etree.ElementTree.parse(self.folder / "out.svg").getroot()
        self.assertEqual(root.tag, "{http://www.w3.org/2000/svg}svg")
        self.assertTrue(any(e.get("class") == "p" for e in root.iter()))

    def test_the_length_that_is_printed_is_the_one_in_the_file(self):
        text = self.succeed("distance", sample("wave.step"), "--from", "0,0", "--to", "1,1", "-o", "out.json")
        printed = next(line for line in text.splitlines() if line.startswith("distance")).split()
        self.assertEqual((float(printed[1]), printed[2]), (self.read_json("out.json")["length"], "mm"))

    def test_snapping_says_how_far_a_point_was_moved(self):
        text = self.succeed("distance", sample("sphere.step"), "--from", "12,0,0", "--to", "0,11,0", "--snap", "-o", "out.json")
        self.assertRegex(text, "moved by +2 mm onto the face")
        document = self.read_json("out.json")
        self.assertAlmostEqual(document["from"]["moved"], 2, delta=1e-9)
        self.assertAlmostEqual(document["to"]["moved"], 1, delta=1e-9)
        self.assertAlmostEqual(document["length"], 5 * math.pi, delta=1e-9)

    def test_snapping_takes_a_point_in_a_hole_to_its_border(self):
        document = self.measure(sample("plate.step"), "33,30,8", "45,30,8", "--snap", "--face", 3)
        # The nearest point of the circle around (30, 30) is (40, 30); a step along it is hardly farther.
        self.assertAlmostEqual(math.dist(document["from"]["xyz"], [30, 30, 8]), 10, delta=1e-6)
        self.assertAlmostEqual(document["from"]["moved"], 7, delta=1e-6)
        self.assertAlmostEqual(document["length"], 5, delta=1e-5)


class BadDistances(ProgramTest):
    def distance_fails(self, code, words, *arguments, model="wave.step"):
        return self.fail_with(code, words, "distance", sample(model), *arguments)

    def test_an_end_is_missing(self):
        self.distance_fails(USAGE, "--to is required", "--from", "0,0")

    def test_a_point_that_is_none(self):
        for text in ("", "1", "1,2,3,4", "x,y", "1;2", "1,", "nan,0", "inf,0,0"):
            self.distance_fails(USAGE, "--from: ", "--from", text, "--to", "0,0")

    def test_a_point_outside_the_face_is_named(self):
        self.distance_fails(USAGE, "wave.step: Face1: --to 7,0: lies outside the border", "--from", "0,0", "--to", "7,0")

    def test_a_point_above_the_face_is_named(self):
        self.distance_fails(USAGE, "Face1: --from 0,0,0.5: lies off the face by 0.3", "--from", "0,0,0.5", "--to", "1,1")

    def test_a_point_in_a_hole_is_named(self):
        self.distance_fails(USAGE, "Face3: --from 30,30,8: lies outside", "--face", "Face3", "--from", "30,30,8",
                            "--to", "1,1,8", model="plate.step")

    def test_the_face_must_be_named_where_there_are_several(self):
        self.distance_fails(USAGE, "--face N", "--from", "0,0", "--to", "1,1", model="plate.step")

    def test_a_face_that_is_not_there(self):
        self.distance_fails(USAGE, "Face2 is not there", "--from", "0,0", "--to", "1,1", "--face", 2)

    def test_a_face_without_a_name(self):
        self.distance_fails(USAGE, "'' names no face", "--from", "0,0", "--to", "1,1", "--face", "")

    def test_an_output_of_unknown_ending(self):
        self.distance_fails(USAGE, "the ending '.stl'", "--from", "0,0", "--to", "1,1", "-o", "out.stl")

    def test_an_output_that_cannot_be_written(self):
        self.distance_fails(UNWRITABLE, "there is no folder", "--from", "0,0", "--to", "1,1", "-o", "ok.json", "-o",
                            "missing/out.step")

    def test_a_path_of_no_length_is_no_curve(self):
        self.distance_fails(USAGE, "out.step: the two points are one", "--from", "1,1", "--to", "1,1", "-o", "out.json",
                            "-o", "out.step")

    def test_an_output_that_is_the_input(self):
        name = self.write("part.step", pathlib.Path(sample("sphere.step")).read_bytes())
        self.fail_with(USAGE, "is the input itself", "distance", name, "--from", "0,0", "--to", "1,1", "-o", name)


if __name__ == "__main__":
    unittest.main()
