"""Runs the program in a folder of its own and looks at what it says and leaves behind."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["GEOVOR"]
SOURCE = pathlib.Path(os.environ["GEOVOR_SOURCE"])
SAMPLES = SOURCE / "samples" / "cad"
SHARED = pathlib.Path(os.environ.get("GEOVOR_SHARED", SOURCE.parent / "shared"))

# Exit codes.
DONE, USAGE, UNREADABLE, FACE_REJECTED, UNWRITABLE, INTERRUPTED = 0, 1, 2, 3, 4, 130

# Faces with holes have shortest paths that leave them.
LEAVES_FACE = ": warning: shortest paths leave the face"


def sample(name):
    return str(SAMPLES / name)


class ProgramTest(unittest.TestCase):
    """Each test has an empty folder, self.folder, in which the program runs."""

    maxDiff = None

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return name

    def files(self):
        """Names of all files and folders in the test's folder, hidden ones too."""
        return sorted(p.relative_to(self.folder).as_posix() for p in self.folder.rglob("*"))

    def run_program(self, *arguments, **more):
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=240, **more)

    def succeed(self, *arguments, may_warn=None):
        """Runs the program, expects success without a word on stderr (but for one line that holds `may_warn`), and
        returns what it printed."""
        done = self.run_program(*arguments)
        warned = may_warn is not None and may_warn in done.stderr and done.stderr.count("\n") == 1
        self.assertEqual((done.returncode, "" if warned else done.stderr), (DONE, ""))
        return done.stdout

    def fail_with(self, code, words, *arguments):
        """Runs the program, expects this exit code, one line on stderr that holds `words`, nothing on stdout and no new
        file; returns the line."""
        before = self.files()
        done = self.run_program(*arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("geovor: "), done.stderr)
        self.assertIn(words, done.stderr)
        self.assertEqual(self.files(), before)
        return done.stderr

    def read_json(self, name):
        return json.loads((self.folder / name).read_text())


def iges_of_spline(knots, poles):
    """An IGES file of one polyhedral B-spline surface, of degree 1 both ways with the same knots, u running fastest."""
    n = len(knots) - 1
    numbers = [128, n, n, 1, 1, 0, 0, 1, 0, 0]
    ends = [knots[0], *knots, knots[-1]]
    numbers += [*map(float, ends + ends), *[1.0] * len(poles), *[float(x) for pole in poles for x in pole]]
    numbers += [float(knots[0]), float(knots[-1])] * 2
    words = [f"{x}" + ("," if i + 1 < len(numbers) else ";") for i, x in enumerate(numbers)]
    lines = [""]
    for word in words:
        if len(lines[-1]) + len(word) > 64:
            lines.append("")
        lines[-1] += word
    head = "1H,,1H;,4Hface,4Hface,4Htest,4Htest,32,38,6,308,15,4Hface,1.0,2,"
    tail = "2HMM,1,0.01,15H20260101.000000,1E-06,10.0,4Htest,4Htest,11,0;"
    text = f"{'test':72}S{1:7}\n{head:72}G{1:7}\n{tail:72}G{2:7}\n"
    text += "".join(f"{v:8}" for v in (128, 1, 0, 0, 0, 0, 0, 0)) + f"{'00000000':>8}D{1:7}\n"
    text += "".join(f"{v:8}" for v in (128, 0, 0, len(lines), 0)) + f"{'':24}{0:8}D{2:7}\n"
    for i, line in enumerate(lines):
        text += f"{line:64}{1:8}P{i + 1:7}\n"
    return text + f"S{1:7}G{2:7}D{2:7}P{len(lines):7}{'':40}T{1:7}\n"


def four_planes():
    """A face on which four planes meet in a saddle's point, with 480 degrees around it: behind that point paths bend in
    it, and no geodesic from before reaches what lies there. No diagram can be whole where two cells meet behind it."""
    return iges_of_spline([-1, 0, 1], [(u, v, v * v - u * u) for v in (-1, 0, 1) for u in (-1, 0, 1)])


def shared_file(test, name):
    """A file of the shared data beside the source tree. Without it the test is skipped, or fails where CI is set."""
    path = SHARED / name
    if not path.exists():
        if os.environ.get("CI") == "true":
            test.fail(f"{path} is missing")
        test.skipTest(f"{path} is missing")
    return str(path)
