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


def shared_file(test, name):
    """A file of the shared data beside the source tree. Without it the test is skipped, or fails where CI is set."""
    path = SHARED / name
    if not path.exists():
        if os.environ.get("CI") == "true":
            test.fail(f"{path} is missing")
        test.skipTest(f"{path} is missing")
    return str(path)
